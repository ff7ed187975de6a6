"""What a study of elasticity found: how far a contact wire rises where it is pushed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class PushedPoint:
    """Points at which the contact wire is pushed, one after the other; one entry for each.

    Attributes
    ----------
    chainage : FloatArray
        Of the point before it is pushed [m].
    span : IntArray
        In which it is, from 1; a support belongs to the span that it begins.
    place : tuple of str
        ``support S3``, ``dropper 2``, ``mid span``, two of them with a comma between, or empty.
    elasticity : FloatArray
        Uplift by force [m/N].
    slack : IntArray
        How many droppers are slack meanwhile.
    """

    chainage: FloatArray
    span: IntArray
    place: tuple[str, ...]
    elasticity: FloatArray
    slack: IntArray


@dataclass(frozen=True)
class SpanElasticity:
    """Spans, from one support of the contact wire to the next; one entry for each.

    Attributes
    ----------
    span : IntArray
        From 1.
    start, end : FloatArray
        Chainages of the supports [m].
    largest, largest_chainage, smallest, smallest_chainage : FloatArray
        Extremes between the supports and at them [m/N], and where they are [m].
    at_start, at_middle, at_end : FloatArray
        At both supports and half way between them [m/N].
    nonuniformity : FloatArray
        u = (e_max - e_min)/(e_max + e_min).
    tension : FloatArray
        Sum of the mean tensions of contact wires and messenger wires [N].
    inner : Mask
        Whether the span counts for the line: it is not the first or the last one, and all contact wires are
        in use in it, if there are such spans.
    """

    span: IntArray
    start: FloatArray
    end: FloatArray
    largest: FloatArray
    largest_chainage: FloatArray
    smallest: FloatArray
    smallest_chainage: FloatArray
    at_start: FloatArray
    at_middle: FloatArray
    at_end: FloatArray
    nonuniformity: FloatArray
    tension: FloatArray
    inner: Mask

    def textbook(self, k: float) -> FloatArray:
        """Return the hand formula for the middle of the spans, L/(k sum T) [m/N]."""
        return (self.end - self.start) / (k * self.tension)


@dataclass(frozen=True)
class Compared:
    """Points at which the linearised line was compared with the nonlinear one; one entry for each.

    Attributes
    ----------
    chainage : FloatArray
        [m].
    why : tuple of str
        ``mid span``, ``support``, ``largest``, ``most slack droppers``.
    linearised, nonlinear : FloatArray
        Elasticities [m/N].
    linearised_slack, nonlinear_slack : IntArray
        Numbers of slack droppers.
    same_slack : Mask
        Whether the same droppers are slack.
    """

    chainage: FloatArray
    why: tuple[str, ...]
    linearised: FloatArray
    nonlinear: FloatArray
    linearised_slack: IntArray
    nonlinear_slack: IntArray
    same_slack: Mask

    @property
    def error(self) -> FloatArray:
        """Linearised over nonlinear elasticity, less 1; 0 where nothing moves."""
        moves = np.abs(self.nonlinear) > 1e-9  # 1 nm/N
        return np.where(moves, self.linearised / np.where(moves, self.nonlinear, 1.0) - 1.0, 0.0)


@dataclass(frozen=True)
class ElasticityStudy:
    """Elasticity of a line.

    Attributes
    ----------
    line, method : str
        Name of the line, and the method by which its form was found.
    force : float
        With which the contact wire is pushed up [N]; 0 for the limit of a small force.
    spacing : float
        Of the points [m].
    nonlinear : bool
        Whether each point was solved with all nonlinearities; else geometry is linearised about the line at
        rest, and droppers go slack.
    points : PushedPoint
        All points.
    spans : SpanElasticity
        Spans all of whose points were pushed.
    largest, smallest, nonuniformity : float
        Of all points in the spans that count, or of all points if there is no whole span [m/N], [m/N], [-].
    slack_at_rest : int
        How many droppers are slack without a force.
    held : tuple of str
        Supports that hold the contact wire so that it cannot rise at all.
    compared : Compared
        The linearised line beside the nonlinear one; empty if all points are nonlinear or the force is 0.
    elasticity_limit, nonuniformity_limit : tuple of float
        What `largest` and `nonuniformity` may be [m/N], [-]; empty if there is no limit.
    supports, droppers : FloatArray
        Chainages of the supports of the first contact wire and of all droppers on contact wires [m].
    inputs : dict
        The line.
    """

    line: str
    method: str
    force: float
    spacing: float
    nonlinear: bool
    points: PushedPoint
    spans: SpanElasticity
    largest: float
    smallest: float
    nonuniformity: float
    slack_at_rest: int
    held: tuple[str, ...]
    compared: Compared
    elasticity_limit: tuple[float, ...]
    nonuniformity_limit: tuple[float, ...]
    supports: FloatArray
    droppers: FloatArray
    inputs: dict[str, Any]

    def __repr__(self) -> str:
        count = self.points.chainage.size
        return (
            f"ElasticityStudy: {self.line or 'a line without name'}, "
            f"pushed with {self.force:g} N at {count} points; "
            f"{1e3 * self.smallest:.4g} to {1e3 * self.largest:.4g} mm/N, "
            f"non-uniformity {100.0 * self.nonuniformity:.3g} %"
        )

    @property
    def in_use(self) -> str:
        """Between which supports spans count, if others than the first and the last one do not."""
        spans = self.spans
        middle = 0.5 * (spans.start + spans.end)
        within = (middle > self.supports[1]) & (middle < self.supports[-2])
        if not (within & ~spans.inner).any():
            return ""
        names: list[str] = [support["name"] for support in self.inputs["supports"]]
        counted: list[int] = spans.span[spans.inner].tolist()
        used = f"from {names[counted[0] - 1]} to {names[counted[-1]]}"
        return f"{used}: in other spans the contact wire has no droppers, or is lifted"

    def broken_limits(self) -> tuple[str, ...]:
        """Return what is said of limits that are not kept."""
        said: list[str] = []
        if any(self.largest > limit for limit in self.elasticity_limit):
            limit = min(self.elasticity_limit)
            said.append(
                f"the elasticity is {1e3 * self.largest:.4g} mm/N; the limit is {1e3 * limit:.4g} mm/N"
            )
        if any(self.nonuniformity > limit for limit in self.nonuniformity_limit):
            u, limit = self.nonuniformity, min(self.nonuniformity_limit)
            said.append(f"the non-uniformity is {100.0 * u:.3g} %; the limit is {100.0 * limit:.3g} %")
        return tuple(said)


def nonuniformity(largest: FloatArray, smallest: FloatArray) -> FloatArray:
    """Return u = (e_max - e_min)/(e_max + e_min).

    Examples
    --------
    >>> nonuniformity(np.array([0.6e-3]), np.array([0.2e-3])).round(12).tolist()
    [0.5]
    """
    return (largest - smallest) / (largest + smallest)
