"""Free structures of cables and rods: models of their description, and the systems made of them."""

from __future__ import annotations

from catenaria.line.conductor import Conductor
from catenaria.structure.cable import Cable
from catenaria.structure.control import BalanceTarget, HeightTarget, TensionTarget
from catenaria.structure.joint import Attachment, Joint, PointMass
from catenaria.structure.load import load_structure
from catenaria.structure.section import Stiffnesses
from catenaria.structure.structure import Solver, Structure

__all__ = [
    "Attachment",
    "BalanceTarget",
    "Cable",
    "Conductor",
    "HeightTarget",
    "Joint",
    "PointMass",
    "Solver",
    "Stiffnesses",
    "Structure",
    "TensionTarget",
    "load_structure",
]
