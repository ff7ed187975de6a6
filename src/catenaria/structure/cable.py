"""Cables and rods, and how they are laid out at the start."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import accumulate, pairwise
from math import dist

from pydantic import ConfigDict, Field, model_validator

from catenaria.line.base import LineModel, Problem, exactly_one, refuse
from catenaria.line.solver import Count
from catenaria.structure.vector import Point
from catenaria.units import PositiveLength


class Cable(LineModel):
    """A cable or rod, laid out straight from point to point.

    Examples
    --------
    >>> rod = Cable(section="steel", points=[(0, 0, 0), ("10 m", 0, 0)], elements=20)
    >>> rod.length
    10.0
    """

    model_config = ConfigDict(json_schema_extra=exactly_one("elements", "nodes"))

    section: str = Field(description="Name of its cross-section.")
    points: tuple[Point, ...] = Field(
        description=(
            "Where it starts, perhaps where it passes, and where it ends, x, y, z each: straight in between."
        )
    )
    unstressed_length: PositiveLength | None = Field(
        default=None,
        description=(
            "Its length without strain; that of its layout if left out. If less, it starts stretched; if "
            "more, which only a cable between two points may be, it hangs as a chain of that length."
        ),
    )
    elements: Count | None = Field(default=None, description="Number of equal elements. Give this or nodes.")
    nodes: tuple[PositiveLength, ...] | None = Field(
        default=None,
        description=(
            "Material (unstressed) coordinates of the nodes between start and end, ascending. Give this or "
            "elements. Joints, masses and bends of the layout add nodes where there is none."
        ),
    )
    weight: bool = Field(
        default=True, description="Whether gravity acts on it; its mass has inertia in any case."
    )

    @property
    def laid_length(self) -> float:
        """Length of the layout [m]."""
        return self.corners[-1]

    @property
    def corners(self) -> tuple[float, ...]:
        """Distance of each point from the start along the layout [m]."""
        return tuple(accumulate((dist(a, b) for a, b in pairwise(self.points)), initial=0.0))

    @property
    def length(self) -> float:
        """Unstressed length [m]."""
        return self.laid_length if self.unstressed_length is None else self.unstressed_length

    @model_validator(mode="after")
    def _possible(self) -> Cable:
        refuse("Cable", (*self._layout_problems(), *self._mesh_problems()))
        return self

    def _layout_problems(self) -> Iterator[Problem]:
        if len(self.points) < 2:
            yield Problem(("points",), self.points, "at least a start and an end")
            return
        for i, (before, after) in enumerate(pairwise(self.points), start=1):
            if before == after:
                yield Problem(("points", i), after, "a point that is not the one before it")
        if self.length > self.laid_length:
            allowed = f"{self.laid_length:g} m or less, the length of the layout, "
            if len(self.points) > 2:
                yield Problem(("unstressed_length",), self.unstressed_length, f"{allowed}which has bends")
            elif self.points[0][:2] == self.points[1][:2]:
                reason = "as the ends are above each other"
                yield Problem(("unstressed_length",), self.unstressed_length, allowed + reason)

    def _mesh_problems(self) -> Iterator[Problem]:
        if self.elements is None and self.nodes is None:
            yield Problem(("elements",), None, "a value: one of elements and nodes is needed", "missing")
        if self.elements is not None and self.nodes is not None:
            yield Problem(("nodes",), self.nodes, "this or elements, not both")
        inner = self.nodes or ()
        for i, (before, after) in enumerate(pairwise((0.0, *inner, self.length))):
            if inner and after <= before:
                allowed = f"coordinates that ascend from 0 to the length, {self.length:g} m"
                yield Problem(("nodes", min(i, len(inner) - 1)), after, allowed)
