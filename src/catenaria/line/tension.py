"""The prescribed tension of a wire, and the device at its end that makes it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Literal, cast

from annotated_types import Gt, Le
from pydantic import Field, Strict, model_validator

from catenaria.line.base import LineModel, Problem, refuse
from catenaria.units import PositiveForce, PositiveStiffness


class Device(LineModel):
    """What pulls the end of a wire. Its force is that of the tension times its efficiency."""

    kind: Literal["weight", "spring", "hydraulic", "fixed"] = Field(
        default="weight",
        description=(
            "weight: weights on a wheel or pulleys. hydraulic: a piston with constant force. spring: its "
            "force falls as the wire grows longer. fixed: a termination that is tensioned once and stays."
        ),
    )
    efficiency: Annotated[float, Strict(), Gt(0.0), Le(1.0)] = Field(
        default=1.0, description="Share of the device's force that reaches the wire, above 0 and at most 1."
    )
    stiffness: PositiveStiffness | None = Field(
        default=None,
        description="Stiffness of a spring, for load cases; the form is found with the given force.",
    )

    @model_validator(mode="after")
    def _stiffness_of_a_spring(self) -> Device:
        refuse("Device", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        if self.kind == "spring" and self.stiffness is None:
            yield Problem(("stiffness",), None, "a value, for the device is a spring", "missing")
        if self.kind != "spring" and self.stiffness is not None:
            yield Problem(("stiffness",), self.stiffness, "a stiffness only where kind is spring")


class Tension(LineModel):
    """The prescribed tension of a wire and where it is measured.

    Examples
    --------
    >>> Tension(force=15e3, device=Device(efficiency=0.97)).on_wire
    14550.0
    """

    force: PositiveForce = Field(description="The wanted tension: the force of the tensioning device.")
    measure: Literal["reaction", "strain"] = Field(
        default="reaction",
        description=(
            "reaction: the force with which the tensioning device at the wire's end reacts; right on any "
            "mesh. strain: the axial force (11) of Yang et al. 2017 at the end support; depends on the mesh."
        ),
    )
    at: Literal["start", "end"] = Field(
        default="end",
        description=(
            "The end of the wire at which it is measured; if left out, the pulled one, and the end of the "
            "line if both are."
        ),
    )
    pulled: Literal["both", "start", "end"] = Field(
        default="both", description="Which ends are pulled; the other one is a fixed termination."
    )
    device: Device = Field(default=Device(), description="What pulls the ends.")

    @model_validator(mode="before")
    @classmethod
    def _at_the_device(cls, data: object) -> object:
        """Where nothing is said, the tension is that of the device, which may be at one end only."""
        if not isinstance(data, Mapping):
            return data
        given = cast("Mapping[str, object]", data)
        alone = given.get("pulled") in ("start", "end") and "at" not in given
        return {**given, "at": given["pulled"]} if alone else given

    @property
    def on_wire(self) -> float:
        """Force that reaches the wire [N]."""
        return self.force * self.device.efficiency
