"""What the engineer describes: models of the line file, how it is read, checked and summarised."""

from __future__ import annotations

from catenaria.line.conductor import Conductor
from catenaria.line.control import (
    ContactTensionControl,
    DropperForceControl,
    HeightControl,
    MessengerTensionControl,
    TensionControl,
)
from catenaria.line.dropper import DropperKind, Droppers
from catenaria.line.line import Line
from catenaria.line.load import load_line
from catenaria.line.mesh_caution import mesh_caution
from catenaria.line.mesh_options import read_mesh, with_mesh
from catenaria.line.schema import schema
from catenaria.line.solver import DynamicOptions, Integrator, Mesh, Rayleigh, Settle, Solver
from catenaria.line.source import Source
from catenaria.line.span import Span
from catenaria.line.summary import summarise
from catenaria.line.support import ContactSupport, MessengerSupport, SteadyArm, Support
from catenaria.line.track import Curve, Gradient, Track
from catenaria.line.unsupported import refuse_unsupported
from catenaria.line.wire import OtherWire, Tension, Wire

__all__ = [
    "Conductor",
    "ContactSupport",
    "ContactTensionControl",
    "Curve",
    "DropperForceControl",
    "DropperKind",
    "Droppers",
    "DynamicOptions",
    "Gradient",
    "HeightControl",
    "Integrator",
    "Line",
    "Mesh",
    "MessengerSupport",
    "MessengerTensionControl",
    "OtherWire",
    "Rayleigh",
    "Settle",
    "Solver",
    "Source",
    "Span",
    "SteadyArm",
    "Support",
    "Tension",
    "TensionControl",
    "Track",
    "Wire",
    "load_line",
    "mesh_caution",
    "read_mesh",
    "refuse_unsupported",
    "schema",
    "summarise",
    "with_mesh",
]
