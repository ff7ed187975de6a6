"""What the engineer describes: models of the line file, how it is read, checked and summarised."""

from __future__ import annotations

from catenaria.line.conductor import Conductor
from catenaria.line.contact_support import ContactSupport
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
from catenaria.line.messenger_support import AuxiliarySupport, Cantilever, MessengerSupport
from catenaria.line.point_mass import PointMass
from catenaria.line.schema import schema
from catenaria.line.solver import DynamicOptions, Integrator, Mesh, Rayleigh, Settle, Solver
from catenaria.line.source import Source
from catenaria.line.span import AuxiliarySpan, Span
from catenaria.line.steady_arm import Hinge, SteadyArm
from catenaria.line.summary import summarise
from catenaria.line.support import Support
from catenaria.line.tension import Device, Tension
from catenaria.line.tied_wire import MidPoint, StitchWire
from catenaria.line.track import Curve, Gradient, Track
from catenaria.line.unsupported import refuse_for_method, refuse_unsupported
from catenaria.line.wire import Anchor, SecondContactWire, Wire

__all__ = [
    "Anchor",
    "AuxiliarySpan",
    "AuxiliarySupport",
    "Cantilever",
    "Conductor",
    "ContactSupport",
    "ContactTensionControl",
    "Curve",
    "Device",
    "DropperForceControl",
    "DropperKind",
    "Droppers",
    "DynamicOptions",
    "Gradient",
    "HeightControl",
    "Hinge",
    "Integrator",
    "Line",
    "Mesh",
    "MessengerSupport",
    "MessengerTensionControl",
    "MidPoint",
    "PointMass",
    "Rayleigh",
    "SecondContactWire",
    "Settle",
    "Solver",
    "Source",
    "Span",
    "SteadyArm",
    "StitchWire",
    "Support",
    "Tension",
    "TensionControl",
    "Track",
    "Wire",
    "load_line",
    "mesh_caution",
    "read_mesh",
    "refuse_for_method",
    "refuse_unsupported",
    "schema",
    "summarise",
    "with_mesh",
]
