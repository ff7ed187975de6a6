"""The whole line: what an engineer describes and a method solves."""

from __future__ import annotations

from functools import lru_cache
from itertools import accumulate, count
from typing import Any, Literal

from pydantic import Field, PrivateAttr, field_validator, model_validator
from pydantic_core import PydanticCustomError

from catenaria.line.alignment import Alignment
from catenaria.line.base import LineModel, refuse
from catenaria.line.checks import line_problems
from catenaria.line.conductor import Conductor
from catenaria.line.conductors import from_library
from catenaria.line.dropper import DropperKind
from catenaria.line.installation import Installation
from catenaria.line.library import conductor_named
from catenaria.line.load_units import CelsiusTemperature, TrainSpeed
from catenaria.line.plane import beyond_plane
from catenaria.line.point_mass import PointMass
from catenaria.line.profile import between, held_heights, wanted_heights
from catenaria.line.solver import Solver
from catenaria.line.source import Source
from catenaria.line.span import Span
from catenaria.line.support import Support
from catenaria.line.tied_wire import MidPoint, StitchWire
from catenaria.line.track import Track
from catenaria.line.wire import SecondContactWire, Wire
from catenaria.units import Length, PositiveAcceleration

_FARTHEST = 1e6  # m


class Line(LineModel):
    """An overhead contact line: wires, supports, spans with droppers, and how to solve it.

    All quantities are floats in SI. Axes: x along the track from the chainage's origin, y to the left, z up.
    """

    format: Literal[1] = Field(description="Version of this file format: 1.")
    name: str = Field(default="", description="A short name, for tables and figures.")
    description: str = Field(default="", description="Whatever a reader should know.")
    speed: TrainSpeed | None = Field(
        default=None, description="Speed for which the line is built, by which checks of standards go."
    )
    gravity: PositiveAcceleration = Field(default=9.80665, description="Acceleration of gravity.")
    reference_temperature: CelsiusTemperature = Field(
        default=15.0,
        description="Temperature at which the line has the wanted heights, for load cases.",
    )
    conductors: dict[str, Conductor] = Field(
        default_factory=dict[str, Conductor],
        description=(
            "Conductors by name; wires and droppers refer to the names. Those of the library need not be "
            "listed."
        ),
    )
    contact_wire: Wire = Field(description="The wire that the pantograph touches.")
    second_contact_wire: SecondContactWire | None = Field(
        default=None, description="A second contact wire beside the first, if there is one."
    )
    messenger_wire: Wire = Field(description="The wire that carries the contact wire through the droppers.")
    auxiliary_messenger: Wire | None = Field(
        default=None,
        description="The wire between messenger and contact wire, in a compound catenary.",
    )
    stitch_wire: StitchWire | None = Field(default=None, description="Stitch wires, if the line has them.")
    mid_point: MidPoint | None = Field(default=None, description="A mid-point anchor, if the line has one.")
    point_masses: tuple[PointMass, ...] = Field(
        default=(), description="Insulators, clamps and other masses on the wires."
    )
    dropper: DropperKind = Field(description="What all droppers are made of.")
    start_chainage: Length = Field(
        default=0.0, description="Chainage (x) of the first support, within 1,000 km."
    )
    supports: tuple[Support, ...] = Field(description="Supports in order of chainage: one more than spans.")
    spans: tuple[Span, ...] = Field(description="Spans in order of chainage.")
    installation: Installation | None = Field(
        default=None, description="Errors with which the line is built, for tolerance studies."
    )
    track: Track = Field(default=Track(), description="Course of the track; straight and level if left out.")
    solver: Solver = Field(default=Solver(), description="Mesh, and options of the methods.")

    _source: Source = PrivateAttr(default_factory=Source)

    def model_post_init(self, context: Any, /) -> None:
        """Keep the places in the file, which the reader hands over, and the conductors of the library."""
        if isinstance(context, Source):
            self._source = context
        self.conductors.update(from_library(self))

    @field_validator("format", mode="before")
    @classmethod
    def _whole_number(cls, value: object) -> object:
        """In Python, and therefore in pydantic's eyes, 1 is the same as true and as 1.0."""
        if type(value) is not int:
            raise PydanticCustomError("value", "{allowed}", {"allowed": "1"})
        return value

    @field_validator("start_chainage", mode="after")
    @classmethod
    def _near(cls, chainage: float) -> float:
        """Digits of positions are lost far away; bounds of the field do not reach quantities with units."""
        if abs(chainage) > _FARTHEST:
            raise PydanticCustomError("value", "{allowed}", {"allowed": f"within {_FARTHEST:.0f} m"})
        return chainage

    @field_validator("supports", mode="after")
    @classmethod
    def _numbered(cls, supports: tuple[Support, ...]) -> tuple[Support, ...]:
        """Name the supports that have no name by their number, or the next one that is not taken."""
        taken = {support.name for support in supports}
        named: list[Support] = []
        for number, support in enumerate(supports, start=1):
            name = support.name or next(f"S{i}" for i in count(number) if f"S{i}" not in taken)
            taken.add(name)
            named.append(support if support.name else support.model_copy(update={"name": name}))
        return tuple(named)

    @model_validator(mode="after")
    def _consistent(self) -> Line:
        refuse("Line", line_problems(self))
        return self

    def __repr__(self) -> str:
        """Say in a few lines what the line is, as ``catenaria check`` does."""
        from catenaria.line.summary import summarise  # which needs lines itself

        sections = summarise(self)
        width = max(len(label) for _, rows in sections for label, _ in rows)
        told = [(title, [f"  {label:{width}}  {text}" for label, text in rows]) for title, rows in sections]
        return "\n".join(text for title, rows in told for text in (title, *rows))

    __str__ = __repr__

    @property
    def source(self) -> Source:
        """Where in its file the parts of the line stand."""
        return self._source

    @property
    def plane(self) -> bool:
        """Whether the line lies in a plane and has two wires that run freely through level supports."""
        return not any(beyond_plane(self))

    @property
    def alignment(self) -> Alignment:
        """The course of the track in space."""
        track: Any = self.track  # hashable, for it is frozen, which type checkers do not see
        return _alignment(track, self.start_chainage)

    def conductor(self, name: str) -> Conductor:
        """Return a conductor of the line or, if it has none of this name, of the library.

        Parameters
        ----------
        name : str
            Its name.

        Raises
        ------
        InconsistentInputError
            If there is none of this name.
        """
        return self.conductors[name] if name in self.conductors else conductor_named(name)

    @property
    def length(self) -> float:
        """Distance from the first to the last support [m]."""
        return self.support_x[-1] - self.support_x[0]

    @property
    def support_x(self) -> tuple[float, ...]:
        """Position of every support along the track [m]."""
        return tuple(accumulate((span.length for span in self.spans), initial=self.start_chainage))

    @property
    def dropper_x(self) -> tuple[float, ...]:
        """Position of every dropper along the track, in order [m]."""
        return tuple(
            start + x
            for start, span in zip(self.support_x, self.spans, strict=False)
            for x in span.droppers.x
        )

    @property
    def dropper_span(self) -> tuple[int, ...]:
        """Index of the span of every dropper."""
        return tuple(i for i, span in enumerate(self.spans) for _ in span.droppers.x)

    @property
    def dropper_target_height(self) -> tuple[float, ...]:
        """Wanted height of the contact wire at every dropper [m]."""
        return tuple(height for heights in wanted_heights(self) for height in heights)

    @property
    def contact_support_indices(self) -> tuple[int, ...]:
        """Indices of the supports that hold the contact wire."""
        return tuple(i for i, support in enumerate(self.supports) if support.contact_wire is not None)

    @property
    def contact_heights(self) -> tuple[float, ...]:
        """Height of the contact wire at every support; between those that hold it on a straight line [m]."""
        held = held_heights(self)
        return tuple(between(held, x) for x in self.support_x)

    @property
    def stitched_supports(self) -> tuple[int, ...]:
        """Indices of the supports that have a stitch wire."""
        if self.stitch_wire is None:
            return ()
        inner = range(1, len(self.supports) - 1)
        return tuple(
            i
            for i, support in enumerate(self.supports)
            if (i in inner if support.stitch_wire is None else support.stitch_wire)
        )


@lru_cache(maxsize=64)
def _alignment(track: Track, start_chainage: float) -> Alignment:
    return Alignment.of(track, start_chainage)
