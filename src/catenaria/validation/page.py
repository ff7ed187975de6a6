"""Validation outcomes as Markdown: an overview, and a page for each case."""

from __future__ import annotations

from collections.abc import Sequence

from catenaria.validation.case import Check, Drawing
from catenaria.validation.verdict import CaseOutcome, Comparison, Verdict

FIGURES = "figures"


def overview(outcomes: Sequence[CaseOutcome]) -> str:
    """Return the overview of several cases."""
    rows = [
        [f"[{outcome.case.title}]({outcome.name}.md)", outcome.case.source, *map(str, outcome.counts)]
        for outcome in outcomes
    ]
    return "\n".join(
        (
            "# Validation",
            "",
            "Numbers of the literature and independent ones beside those that catenaria computes. "
            "`catenaria validate` computes them anew and fails if one differs; "
            "`catenaria validate --out FOLDER` writes these pages.",
            "",
            "A number *agrees* within its tolerance, whose reason is given. Beyond it the difference is "
            "*explained*, if it is understood and not larger than what the reason accounts for; or the "
            "number *differs*, and the validation has failed.",
            "",
            *_table(["case", "source", *(verdict.value for verdict in Verdict)], rows),
            "",
        )
    )


def case_page(outcome: CaseOutcome) -> str:
    """Return the page of a case; its figures are expected in the folder `FIGURES` beside it."""
    case = outcome.case
    parts = [f"# {case.title}", f"Reference: {case.source}.", case.text.strip(), _summary(outcome)]
    parts += ["## Numbers", *(_comparison(comparison) for comparison in outcome.comparisons)]
    if case.discussion:
        parts += ["## Discussion", case.discussion.strip()]
    if case.figures:
        parts += ["## Figures", *(_figure(outcome.name, drawing) for drawing in case.figures)]
    return "\n\n".join(parts) + "\n"


def figure_name(case: str, drawing: Drawing) -> str:
    """Return the file name of a figure."""
    return f"{case}_{drawing.name}.png"


def headings(check: Check) -> list[str]:
    """Return the headings of a check's table."""
    unit = f" [{check.unit}]" if check.unit else ""
    columns = [text for column in check.columns for text in (f"{column.title}{unit}", "difference")]
    return ["", f"reference{unit}", *columns, f"tolerance{unit}", "verdict"]


def cells(comparison: Comparison) -> list[list[str]]:
    """Return the rows of a check's table as texts; the verdict is the worst of the row's columns."""
    check, order = comparison.check, list(Verdict)
    rows: list[list[str]] = []
    for i, name in enumerate(check.rows):
        row = [name, f"{check.reference[i]:.8g}"]
        for observed, difference in zip(comparison.observed, comparison.difference, strict=True):
            row += [_number(observed[i], check.decimals), _number(difference[i], check.decimals, "+")]
        worst = max((verdicts[i] for verdicts in comparison.verdicts), key=order.index)
        rows.append([*row, f"{check.tolerances[i]:.4g}", worst.value])
    return rows


def _number(value: float, decimals: int, sign: str = "") -> str:
    """Return a number with so many decimals; zero has no sign."""
    text = f"{value:{sign}.{decimals}f}"
    return text if float(text) else f"{0.0:.{decimals}f}"


def _summary(outcome: CaseOutcome) -> str:
    agree, explained, differ = outcome.counts
    return f"Of these numbers {agree} agree, {explained} differ and are explained, and {differ} differ."


def _comparison(comparison: Comparison) -> str:
    check = comparison.check
    lines = [f"### {check.title}", "", f"Reference: {check.source}. Tolerance: {check.reason}.", ""]
    lines += _table(headings(check), cells(comparison))
    if comparison.explanation:
        lines += ["", comparison.explanation]
    return "\n".join(lines)


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    align = ["---", *("---:" if _is_number(cell) else "---" for cell in rows[0][1:])]
    return [f"| {' | '.join(row)} |" for row in (header, align, *rows)]


def _is_number(cell: str) -> bool:
    return cell[:1].isdigit() or cell[:1] in "+-"


def _figure(case: str, drawing: Drawing) -> str:
    paper = f"Beside {drawing.paper} of the paper. " if drawing.paper else ""
    text = f"{paper}{drawing.text}"
    return f"![{drawing.name.replace('_', ' ')}]({FIGURES}/{figure_name(case, drawing)})\n\n{text}"
