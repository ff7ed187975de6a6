"""How a line scatters under random errors of its installation: the samples, and what they say."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError, InfeasibleError
from catenaria.line import Line
from catenaria.line.installation import Installation
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.contact import in_role
from catenaria.loading.errors_of_installation import error_sources
from catenaria.loading.importance import (
    confidence_limits,
    first_order_index,
    rank_correlation,
    shares,
    variance_parts,
)
from catenaria.loading.installed import InstalledLine
from catenaria.loading.samples import Tell, solve_samples
from catenaria.loading.sensitivity import Linearised, linearise
from catenaria.results.form import FormResult
from catenaria.results.tolerance import Chances, Importance, Scatter, SingleErrors, ToleranceStudy

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]

_MOST_NUMBERS = 50_000_000  # that a study keeps at once: 400 MB
_SLACK = 1e-6  # pull of a dropper that counts as none [N]


@dataclass(frozen=True)
class Options:
    """How a study is made.

    Attributes
    ----------
    samples : int
        Number of lines with random errors.
    model : str
        ``nonlinear``: every sample is brought to rest; ``linear``: samples of the linearised line only.
    workers : int
        Number of processes; nothing but the time depends on it.
    tolerance : float
        By how much heights of the contact wire may be off [m].
    """

    samples: int = 10_000
    model: Literal["nonlinear", "linear"] = "nonlinear"
    workers: int = 1
    tolerance: float = 0.005

    def __post_init__(self) -> None:
        if self.samples < 2 or self.workers < 1 or not self.tolerance > 0.0:
            raise InconsistentInputError("a study needs 2 samples, a worker and a tolerance above 0, or more")


def study_tolerances(
    line: Line,
    result: FormResult,
    installation: Installation,
    options: Options,
    tell: Tell = lambda done, of: None,
) -> ToleranceStudy:
    """Return how a found line scatters under errors of its installation.

    Parameters
    ----------
    line, result
        The line and where it was found.
    installation : Installation
        Known errors, distributions of others, and the seed.
    options : Options
        How many samples, and how.
    tell : callable
        Is told how many samples are done, and of how many.

    Raises
    ------
    InconsistentInputError
        If the samples would not fit into memory.
    InfeasibleError
        If not a single sample comes to rest.
    """
    built = BuiltLine.of(line, result)
    sources = error_sources(built, installation)
    installed = InstalledLine.of(built, sources)
    _require_room(options.samples, sources.count + 3 * installed.count)
    linearised = linearise(installed)
    errors = sources.distribution.draw(installation.seed, 0, options.samples)
    linear = linearised.outputs(errors)
    if options.model == "linear":
        outputs = linear
    else:
        outputs = solve_samples(line, result, installation, options.samples, options.workers, tell)
    rests = np.isfinite(outputs[:, 0])  # where there is no rest, nothing is known
    if not rests.any():
        raise InfeasibleError("not one sample came to rest: the errors of installation are too large")
    samples = _Samples(installed, linearised, options, errors, linear, outputs, rests)
    return samples.study(installation)


def _require_room(samples: int, numbers: int) -> None:
    most = _MOST_NUMBERS // max(numbers, 1)
    if samples > most:
        raise InconsistentInputError(
            f"{samples} samples of this line need too much memory: at most {most} fit"
        )


@dataclass(frozen=True)
class _Samples:
    """All samples: errors (n, m), outputs by both models (n, n_outputs), and which of them came to rest."""

    installed: InstalledLine
    linearised: Linearised
    options: Options
    errors: FloatArray
    linear: FloatArray
    outputs: FloatArray
    rests: Mask

    @property
    def _droppers(self) -> int:
        return self.installed.model.length.size

    @property
    def _contact(self) -> Mask:
        layout = self.installed.model.layout
        return in_role(layout, layout.droppers.lower, "contact wire")

    def study(self, installation: Installation) -> ToleranceStudy:
        layout, line, options = self.installed.model.layout, self.installed.built.line, self.options
        droppers, n = layout.droppers, self._droppers
        at = _names(droppers.span, droppers.number)
        off, linear_off = (self._off(heights[:, :n]) for heights in (self.outputs, self.linear))
        worst, linear_worst = off[:, self._contact].max(axis=1), linear_off[:, self._contact].max(axis=1)
        slack = self.outputs[:, n : 2 * n] <= _SLACK
        gone = self.outputs[self.rests, :n] - self.linear[self.rests, :n]
        spans = tuple(f"span {i + 1}" for i in range(len(line.spans)))
        elasticities = self.linearised.elasticities(self.errors)
        wires = [wire.name for wire in layout.wires if not wire.tied]
        ends = tuple(f"{wire}, {end}" for wire in wires for end in ("start", "end"))
        limit = options.tolerance
        return ToleranceStudy(
            line=line.name,
            model=options.model,
            samples=options.samples,
            seed=installation.seed,
            tolerance=limit,
            span=droppers.span,
            number=droppers.number,
            chainage=droppers.frame.chainage,
            wanted_height=droppers.height,
            on_contact_wire=self._contact,
            supports=dict(zip((s.name for s in line.supports), line.support_x, strict=True)),
            height=self._scatter(at, slice(0, n)),
            force=self._scatter(at, slice(n, 2 * n)),
            tension=self._scatter(ends, slice(2 * n, None)),
            elasticity=Scatter.of(spans, self.linearised.elasticity, elasticities),
            linear_height=Scatter.of(at, self.linearised.nominal[:n], self.linear[:, :n]),
            worst=worst[self.rests],
            linear_worst=linear_worst,
            outside=_chances(at, (off > limit).sum(axis=0), int(self.rests.sum())),
            events=_chances(
                ("leaving", "leaving, linear", "slack", "no rest"),
                np.array(
                    [
                        np.count_nonzero(~(worst <= limit)),  # also of samples without rest
                        np.count_nonzero(linear_worst > limit),
                        np.count_nonzero(slack.any(axis=1)),
                        np.count_nonzero(~self.rests),
                    ]
                ),
                options.samples,
            ),
            slack=slack.sum(axis=0),
            importance=self._importance(),
            errors=self._single_errors(),
            difference=float(np.sqrt(np.mean(gone**2))),
            largest_difference=float(np.abs(gone).max()),
            installation=installation.model_dump(mode="json"),
        )

    def _off(self, height: FloatArray) -> FloatArray:
        """Return by how much heights are off at each dropper."""
        return np.abs(height - self.installed.model.layout.droppers.height)

    def _scatter(self, name: tuple[str, ...], which: slice) -> Scatter:
        return Scatter.of(name, self.linearised.nominal[which], self.outputs[self.rests, which])

    def _parts(self) -> FloatArray:
        """Return what errors contribute to the variances of heights, shape (n_droppers, m)."""
        sources = self.installed.sources
        return variance_parts(self.linearised.slope[: self._droppers], sources.distribution.deviation)

    def _importance(self) -> Importance:
        sources, n = self.installed.sources, self._droppers
        masks = [sources.of(group) for group in sources.groups]
        parts, contact = self._parts(), self._contact
        total = parts[contact].sum()
        share = [parts[np.ix_(contact, own)].sum() / total if total > 0.0 else 0.0 for own in masks]
        index, correlation = self._from_samples(masks)
        mean = sources.distribution.mean
        without: list[float] = []
        for own in masks:
            contribution = (self.errors[:, own] - mean[own]) @ self.linearised.slope[:n, own].T
            off = self._off(self.linear[:, :n] - contribution)[:, contact]
            count = np.count_nonzero(off.max(axis=1) > self.options.tolerance)
            without.append(count / self.options.samples)
        return Importance(
            sources.groups,
            np.array([np.count_nonzero(own) for own in masks], dtype=np.int64),
            np.array(share, dtype=np.float64),
            shares(parts, masks),
            index,
            correlation,
            np.array(without, dtype=np.float64),
        )

    def _from_samples(self, masks: Sequence[Mask]) -> tuple[FloatArray, FloatArray]:
        """Return Sobol's first-order indices and Spearman's coefficients of groups."""
        heights = self.outputs[self.rests][:, : self._droppers]
        weight = np.where(self._contact, heights.var(axis=0), 0.0)
        index, correlation = np.zeros(len(masks)), np.zeros(len(masks))
        if weight.sum() == 0.0:
            return index, correlation
        for i, own in enumerate(masks):
            given = self.errors[np.ix_(self.rests, own)]
            of = given @ self.linearised.slope[: self._droppers, own].T
            index[i] = np.average(_each(first_order_index, of, heights), weights=weight)
            correlation[i] = np.average(_each(rank_correlation, of, heights), weights=weight)
        return index, correlation

    def _single_errors(self) -> SingleErrors:
        sources, parts = self.installed.sources, self._parts()[self._contact]
        total = parts.sum()
        return SingleErrors(
            sources.group,
            sources.name,
            sources.unit,
            sources.distribution.mean,
            sources.distribution.deviation,
            np.ascontiguousarray(self.linearised.slope[: self._droppers]),
            parts.sum(axis=0) / (total if total > 0.0 else 1.0),
        )


def with_seed(installation: Installation, seed: int | None) -> Installation:
    """Return errors of installation with another seed, if one is given."""
    return installation if seed is None else installation.model_copy(update={"seed": seed})


def _each(index: Callable[[FloatArray, FloatArray], float], x: FloatArray, y: FloatArray) -> FloatArray:
    """Return an index of every column of x for the same column of y."""
    return np.array([index(a, b) for a, b in zip(x.T, y.T, strict=True)])


def _chances(name: tuple[str, ...], count: IntArray, samples: int) -> Chances:
    lower, upper = confidence_limits(count, samples)
    return Chances(name, count.astype(np.int64), count / samples, lower, upper)


def _names(span: IntArray, number: IntArray) -> tuple[str, ...]:
    return tuple(f"{i}/{k}" for i, k in zip(span.tolist(), number.tolist(), strict=True))
