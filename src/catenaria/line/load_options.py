"""Load cases from options of the command line."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path as FilePath

from pydantic import ValidationError

from catenaria.errors import Fault, InconsistentInputError, LineFileError
from catenaria.line.base import closest
from catenaria.line.faults import faults_of, place_of
from catenaria.line.load_case import LoadCase, LoadCases, load_cases
from catenaria.line.source import Source


def read_cases(
    files: Sequence[str] = (),
    temperatures: Sequence[str] = (),
    wind: str | None = None,
    pushes: Sequence[str] = (),
) -> LoadCases:
    """Read the load cases that options name.

    Parameters
    ----------
    files : sequence of str
        Files of load cases; ``FILE:NAME`` takes one of them.
    temperatures : sequence of str
        Changes of temperature such as ``40 K``, or temperatures such as ``55 degC``.
    wind : str, optional
        Speed, such as ``26 m/s``, or speed and direction: ``26 m/s@270 deg``.
    pushes : sequence of str
        Forces and chainages, such as ``200 N@1234 m``.

    Returns
    -------
    LoadCases
        Wind and pushes act together, at every one of the temperatures.

    Raises
    ------
    LineFileError, InconsistentInputError
        If one of them cannot be read, or two cases have one name.

    Examples
    --------
    >>> cases = read_cases(temperatures=["40 K", "-30 K"], wind="26 m/s").cases
    >>> list(cases), cases["warmer 40 K + wind 26"].wind.speed
    (['warmer 40 K + wind 26', 'colder 30 K + wind 26'], 26.0)
    """
    if len(files) == 1 and not (temperatures or wind or pushes):
        return _from_file(files[0])
    parts = [_from_file(name) for name in files]
    if temperatures or wind is not None or pushes:
        parts.append(_from_options(temperatures, wind, pushes))
    cases: dict[str, LoadCase] = {}
    for part in parts:
        for name, case in part.cases.items():
            if name in cases:
                raise InconsistentInputError(f"there are two load cases {name!r}; give each its own name")
            cases[name] = case
    if not cases:
        raise InconsistentInputError("no load case: give --case FILE, or --temperature, --wind or --push")
    return LoadCases(format=1, cases=cases)


def _from_file(text: str) -> LoadCases:
    """Read a file, or the one case of it that stands behind a colon."""
    name, colon, chosen = text.rpartition(":")
    if not colon or FilePath(text).exists():
        return load_cases(text)
    cases = load_cases(name)
    if chosen not in cases.cases:
        names = ", ".join(cases.cases)
        fault = Fault(name, 0, 0, "--case", repr(chosen), f"{names}{closest(chosen, cases.cases)}")
        raise LineFileError((fault,))
    return cases.model_copy(update={"cases": {chosen: cases.cases[chosen]}})


def _from_options(temperatures: Sequence[str], wind: str | None, pushes: Sequence[str]) -> LoadCases:
    common: dict[str, object] = {}
    if wind is not None:
        speed, at, direction = (part.strip() for part in wind.partition("@"))
        common["wind"] = {"speed": speed, "direction": direction} if at else {"speed": speed}
    common["push"] = [_push(text) for text in pushes]
    if not temperatures:
        case = _validated(common)
        return LoadCases(format=1, cases={_name(case): case})
    cases: dict[str, LoadCase] = {}
    for text in temperatures:
        field = "actual" if text.strip().endswith("degC") else "change"
        case = _validated({**common, "temperature": {field: text}})
        cases[_name(case)] = case
    return LoadCases(format=1, cases=cases)


def _push(text: str) -> dict[str, str]:
    force, at, chainage = (part.strip() for part in text.partition("@"))
    if not at:
        raise LineFileError((Fault("--push", 0, 0, "push", repr(text), "FORCE@CHAINAGE, as 200N@1234m"),))
    return {"force": force, "chainage": chainage}


def _validated(tree: dict[str, object]) -> LoadCase:
    try:
        return LoadCase.model_validate(tree)
    except ValidationError as error:
        problems = {place_of(problem): problem for problem in error.errors(include_url=False)}
        raise LineFileError(faults_of(problems, tree, Source("command line"))) from error


def _name(case: LoadCase) -> str:
    """Say in words of a folder's name what acts."""
    parts: list[str] = []
    if case.temperature is not None and case.temperature.actual is not None:
        parts.append(f"at {case.temperature.actual:g} degC")
    elif case.temperature is not None:
        change = case.warming(0.0)
        parts.append(f"{'colder' if change < 0.0 else 'warmer'} {abs(change):g} K")
    if case.wind is not None:
        side = "" if case.wind.direction == 90.0 else f" from {case.wind.direction:g} deg"
        parts.append(f"wind {case.wind.speed:g}{side}")
    parts += [f"push {push.force:g} N at {push.chainage:g} m" for push in case.push]
    return " + ".join(parts)
