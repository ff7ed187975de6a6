"""What a tolerance study finds: how a line scatters under errors of its installation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

LEVELS: Final = (1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0)  # of percentiles [%]


@dataclass(frozen=True)
class Scatter:
    """How some quantities scatter, one entry for each of them.

    Attributes
    ----------
    name : tuple of str, length n
        What they are.
    nominal : FloatArray, shape (n,)
        Their values without errors.
    mean, deviation, minimum, maximum : FloatArray, shape (n,)
        Of all samples.
    percentile : FloatArray, shape (n, 7)
        Below which the share `LEVELS` of the samples lies.
    """

    name: tuple[str, ...]
    nominal: FloatArray
    mean: FloatArray
    deviation: FloatArray
    minimum: FloatArray
    maximum: FloatArray
    percentile: FloatArray

    @classmethod
    def of(cls, name: tuple[str, ...], nominal: FloatArray, samples: FloatArray) -> Scatter:
        """Return how samples of shape (n_samples, n) scatter."""
        return cls(
            name,
            nominal,
            samples.mean(axis=0),
            _deviation(samples),
            samples.min(axis=0),
            samples.max(axis=0),
            np.ascontiguousarray(np.percentile(samples, LEVELS, axis=0).T),
        )


def _deviation(samples: FloatArray) -> FloatArray:
    """Return standard deviations of columns; zeros for a single sample."""
    off = samples - samples.mean(axis=0)
    return np.sqrt(np.einsum("ni,ni->i", off, off) / max(samples.shape[0] - 1, 1))


@dataclass(frozen=True)
class Chances:
    """Counted events as probabilities, with the limits between which they are with 95 % confidence.

    Attributes
    ----------
    name : tuple of str, length n
        What happens.
    count : IntArray, shape (n,)
        In how many samples.
    probability, lower, upper : FloatArray, shape (n,)
        Share of the samples, and limits by Clopper & Pearson (1934).
    """

    name: tuple[str, ...]
    count: IntArray
    probability: FloatArray
    lower: FloatArray
    upper: FloatArray


@dataclass(frozen=True)
class Importance:
    """How much each group of errors matters, one entry for each group.

    Attributes
    ----------
    group : tuple of str, length n
        Groups.
    count : IntArray, shape (n,)
        Number of errors in each.
    share : FloatArray, shape (n,)
        Share of the variance of heights, summed over all droppers of the contact wire, by sensitivities.
    share_at : FloatArray, shape (n, n_droppers)
        The same at every dropper.
    sampled_share : FloatArray, shape (n,)
        First-order Sobol indices from the samples, weighted with the variance at the droppers.
    rank_correlation : FloatArray, shape (n,)
        Mean of Spearman's coefficients between heights and what the group contributes to them.
    leaving_without : FloatArray, shape (n,)
        Probability of leaving the tolerance if the group had no errors, by linear sensitivities.
    """

    group: tuple[str, ...]
    count: IntArray
    share: FloatArray
    share_at: FloatArray
    sampled_share: FloatArray
    rank_correlation: FloatArray
    leaving_without: FloatArray


@dataclass(frozen=True)
class SingleErrors:
    """Every single error by itself, one entry for each.

    Attributes
    ----------
    group, name, unit : tuple of str, length m
        What it is, of what, and N or m.
    mean, deviation : FloatArray, shape (m,)
        Of its distribution.
    sensitivity : FloatArray, shape (n_droppers, m)
        Derivatives of heights at droppers by the errors [m/m] or [m/N].
    share : FloatArray, shape (m,)
        Share of the variance of heights, summed over all droppers of the contact wire.
    """

    group: tuple[str, ...]
    name: tuple[str, ...]
    unit: tuple[str, ...]
    mean: FloatArray
    deviation: FloatArray
    sensitivity: FloatArray
    share: FloatArray


@dataclass(frozen=True)
class ToleranceStudy:
    """A line under random errors of its installation.

    Attributes
    ----------
    line : str
        Name of the line.
    model : str
        ``nonlinear``, or ``linear`` if samples are those of the linearised line.
    samples, seed : int
        How many, and of which random numbers.
    tolerance : float
        By how much heights of the contact wire may be off [m].
    span, number : IntArray, shape (n_droppers,)
        Span (from 1) and number within the span (from 1) of all droppers.
    chainage, wanted_height : FloatArray, shape (n_droppers,)
        Where droppers hang, and wanted heights [m].
    on_contact_wire : NDArray of bool, shape (n_droppers,)
        Whether a dropper carries a contact wire.
    supports : dict of str to float
        Chainages of the supports by name [m].
    height, force : Scatter
        Heights of lower wires at droppers [m], and forces in droppers [N].
    tension : Scatter
        Forces at the starts and ends of the wires [N].
    elasticity : Scatter
        Uplift per force of the contact wire at mid spans, linearised [m/N].
    linear_height : Scatter
        Heights by the linearised line, from the same samples.
    worst, linear_worst : FloatArray, shape (n_samples,)
        Largest deviation of a sample's contact wire from the wanted heights [m]; only of samples at rest.
    outside : Chances
        That a dropper's height is off by more than the tolerance.
    events : Chances
        ``leaving``: any height of the contact wire is off by more than the tolerance, or the sample did not
        come to rest. ``leaving, linear``: the same of the linearised line. ``slack``: any dropper hangs
        slack. ``no rest``: no equilibrium was found.
    slack : IntArray, shape (n_droppers,)
        In how many samples each dropper hangs slack.
    importance : Importance
        Which groups of errors matter.
    errors : SingleErrors
        Every single one.
    difference, largest_difference : float
        Root mean square and maximum of the difference of heights between linear and nonlinear line [m].
    installation : dict
        Echo of the given errors, in SI.
    """

    line: str
    model: str
    samples: int
    seed: int
    tolerance: float
    span: IntArray
    number: IntArray
    chainage: FloatArray
    wanted_height: FloatArray
    on_contact_wire: NDArray[np.bool_]
    supports: dict[str, float]
    height: Scatter
    force: Scatter
    tension: Scatter
    elasticity: Scatter
    linear_height: Scatter
    worst: FloatArray
    linear_worst: FloatArray
    outside: Chances
    events: Chances
    slack: IntArray
    importance: Importance
    errors: SingleErrors
    difference: float
    largest_difference: float
    installation: dict[str, Any]

    def __repr__(self) -> str:
        return (
            f"ToleranceStudy: {self.line or 'a line without name'}, {self.samples} samples, {self.model}; "
            f"contact wire off by more than {1e3 * self.tolerance:g} mm "
            f"in {100.0 * self.event('leaving')[0]:.3g} % of them"
        )

    def event(self, name: str) -> tuple[float, float, float]:
        """Return the probability of an event and its limits."""
        i = self.events.name.index(name)
        events = self.events
        return float(events.probability[i]), float(events.lower[i]), float(events.upper[i])

    def count_of(self, name: str) -> int:
        """Return in how many samples an event happened."""
        return int(self.events.count[self.events.name.index(name)])
