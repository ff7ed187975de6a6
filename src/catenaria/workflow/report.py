"""From a result to its checks and its report."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from catenaria.report.checks import Check, judge, load_rules
from catenaria.report.html.page import Contents, page
from catenaria.results import FormResult, load_result
from catenaria.results.case import LoadStudy
from catenaria.results.elasticity import ElasticityStudy
from catenaria.results.store import JSON_NAME
from catenaria.workflow.pdf import print_to_pdf

Study = TypeVar("Study", ElasticityStudy, LoadStudy)

_OTHER = "another state of the line, or of another method"


@dataclass(frozen=True)
class Studies:
    """Studies of a result that were found beside it, and notes about those that do not belong to it."""

    elasticity: ElasticityStudy | None = None
    loads: LoadStudy | None = None
    notes: tuple[str, ...] = ()


def check_result(
    source: FormResult | str | os.PathLike[str],
    speed: float | None = None,
    rules: str | os.PathLike[str] | None = None,
) -> tuple[Check, ...]:
    """Check a result by rules of standards and practice.

    Parameters
    ----------
    source : FormResult or path
        What was found, or the folder in which it was written; studies of elasticity beside the folder count.
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
    >>> [check.verdict for check in workflow.check_result(found, speed=200 / 3.6)][:3]
    ['passes', 'not judged', 'passes']
    """
    result, studies = _opened(source)
    return judge(result, load_rules(_path(rules)), speed, studies.elasticity)


def report(
    source: FormResult | str | os.PathLike[str],
    speed: float | None = None,
    rules: str | os.PathLike[str] | None = None,
    date: str = "",
) -> str:
    """Return the report of a result: one HTML page that needs nothing but itself.

    Parameters
    ----------
    source : FormResult or path
        What was found, or the folder in which it was written; studies of elasticity and of load cases beside
        the folder become part of the report.
    speed : float, optional
        Of trains [m/s]; by default that of the line file.
    rules : path, optional
        File of rules; by default those of catenaria.
    date : str
        As it shall stand in the report; without it there is none, and equal results give equal reports.

    Raises
    ------
    LineFileError, InconsistentInputError
        If a file cannot be used.
    UnsupportedError
        If Jinja or Plotly are not installed.
    """
    result, studies = _opened(source)
    return page(
        Contents(
            result=result,
            rules=load_rules(_path(rules)),
            speed=speed,
            elasticity=studies.elasticity,
            loads=studies.loads,
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


def studies_beside(source: Path, result: FormResult) -> Studies:
    """Return the studies of a result in folders beside its own, named like it with what they are behind.

    Raises
    ------
    InconsistentInputError
        If one of them is damaged.
    """
    folder = (source if source.is_dir() else source.parent).resolve()
    elasticity = _study(folder, "elasticity", ElasticityStudy)
    loads = _study(folder, "loads", LoadStudy)
    found = {"elasticity": elasticity, "loads": loads}
    foreign = [
        what
        for what, study in found.items()
        if study is not None and (study.inputs != result.inputs or study.method != result.method)
    ]
    return Studies(
        None if "elasticity" in foreign else elasticity,
        None if "loads" in foreign else loads,
        tuple(f"{folder.name}-{what} is left out: it is of {_OTHER}." for what in foreign),
    )


def _study(folder: Path, what: str, kind: type[Study]) -> Study | None:
    beside = folder.with_name(f"{folder.name}-{what}")
    return load_result(beside, kind) if (beside / JSON_NAME).exists() else None


def _path(file: str | os.PathLike[str] | None) -> Path | None:
    return None if file is None else Path(file)
