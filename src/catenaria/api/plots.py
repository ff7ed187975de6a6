"""The figures of a result, one method for each."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from catenaria.results import FormResult

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Plots:
    """Figures of a result; matplotlib is imported by the first one.

    Every method returns a `matplotlib.figure.Figure` that is not registered with pyplot: save it with
    ``figure.savefig(...)``, or look at it in a notebook after ``%matplotlib inline``.
    """

    form: FormResult = field(repr=False)

    def profile(self) -> Figure:
        """Draw the heights of all wires with droppers, seen from the side."""
        from catenaria.report.space_figures import profile_figure

        return profile_figure(self.form)

    def plan(self) -> Figure:
        """Draw the lateral offsets of all wires with droppers and arms, seen from above."""
        from catenaria.report.space_figures import plan_figure

        return plan_figure(self.form)

    def tension(self, wire: str = "contact wire") -> Figure:
        """Draw the tension along a wire.

        Parameters
        ----------
        wire : str
            Its name.

        Raises
        ------
        InconsistentInputError
            If there is no wire of that name.
        """
        from catenaria.report.line_figures import tension_figure

        return tension_figure(self.form, self.form.wire(wire))

    def moments(self) -> Figure:
        """Draw the bending moments along all wires that supports hold."""
        from catenaria.report.line_figures import moment_figure

        return moment_figure(self.form)
