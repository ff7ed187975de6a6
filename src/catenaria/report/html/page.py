"""One HTML page of a result that needs nothing but itself: style, script, figures and tables are in it."""

from __future__ import annotations

import io
import json
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

import numpy as np
from ruamel.yaml import YAML

from catenaria.errors import UnsupportedError
from catenaria.line import Line
from catenaria.line.summary import summarise
from catenaria.report.checks import Check, Rules, judge
from catenaria.report.html import figures, study_figures, study_tables, tables
from catenaria.report.html.drawing import Drawing
from catenaria.report.html.sketch import sketch
from catenaria.results import FormResult
from catenaria.results.case import LoadStudy
from catenaria.results.elasticity import ElasticityStudy

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
    elasticity, loads
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
    checks = judge(result, contents.rules, speed, contents.elasticity)
    sections = _figures(contents)
    drawings = [one for section in sections.values() for one in section]
    return {
        "result": result,
        "contents": contents,
        "line": line,
        "speed": "" if speed is None else f"{3.6 * speed:.4g} km/h",
        "summary": summarise(line),
        "headline": _headline(result),
        "sketch": sketch(result, line),
        "judged": [check for check in checks if check.rule],
        "stated": [check for check in checks if not check.rule],
        "verdicts": _verdicts(checks),
        "figures": sections,
        "tables": tables,
        "study_tables": study_tables,
        "echo": echo(line),
        "drawings": _script([_plain(one) for one in drawings]),
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
        else [study_figures.elasticity_figure(contents.elasticity)],
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


def echo(line: Line) -> str:
    """Return the line as YAML in SI, short where it can be."""
    writer: Any = YAML(typ="safe", pure=True)
    writer.default_flow_style = None
    writer.sort_base_mapping_type_on_output = False
    writer.width = 110
    stream = io.StringIO()
    writer.dump(line.model_dump(mode="json", exclude_none=True), stream)
    return stream.getvalue()


def _plain(one: Drawing) -> dict[str, Any]:
    return {"id": one.id, "data": one.data, "layout": one.layout | {"height": one.height}}


def _script(value: Any) -> str:
    """Return JSON that may stand within a script element, whatever texts are in it."""
    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _plotly() -> str:
    """Return Plotly's own script, which is part of its Python package."""
    from plotly.offline import get_plotlyjs  # pyright: ignore[reportMissingTypeStubs, reportUnknownVariableType]

    script: str = get_plotlyjs()  # pyright: ignore[reportUnknownVariableType]
    return script.replace("</script", "<\\/script")
