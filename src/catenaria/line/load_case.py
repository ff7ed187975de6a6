"""Load cases: what may act on a line after it was built, by name, in a file of their own."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path as FilePath
from typing import Annotated, Any, Final, Literal

from annotated_types import Ge, Gt, Le
from pydantic import ConfigDict, Field, PrivateAttr, Strict, field_validator, model_validator
from pydantic_core import PydanticCustomError

from catenaria.line.base import LineModel, Problem, exactly_one, refuse
from catenaria.line.load import load_model
from catenaria.line.load_units import Angle, CelsiusTemperature, Force, LoadPerLength, Speed, Warming
from catenaria.line.source import Source
from catenaria.units import Length, NonNegativeLength, PositiveDensity

_NAME: Final = re.compile(r"[\w][\w .+-]*")
_FILE: Final = re.compile(r".*\.(csv|json|npz|png)", re.IGNORECASE)  # as files beside the folders of cases


class TemperatureLoad(LineModel):
    """How much warmer or colder than the line's `reference_temperature` wires and droppers are."""

    model_config = ConfigDict(json_schema_extra=exactly_one("change", "actual"))

    change: Warming | None = Field(
        default=None,
        description="Change of temperature, negative if colder. Give this or actual.",
    )
    actual: CelsiusTemperature | None = Field(
        default=None,
        description="Temperature of wires and droppers. Give this or change.",
    )

    @model_validator(mode="after")
    def _one_of_both(self) -> TemperatureLoad:
        refuse("TemperatureLoad", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        if self.change is None and self.actual is None:
            yield Problem(("change",), None, "a value: one of change and actual is needed", "missing")
        if self.change is not None and self.actual is not None:
            yield Problem(("actual",), self.actual, "this or change, not both")

    def warming(self, reference: float) -> float:
        """Return the change of temperature [K] from a reference temperature [degC]."""
        if self.actual is not None:
            return self.actual - reference
        return self.change or 0.0


class Wind(LineModel):
    """Wind, level, on wires and droppers: what is normal to them of it acts on them."""

    speed: Speed = Field(description="Speed of the air.")
    direction: Angle = Field(
        default=90.0,
        description=(
            "Where the wind comes from, clockwise from growing chainage: 0 from ahead, 90 from the right (it "
            "blows to the left), 180 from behind, 270 from the left; degrees if without unit."
        ),
    )
    follows: Literal["track", "space"] = Field(
        default="track",
        description=(
            "track: the direction is the same relative to the track everywhere, also in curves. space: the "
            "same everywhere in space, relative to the track at the first support."
        ),
    )
    air_density: PositiveDensity = Field(default=1.25, description="Density of the air.")
    drag: Annotated[float, Strict(), Gt(0.0), Le(3.0)] = Field(
        default=1.1, description="Drag coefficient of wires and droppers, customarily 1.0 to 1.2."
    )
    gust_factor: Annotated[float, Strict(), Gt(0.0), Le(5.0)] = Field(
        default=1.0, description="Factor of the wind pressure for gusts; 1 if the speed is that of gusts."
    )
    on: tuple[Literal["wires", "droppers"], ...] = Field(
        default=("wires", "droppers"), min_length=1, description="On what it acts."
    )


class Ice(LineModel):
    """Ice on wires, in one of three ways: by load, by thickness, or by altitude."""

    messenger_wire: LoadPerLength | None = Field(
        default=None,
        description="Weight on the messenger wire and on all wires but contact wires, by length.",
    )
    contact_wire: LoadPerLength | None = Field(
        default=None, description="Weight on a contact wire; half of that on the messenger if left out."
    )
    altitude: Length | None = Field(
        default=None,
        description=(
            "Altitude above the sea, from which the Spanish rule (IFE) has 0, 3.5, 7 or 15 N/m on the "
            "messenger wire up to 500, 1000, 1500 m and above, and half of it on a contact wire."
        ),
    )
    thickness: NonNegativeLength | None = Field(
        default=None, description="Of a ring of ice around all wires and droppers, which wind meets too."
    )
    density: PositiveDensity = Field(default=900.0, description="Density of the ice of given thickness.")

    @model_validator(mode="after")
    def _one_way(self) -> Ice:
        refuse("Ice", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        given = [
            name for name in ("messenger_wire", "altitude", "thickness") if getattr(self, name) is not None
        ]
        if not given and self.contact_wire is None:
            ways = "one of messenger_wire (with contact_wire), altitude and thickness is needed"
            yield Problem(("messenger_wire",), None, f"a value: {ways}", "missing")
        elif not given:
            yield Problem(("messenger_wire",), None, "a value, for contact_wire is given", "missing")
        for name in given[1:]:
            yield Problem((name,), getattr(self, name), f"this or {given[0]}, not both")
        if self.contact_wire is not None and given and given[0] != "messenger_wire":
            yield Problem(("contact_wire",), self.contact_wire, "this only with messenger_wire")


class BrokenDropper(LineModel):
    """A dropper that is broken or missing."""

    span: Annotated[int, Strict(), Ge(1)] = Field(description="Number of the span, from 1.")
    number: Annotated[int, Strict(), Ge(1)] = Field(description="Number of the dropper in it, from 1.")
    wire: str | None = Field(
        default=None,
        description="The wire that it carries, where several have droppers; all of them if left out.",
    )


class MovedSupport(LineModel):
    """A support that has moved with the wires that it holds."""

    support: str = Field(description="Name of the support.")
    wire: str | None = Field(default=None, description="One wire whose hold has moved; all if left out.")
    along: Length = Field(default=0.0, description="Forward along the track.")
    lateral: Length = Field(default=0.0, description="To the left in the canted track plane.")
    vertical: Length = Field(default=0.0, description="Upwards, normal to the canted track plane.")


class Push(LineModel):
    """A static force on a wire, as a pantograph's."""

    chainage: Length = Field(description="Where it acts.")
    force: Force = Field(description="Upwards, normal to the canted track plane.")
    wire: str = Field(default="contact wire", description="On which wire.")


class LoadCase(LineModel):
    """What acts on the line together. A case in which nothing is given is the line as it was built.

    Examples
    --------
    >>> case = LoadCase(temperature={"change": "40 K"}, wind={"speed": "26 m/s"})
    >>> case.warming(15.0), case.wind.speed
    (40.0, 26.0)
    """

    description: str = Field(default="", description="Whatever a reader should know.")
    temperature: TemperatureLoad | None = Field(default=None, description="Change of temperature.")
    wind: Wind | None = Field(default=None, description="Wind.")
    ice: Ice | None = Field(default=None, description="Ice.")
    broken_droppers: tuple[BrokenDropper, ...] = Field(default=(), description="Droppers that are missing.")
    moved_supports: tuple[MovedSupport, ...] = Field(default=(), description="Supports that have moved.")
    push: tuple[Push, ...] = Field(default=(), description="Forces at points of wires.")

    def warming(self, reference: float) -> float:
        """Return the change of temperature [K] from a reference temperature [degC]."""
        return 0.0 if self.temperature is None else self.temperature.warming(reference)


class LoadCases(LineModel):
    """A file of load cases."""

    format: Literal[1] = Field(description="Version of this file format: 1.")
    cases: dict[str, LoadCase] = Field(description="Load cases by name; results are filed under it.")

    _source: Source = PrivateAttr(default_factory=Source)

    def model_post_init(self, context: Any, /) -> None:
        """Keep the places in the file, which the reader hands over."""
        if isinstance(context, Source):
            self._source = context

    @field_validator("format", mode="before")
    @classmethod
    def _whole_number(cls, value: object) -> object:
        if type(value) is not int:
            raise PydanticCustomError("value", "{allowed}", {"allowed": "1"})
        return value

    @model_validator(mode="after")
    def _named(self) -> LoadCases:
        refuse("LoadCases", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        if not self.cases:
            yield Problem(("cases",), {}, "one load case or more, each with its name")
        folders: dict[str, str] = {}
        for name in self.cases:
            same = folders.setdefault(name.casefold(), name)
            if same != name:
                yield Problem(("cases", name), name, f"a name that differs from {same} by more than its case")
            if not _NAME.fullmatch(name) or name.endswith((".", " ")) or _FILE.fullmatch(name):
                allowed = "a name of letters, digits, spaces and _ . + - that can be one of a folder"
                yield Problem(("cases", name), name, allowed)

    @property
    def source(self) -> Source:
        """Where in its file everything stands."""
        return self._source


def load_cases(path: str | FilePath) -> LoadCases:
    """Read and check a file of load cases.

    Parameters
    ----------
    path : str or pathlib.Path
        A YAML file, or a JSON file with the suffix ``.json``.

    Returns
    -------
    LoadCases
        With every quantity in SI, temperatures in degrees Celsius and angles in degrees.

    Raises
    ------
    LineFileError
        With one `Fault` for each thing that is wrong, in the order of the file.
    """
    return load_model(path, LoadCases)
