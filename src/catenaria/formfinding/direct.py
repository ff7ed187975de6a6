"""The direct method: equilibrium together with all targets, in one Newton iteration for each wire.

The same systems as those of the dynamic equilibrium method, without inertia and with controls as equations:
the fixed point of the controlled motion with dead bands of zero, staged like the paper's three steps. Lines
in space are found all at once; see `catenaria.formfinding.spatial`.
"""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.errors import NotConvergedError, SingularError
from catenaria.formfinding.find_wire import find_wire
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.refusals import dropper_names, refuse_compression
from catenaria.formfinding.spatial.direct import find_directly
from catenaria.formfinding.third_step import gather
from catenaria.formfinding.wire_task import guessed_clamps
from catenaria.line import Line
from catenaria.results.form import FormResult


@dataclass(frozen=True)
class Direct:
    """The method, ready to be run on lines.

    Parameters
    ----------
    listener : callable, optional
        Is told which stage begins.
    """

    listener: Listener | None = None

    def find_form(self, line: Line, start: FormResult | None = None) -> FormResult:
        """Find the form of a line.

        Parameters
        ----------
        line : Line
            What the engineer describes.
        start : FormResult, optional
            An earlier result to begin from instead of a taut wire.

        Returns
        -------
        FormResult

        Raises
        ------
        NotConvergedError
            If neither Newton's method nor load stepping finds a wire at rest; the error says how far it came.
        InfeasibleError
            If the schedule cannot be built.
        SingularError
            If what is prescribed leaves a motion free.
        """
        if not line.plane:
            return find_directly(line, self.listener, start)
        begin = perf_counter()
        self._tell("contact wire", 1, begin)
        names = dropper_names(line)
        setup = contact_wire_setup(line)
        try:
            contact = find_wire(setup, names, start)
        except (NotConvergedError, SingularError):
            refuse_compression(line, guessed_clamps(setup, names))  # the likely reason, if a taut wire has it
            raise
        below = contact.clamped
        refuse_compression(line, below)
        self._tell("messenger wire", 2, begin)
        messenger = find_wire(
            messenger_wire_setup(line, below.lift, below.height, below.position[:, 0]), names, start
        )
        self._tell("lengths", 3, begin)
        found = contact, messenger
        work = contact.work, messenger.work
        reason = f"Newton's method converged in {work[0].steps} and {work[1].steps} iterations"
        rests = tuple(wire.task.rest(wire.z) for wire in found)
        return gather(line, "direct", reason + contact.how + messenger.how, rests[0], rests[1], work)

    def _tell(self, stage: str, number: int, begin: float) -> None:
        if self.listener is not None:
            self.listener(Progress(stage, number, 3, elapsed=perf_counter() - begin))
