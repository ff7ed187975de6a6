"""One HTML page of a result that needs nothing but itself: style, script, figures and tables are in it."""

from __future__ import annotations

from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

import numpy as np

from catenaria.errors import UnsupportedError
from catenaria.line import Line
from catenaria.line.summary import summarise
from catenaria.report.checks import Check, Rules, judge
from catenaria.report.html import accuracy_tables, figures, study_figures, study_tables, tables
from catenaria.report.html.clamps import clamp_tables
from catenaria.report.html.contact_tables import contact_tables
from catenaria.report.html.drawing import Drawing
from catenaria.report.html.sketch import sketch
from catenaria.report.html.texts import echo, script_data, style_text
from catenaria.results import FormResult
from catenaria.results.case import LoadStudy
from catenaria.results.elasticity import ElasticityStudy
from catenaria.results.rounding import RoundingStudy
from catenaria.results.tolerance import ToleranceStudy

_NEEDED = ("jinja2", "plotly")


@dataclass(frozen=True)
class Contents:
    """What goes into a page.

    Attributes
    ----------
    result : FormResult
        What was found.
    rules : Rules
        By which it is checked.
    speed : float, optional
        Of trains [m/s]; by default that of the line file.
    elasticity, loads, rounding, tolerances
        Studies of the same result, if there are any.
    date : str
        As it shall stand in the page; empty for none.
    notes : tuple of str
        What else a reader must know.
    """

    result: FormResult
    rules: Rules
    speed: float | None = None
    elasticity: ElasticityStudy | None = None
    loads: LoadStudy | None = None
    rounding: RoundingStudy | None = None
    tolerances: ToleranceStudy | None = None
    date: str = ""
    notes: tuple[str, ...] = field(default=())


def require_report_libraries() -> None:
    """Refuse to go on without the libraries of pages.

    Raises
    ------
    UnsupportedError
        With what to install.
    """
    for name in _NEEDED:
        try:
            import_module(name)
        except ModuleNotFoundError as error:
            raise UnsupportedError(
                f'a report needs {name}, which is not installed: pip install "catenaria[report]"'
            ) from error


def page(contents: Contents) -> str:
    """Return the page.

    Parameters
    ----------
    contents : Contents
        What goes into it; equal contents give equal pages.

    Raises
    ------
    UnsupportedError
        If Jinja or Plotly are not installed.
    """
    require_report_libraries()
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("catenaria.report", "html"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template("template.html.j2").render(_context(contents, environment))


def _context(contents: Contents, environment: Any) -> dict[str, Any]:
    result = contents.result
    line = Line.model_validate(result.inputs)
    speed = line.speed if contents.speed is None else contents.speed
    checks = judge(result, contents.rules, speed, contents.elasticity, contents.loads)
    sections = _figures(contents)
    drawings = [one for section in sections.values() for one in section]
    return {
        "result": result,
        "contents": contents,
        "line": line,
        "speed": "" if speed is None else f"{3.6 * speed:.4g} km/h",
        "summary": summarise(line),
        "footer": style_text(_footer(contents)),
        "headline": _headline(result),
        "sketch": sketch(result, line),
        "judged": [check for check in checks if check.rule],
        "stated": [check for check in checks if not check.rule],
        "verdicts": _verdicts(checks),
        "figures": sections,
        "tables": tables,
        "contact_tables": contact_tables(result, line),
        "clamp_tables": clamp_tables(result),
        "study_tables": study_tables,
        "accuracy_tables": accuracy_tables,
        "echo": echo(line),
        "drawings": script_data([_plain(one) for one in drawings]),
        "plotly": _plotly(),
        "style": environment.loader.get_source(environment, "style.css")[0],
        "script": environment.loader.get_source(environment, "page.js")[0],
    }


def _figures(contents: Contents) -> dict[str, list[Drawing]]:
    result, rule = contents.result, contents.rules.height_at_droppers
    tolerance = None if rule is None else rule.limit
    return {
        "profile": figures.profile_figures(result),
        "heights": figures.height_figures(result, tolerance),
        "plan": figures.plan_figures(result),
        "tension": figures.tension_figures(result),
        "elasticity": []
        if contents.elasticity is None
        else [study_figures.elasticity_figure(contents.elasticity, figures.support_places(result))],
        "cases": [] if contents.loads is None else study_figures.case_figures(contents.loads),
    }


def _headline(result: FormResult) -> list[tuple[str, str]]:
    """Return the numbers that come first."""
    d = result.droppers
    height = float(np.abs(d.height_error).max(initial=0.0))
    tension = max(abs(wire.tension_error) for wire in result.wires)
    numbers = [
        ("droppers", str(d.x.size)),
        ("largest height error", f"{1e3 * height:.3f} mm"),
        ("largest tension error", f"{tension:.2f} N"),
    ]
    if d.x.size:
        numbers.insert(1, ("cut lengths", f"{d.cut_length.min():.3f} to {d.cut_length.max():.3f} m"))
        numbers.append(("slack droppers", str(int(d.slack.sum()))))
    return numbers


def _verdicts(checks: tuple[Check, ...]) -> dict[str, int]:
    ruled = [check.verdict for check in checks if check.rule]
    return {verdict: ruled.count(verdict) for verdict in ("passes", "fails", "not judged")}


def _footer(contents: Contents) -> str:
    """Return what stands at the foot of every page on paper."""
    version = contents.result.versions.get("catenaria", "")
    return ", ".join(text for text in (contents.result.name, contents.date, f"catenaria {version}") if text)


def _plain(one: Drawing) -> dict[str, Any]:
    return {"id": one.id, "data": one.data, "layout": one.layout | {"height": one.height}}


def _plotly() -> str:
    """Return Plotly's own script, which is part of its Python package."""
    from plotly.offline import get_plotlyjs  # pyright: ignore[reportMissingTypeStubs, reportUnknownVariableType]

    script: str = get_plotlyjs()  # pyright: ignore[reportUnknownVariableType]
    return script.replace("</script", "<\\/script")
