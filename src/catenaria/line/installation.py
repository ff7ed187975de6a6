"""Errors with which a line is installed: known ones, and distributions of those that are not known."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from annotated_types import Ge, Gt, Le
from pydantic import Field, Strict, model_validator

from catenaria.line.base import LineModel, Problem, refuse
from catenaria.line.point_mass import WireName
from catenaria.units import FORCE, LENGTH, QuantityType

DistributionKind = Literal["normal", "uniform", "triangular"]

# What is off by more than a metre or 100 kN is no error of installation.
_Force = Annotated[float, QuantityType(FORCE), Ge(-1e5), Le(1e5)]
_NonNegativeForce = Annotated[float, QuantityType(FORCE, "non-negative"), Le(1e5)]
_Length = Annotated[float, QuantityType(LENGTH), Ge(-1.0), Le(1.0)]
_NonNegativeLength = Annotated[float, QuantityType(LENGTH, "non-negative"), Le(1.0)]
_Clip = Annotated[float, Strict(), Gt(0.0), Le(10.0)]
_Fraction = Annotated[float, Strict(), Ge(0.0), Le(0.2)]
_Number = Annotated[int, Strict(), Ge(1)]

_DISTRIBUTION = "normal, uniform or triangular; the latter two are symmetric about their mean."
_SCALE = "Standard deviation of a normal distribution, half of the width of the others."
_CLIP = "Of a normal distribution: how many standard deviations from the mean its tails are cut off."


class _Distribution(LineModel):
    """What distributions of lengths and of forces share."""

    distribution: DistributionKind = Field(description=_DISTRIBUTION)
    clip: _Clip | None = Field(default=None, description=_CLIP)

    @model_validator(mode="after")
    def _fits(self) -> _Distribution:
        refuse(type(self).__name__, self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        if self.clip is not None and self.distribution != "normal":
            yield Problem(("clip",), self.clip, "a clip of normal distributions only")


class Spread(_Distribution):
    """How lengths, heights or positions scatter.

    Examples
    --------
    >>> Spread(distribution="uniform", scale="2 mm").scale
    0.002
    """

    scale: _NonNegativeLength = Field(description=_SCALE)
    mean: _Length = Field(default=0.0, description="Mean of the errors.")


class TensionSpread(_Distribution):
    """How tensions scatter, in newtons or as a fraction of the wanted tension."""

    scale: _NonNegativeForce | None = Field(default=None, description=_SCALE)
    fraction: _Fraction | None = Field(
        default=None, description="The same as a fraction of the wire's tension: this or scale."
    )

    def _problems(self) -> Iterator[Problem]:
        yield from super()._problems()
        if self.scale is None and self.fraction is None:
            yield Problem(("scale",), None, f"a value, or fraction instead: {_SCALE}", "missing")
        elif self.scale is not None and self.fraction is not None:
            yield Problem(("fraction",), self.fraction, "this or scale, not both")


class DropperError(LineModel):
    """Known errors of one dropper."""

    span: _Number = Field(description="Number of the span, from 1.")
    dropper: _Number = Field(description="Number of the dropper within its span, from 1, as in droppers.csv.")
    carries: Literal["contact wire", "auxiliary messenger"] = Field(
        default="contact wire",
        description="What hangs from it: a contact wire, or the auxiliary messenger of a compound line.",
    )
    length: _Length = Field(default=0.0, description="By how much it is too long.")
    position: _Length = Field(
        default=0.0,
        description="How far both of its clamps sit along the wires, towards growing chainage.",
    )


class SupportError(LineModel):
    """Known errors of one place at which a support holds a wire."""

    support: str = Field(description="Name of the support.")
    wire: WireName = Field(default="contact wire", description="Which wire it holds there.")
    height: _Length = Field(default=0.0, description="By how much the place is too high.")
    stagger: _Length = Field(default=0.0, description="How far the place is off to the left.")


class WireError(LineModel):
    """Known error of the tension of one wire."""

    wire: WireName = Field(description="Which wire.")
    tension: _Force = Field(description="By how much its tension is too large.")


class KnownErrors(LineModel):
    """Errors that are known one by one, as from a survey."""

    droppers: tuple[DropperError, ...] = Field(default=(), description="Of single droppers.")
    supports: tuple[SupportError, ...] = Field(default=(), description="Of single supports.")
    wires: tuple[WireError, ...] = Field(default=(), description="Of single wires.")


class Installation(LineModel):
    """How the line that is built differs from the one that is described.

    Errors that are known hold as they are given; those of which a distribution is known scatter about them,
    each dropper, support and wire independently of all others.
    """

    dropper_length: Spread | None = Field(default=None, description="Lengths to which droppers are cut.")
    dropper_position: Spread | None = Field(
        default=None, description="Where both clamps of a dropper sit along the wires."
    )
    contact_height: Spread | None = Field(
        default=None, description="Heights at which supports hold contact wires."
    )
    messenger_height: Spread | None = Field(
        default=None, description="Heights at which supports hold messenger wires."
    )
    contact_stagger: Spread | None = Field(
        default=None, description="Sideways places at which supports hold contact wires."
    )
    messenger_stagger: Spread | None = Field(
        default=None, description="Sideways places at which supports hold messenger wires."
    )
    tension: TensionSpread | None = Field(
        default=None, description="Tensions of the wires that devices hold taut."
    )
    known: KnownErrors = Field(
        default=KnownErrors(), description="Errors that are known; those above scatter about them."
    )
    seed: Annotated[int, Strict(), Ge(0)] = Field(
        default=1, description="Seed of the random numbers: the same seed gives the same samples."
    )


def usual_installation() -> Installation:
    """Return distributions for lines of which nothing is known but the tolerances of practice.

    Notes
    -----
    Where nothing but limits is known, all values between them are taken as equally likely (JCGM 100:2008,
    4.3.7). Limits: 2 mm for dropper lengths and 5 mm for heights, as accepted on site; 10 mm for what is
    mounted by eye along and across the track, the mounting tolerance of the Spanish IFE (Order TMA/135/2023);
    1 % for tensions, an assumption.

    Examples
    --------
    >>> usual_installation().dropper_length
    Spread(distribution='uniform', clip=None, scale=0.002, mean=0.0)
    """

    def within(limit: float) -> Spread:
        return Spread(distribution="uniform", scale=limit)

    return Installation(
        dropper_length=within(0.002),
        dropper_position=within(0.010),
        contact_height=within(0.005),
        messenger_height=within(0.005),
        contact_stagger=within(0.010),
        messenger_stagger=within(0.010),
        tension=TensionSpread(distribution="uniform", fraction=0.01),
    )
