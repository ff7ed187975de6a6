"""Heights of contact wires that were measured on a built line, from a CSV file."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final, cast

from catenaria.errors import Fault, LineFileError
from catenaria.line.base import closest

if TYPE_CHECKING:
    from pandas import DataFrame

_NAMES: Final = ("span", "dropper", "chainage_m", "height_m", "lower_wire")
_PLACES: Final = "span and dropper, or chainage_m"
_LENGTH: Final = "metres as a plain number, such as 5.502"


@dataclass(frozen=True)
class MeasuredHeight:
    """One row of the file.

    Attributes
    ----------
    height : float
        Height above the canted track [m].
    span, number : int
        The dropper at which it was measured; 0 where a chainage is given instead.
    chainage : float
        Where it was measured [m]; NaN where a dropper is given instead.
    wire : str
        Name of the wire, empty where the file does not say.
    marks : mapping of str to (line, column)
        Where the cells of the row begin in the file.
    """

    height: float
    span: int
    number: int
    chainage: float
    wire: str
    marks: Mapping[str, tuple[int, int]]

    @property
    def at_dropper(self) -> bool:
        """Whether it was measured at a dropper."""
        return self.span > 0


@dataclass(frozen=True)
class MeasuredHeights:
    """What was measured: the name of the file and its rows with a height."""

    file: str
    rows: tuple[MeasuredHeight, ...]

    def fault(self, row: MeasuredHeight, column: str, found: str, allowed: str) -> Fault:
        """Return a fault in one cell of the file."""
        return Fault(self.file, *row.marks[column], column, found, allowed)


def load_measured(path: str | Path) -> MeasuredHeights:
    r"""Read a CSV file of measured heights.

    Parameters
    ----------
    path : path
        With the columns ``height_m``, and ``span`` and ``dropper`` or ``chainage_m``, and ``lower_wire`` if
        need be; further columns are not looked at, so that the file may be made from ``droppers.csv``. A row
        without height is a dropper that was not measured.

    Raises
    ------
    LineFileError
        With one `Fault` for each thing that is wrong, at its row and column.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "heights.csv"
    ...     _ = file.write_text("span,dropper,height_m\n1,2,5.503\n1,3,\n")
    ...     [(row.span, row.number, row.height) for row in load_measured(file).rows]
    [(1, 2, 5.503)]
    """
    file = str(path)
    table = _read(Path(path))
    header, *cells = cast("list[list[str]]", table.to_numpy(dtype=object).tolist())
    columns = {name.strip(): i for i, name in enumerate(header)}
    _check_columns(file, columns)
    faults: list[Fault] = []
    rows: list[MeasuredHeight] = []
    for number, texts in enumerate(cells, start=2):  # the header is line 1
        row = _Row(file, number, texts, columns)
        if row.text("height_m"):
            faults.extend(row.faults())
            rows.extend(row.read())
    if faults:
        raise LineFileError(tuple(faults))
    if not rows:
        raise LineFileError(
            (Fault(file, 0, 0, "height_m", "no height at all", "one or more measured heights"),)
        )
    return MeasuredHeights(file, tuple(rows))


def _read(path: Path) -> DataFrame:
    """Read all cells as texts, as they stand in the file."""
    import pandas  # slow to import

    def refuse(found: str, allowed: str = "a CSV file with commas, UTF-8") -> LineFileError:
        return LineFileError((Fault(str(path), 0, 0, "the file", found, allowed),))

    try:
        return pandas.read_csv(  # pyright: ignore[reportUnknownMemberType]  # of its many overloads
            path,
            header=None,  # else rows that are longer lose cells, with a warning only
            dtype=str,
            keep_default_na=False,
            skip_blank_lines=False,
            encoding="utf-8-sig",
            engine="python",
        ).fillna("")
    except FileNotFoundError:
        raise refuse("no such file", "the path of a CSV file") from None
    except OSError as error:
        raise refuse(f"a file that cannot be read ({error.strerror})") from error
    except (ValueError, UnicodeDecodeError) as error:  # pandas' own errors of parsing are ValueErrors
        raise refuse(str(error).strip()) from error


def _check_columns(file: str, columns: Mapping[str, int]) -> None:
    """Refuse a header without the columns that are needed."""
    has_place = {"span", "dropper"} <= set(columns) or "chainage_m" in columns
    missing = [name for name in ("height_m",) if name not in columns] + ([] if has_place else [_PLACES])
    if not missing:
        return
    unknown = [name for name in columns if name not in _NAMES]
    meant = next((hint for name in unknown if (hint := closest(name, _NAMES))), "")
    found = f'the columns "{", ".join(columns)}"'
    raise LineFileError((Fault(file, 1, 1, "header", found, f"also the column {missing[0]}{meant}"),))


@dataclass(frozen=True)
class _Row:
    """Texts of one row."""

    file: str
    line: int
    texts: list[str]
    columns: Mapping[str, int]

    def text(self, name: str) -> str:
        return self.texts[self.columns[name]].strip() if name in self.columns else ""

    def mark(self, name: str) -> tuple[int, int]:
        """Where a cell begins; in rows with quotes it is somewhat further to the right."""
        before = self.texts[: self.columns[name]] if name in self.columns else []
        return self.line, 1 + sum(len(text) + 1 for text in before)

    def faults(self) -> Iterator[Fault]:
        if _length(self.text("height_m")) is None:
            yield self._fault("height_m", _LENGTH)
        if self.text("span") or self.text("dropper"):
            for name in ("span", "dropper"):
                if _whole(self.text(name)) is None:
                    yield self._fault(name, "a whole number, from 1")
        elif not self.text("chainage_m"):
            yield self._fault("span" if "span" in self.columns else "chainage_m", _PLACES)
        elif _length(self.text("chainage_m")) is None:
            yield self._fault("chainage_m", _LENGTH)

    def read(self) -> Iterator[MeasuredHeight]:
        """Yield the row if nothing is wrong with it."""
        height, chainage = (_length(self.text(name)) for name in ("height_m", "chainage_m"))
        span, number = (_whole(self.text(name)) for name in ("span", "dropper"))
        if height is None:
            return
        marks = {name: self.mark(name) for name in _NAMES}
        if span is not None and number is not None:
            yield MeasuredHeight(height, span, number, math.nan, self.text("lower_wire"), marks)
        elif chainage is not None:
            yield MeasuredHeight(height, 0, 0, chainage, self.text("lower_wire"), marks)

    def _fault(self, name: str, allowed: str) -> Fault:
        text = self.text(name)
        return Fault(self.file, *self.mark(name), name, f'"{text}"' if text else "nothing", allowed)


def _length(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def _whole(text: str) -> int | None:
    """Return a number from 1; a table program may have written it as 3.0."""
    value = _length(text)
    return int(value) if value is not None and value >= 1.0 and value.is_integer() else None
