"""The figures of validation cases."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from matplotlib.figure import Figure

from catenaria.errors import InconsistentInputError
from catenaria.report import history_figures, line_figures, structure_figures
from catenaria.report.validation_figures import difference_figure, tension_measure_figure
from catenaria.results import FormResult
from catenaria.results.structure import StructureForm
from catenaria.validation import Drawing
from catenaria.workflow.validate import ValidatedCase


def draw(case: ValidatedCase, drawing: Drawing) -> Figure:
    """Draw one figure of a case.

    Raises
    ------
    InconsistentInputError
        If it is not known how.
    """
    results = [case.results[run] for run in drawing.runs]
    lines = [result for result in results if isinstance(result, FormResult)]
    forms = [result for result in results if isinstance(result, StructureForm)]
    if drawing.drawn in LINE and lines:
        return LINE[drawing.drawn](lines[0])
    if drawing.drawn in STRUCTURE and forms:
        return STRUCTURE[drawing.drawn](forms[0], drawing.of, drawing.marks)
    if drawing.drawn == "tension measure" and lines:
        return tension_measure_figure(lines, drawing.marks)
    if drawing.drawn == "differences":
        return _differences(case, drawing)
    known = ", ".join((*LINE, *STRUCTURE, "tension measure", "differences"))
    raise InconsistentInputError(
        f"{drawing.drawn!r} cannot be drawn of {drawing.runs[0]!r}; there is {known}"
    )


LINE: dict[str, Callable[[FormResult], Figure]] = {
    "configurations": line_figures.configuration_figure,
    "contact wire": line_figures.contact_wire_figure,
    "contact tension": lambda result: line_figures.tension_figure(result, result.wires[0]),
    "messenger tension": lambda result: line_figures.tension_figure(result, result.wires[1]),
    "support tensions": history_figures.support_tension_figure,
    "control velocities": history_figures.velocity_figure,
    "control errors": history_figures.error_figure,
}

STRUCTURE: dict[str, Callable[[StructureForm, Sequence[str], Mapping[str, float]], Figure]] = {
    "joint heights": structure_figures.joint_height_figure,
    "joint forces": structure_figures.joint_force_figure,
    "velocities": structure_figures.velocity_figure,
}


def _differences(case: ValidatedCase, drawing: Drawing) -> Figure:
    chosen = [each for each in case.outcome.comparisons if each.check.title in drawing.of]
    differences = {
        column.runs[0]: difference
        for each in chosen
        for column, difference in zip(each.check.columns, each.difference, strict=True)
    }
    first = chosen[0].check
    label = f"difference [{first.unit}]"
    return difference_figure(f"{first.title}: {first.source}", label, differences, first.tolerances[0])
