"""What a form-finding method says about itself while it works."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Progress:
    """One message.

    Attributes
    ----------
    stage : str
        ``compiling``, ``contact wire``, ``messenger wire``, ``lengths`` or ``rebuild``.
    stage_number, stage_count : int
        Number of the stage, from 1, and how many there are.
    time, step_size : float
        Simulated time and time step [s].
    step, order : int
        Number of accepted time steps and BDF order.
    worst_control : str
        The control with the largest error.
    worst_error_in_bands : float
        That error in units of its dead band.
    elapsed : float
        Wall time since the start [s].
    """

    stage: str
    stage_number: int
    stage_count: int
    time: float = 0.0
    step_size: float = 0.0
    step: int = 0
    order: int = 0
    worst_control: str = ""
    worst_error_in_bands: float = 0.0
    elapsed: float = 0.0


Listener = Callable[[Progress], None]
