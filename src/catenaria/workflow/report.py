"""From a result to its checks and its report, with its elasticity."""

from __future__ import annotations

import os
from pathlib import Path

from catenaria.report.checks import Check, judge, load_rules
from catenaria.report.html.page import Contents, page
from catenaria.results import FormResult, load_result
from catenaria.workflow.elasticity import ElasticityListener
from catenaria.workflow.pdf import print_to_pdf
from catenaria.workflow.studies import Studies, studies_beside


def check_result(
    source: FormResult | str | os.PathLike[str],
    speed: float | None = None,
    rules: str | os.PathLike[str] | None = None,
) -> tuple[Check, ...]:
    """Check a result by rules of standards and practice.

    Parameters
    ----------
    source : FormResult or path
        What was found, or the folder in which it was written; studies of elasticity and of load cases
        beside the folder count.
    speed : float, optional
        Of trains [m/s]; by default that of the line file.
    rules : path, optional
        File of rules; by default those of catenaria.

    Raises
    ------
    LineFileError, InconsistentInputError
        If a file cannot be used.

    Examples
    --------
    >>> from catenaria import workflow
    >>> found = workflow.solve("examples/yang2017_three_span.yaml", rebuild="none")
    >>> [check.verdict for check in workflow.check_result(found, speed=200 / 3.6)][:2]
    ['passes', 'not judged']
    """
    result, studies = _opened(source)
    return judge(result, load_rules(_path(rules)), speed, studies.elasticity, studies.loads)


def report(
    source: FormResult | str | os.PathLike[str],
    speed: float | None = None,
    rules: str | os.PathLike[str] | None = None,
    date: str = "",
    *,
    elasticity: bool = True,
    progress: ElasticityListener | None = None,
) -> str:
    """Return the report of a result: one HTML page that needs nothing but itself.

    Parameters
    ----------
    source : FormResult or path
        What was found, or the folder in which it was written; studies of elasticity, load cases, rounded
        lengths and tolerances beside the folder become part of the report.
    speed : float, optional
        Of trains [m/s]; by default that of the line file.
    rules : path, optional
        File of rules; by default those of catenaria.
    date : str
        As it shall stand in the report; without it there is none, and equal results give equal reports.
    elasticity : bool
        Whether elasticity is part of the report: a study beside the folder, or else one with the defaults of
        `workflow.elasticity`. Results that have none get a note that says why.
    progress : callable, optional
        Receives what is done for that study, how many points of it are done, and of how many.

    Raises
    ------
    LineFileError, InconsistentInputError
        If a file cannot be used.
    UnsupportedError
        If Jinja or Plotly are not installed.
    """
    result, studies = _opened(source)
    studies = studies.with_elasticity(result, progress) if elasticity else studies.without_elasticity()
    return page(
        Contents(
            result=result,
            rules=load_rules(_path(rules)),
            speed=speed,
            elasticity=studies.elasticity,
            loads=studies.loads,
            rounding=studies.rounding,
            tolerances=studies.tolerances,
            date=date,
            notes=studies.notes,
        )
    )


def write_report(text: str, file: str | os.PathLike[str], pdf: bool = False) -> tuple[Path, ...]:
    """Write a report into a file, and print it to a PDF file of the same name if that is wanted.

    Parameters
    ----------
    text : str
        The page.
    file : path
        Where to; an earlier file of this name is replaced.
    pdf : bool
        Whether to print it as well.

    Raises
    ------
    UnsupportedError
        If there is no browser that prints; nothing is written then.
    NotConvergedError
        If the browser does not print; nothing is written then.
    """
    file = Path(file)
    file.parent.mkdir(parents=True, exist_ok=True)
    new, printed = (file.with_name(f".{file.stem}.new{suffix}") for suffix in (".html", ".pdf"))
    try:
        new.write_text(text, encoding="utf-8")
        if not pdf:
            return (new.replace(file),)
        print_to_pdf(new, printed)
        return new.replace(file), printed.replace(file.with_suffix(".pdf"))
    finally:
        new.unlink(missing_ok=True)
        printed.unlink(missing_ok=True)


def _opened(source: FormResult | str | os.PathLike[str]) -> tuple[FormResult, Studies]:
    if isinstance(source, FormResult):
        return source, Studies()
    result = load_result(source)
    return result, studies_beside(Path(source), result)


def _path(file: str | os.PathLike[str] | None) -> Path | None:
    return None if file is None else Path(file)
