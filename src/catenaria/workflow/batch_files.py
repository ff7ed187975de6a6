"""Which files a batch solves, and into which folders."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from catenaria.errors import InconsistentInputError
from catenaria.results import MANIFEST_NAME, has_manifest

_SUFFIXES = (".yaml", ".yml", ".json")


@dataclass(frozen=True)
class LineFile:
    """A file of a batch.

    Attributes
    ----------
    file : Path
        Its absolute path.
    name : str
        Its path below the folder that all arguments have in common.
    out : Path
        Folder of the batch, absolute.
    place : str
        Where in it the results go.
    """

    file: Path
    name: str
    out: Path
    place: str

    @property
    def folder(self) -> Path:
        """Where the results go, absolute."""
        return self.out / self.place


def find_files(
    patterns: Sequence[str | os.PathLike[str]], out: str | os.PathLike[str]
) -> tuple[LineFile, ...]:
    """Find the line files of a batch and give each a folder of its own.

    Parameters
    ----------
    patterns : sequence of path
        Files, folders (all ``.yaml``, ``.yml`` and ``.json`` files in them and below) or glob patterns, where
        ``**`` stands for any folders.
    out : path
        Folder for the results, which mirrors the folders of the files. Files in it are not solved.

    Returns
    -------
    tuple of LineFile
        In order of their names, each file once.

    Raises
    ------
    InconsistentInputError
        If a pattern matches no file.

    Notes
    -----
    A folder of results has the name of the file without its suffix, or with it where two files would share a
    folder or one's folder would lie within the other's: ``a.yaml`` beside ``a.json``, or beside ``a/b.yaml``.
    """
    target = Path(out).resolve()
    texts = [os.path.abspath(pattern) for pattern in patterns]  # noqa: PTH100 (Path.absolute keeps "..")
    found = {file for text in texts for file in _matches(text, target)}
    base = Path(os.path.commonpath([_fixed_part(Path(text)) for text in texts]))
    names = sorted(file.relative_to(base) for file in found)
    return tuple(
        LineFile(base / name, name.as_posix(), target, place.as_posix())
        for name, place in zip(names, _places(names), strict=True)
    )


def _matches(pattern: str, out: Path) -> Iterator[Path]:
    """Yield the files that one argument stands for."""
    path = Path(pattern)
    if path.is_dir():
        found = list(_below(path, out))
    elif path.is_file():
        found = [path]
    else:
        above = _fixed_part(path)
        matched = above.glob(path.relative_to(above).as_posix())
        found = [file for file in matched if file.is_file() and not file.resolve().is_relative_to(out)]
    if not found and path.resolve().is_relative_to(out):
        raise InconsistentInputError(
            f"{pattern} lies in the folder of results {out}, where no line files are looked for. Name another"
        )
    if not found:
        raise InconsistentInputError(f"{pattern}: there is no such line file. Name files, folders or globs")
    yield from found


def _below(folder: Path, out: Path) -> Iterator[Path]:
    """Yield the line files in a folder and below it; hidden folders and folders of results are left out."""
    for parent, folders, files in os.walk(folder):
        here = Path(parent)
        if (here / "result.json").is_file() or here.resolve() == out:
            folders.clear()
            continue
        folders[:] = [name for name in folders if not name.startswith(".")]
        own = MANIFEST_NAME if has_manifest(here) else ""
        yield from (here / name for name in files if Path(name).suffix.lower() in _SUFFIXES and name != own)


def _fixed_part(pattern: Path) -> Path:
    """Return a folder itself, the folder of a file, and the innermost one of a glob before its wildcards."""
    return next(path for path in (pattern, *pattern.parents) if path.is_dir())


def _places(names: Sequence[Path]) -> Iterator[Path]:
    short = [name.with_suffix("") for name in names]
    count = Counter(short)
    above = {parent for name in short for parent in name.parents}
    for name, plain in zip(names, short, strict=True):
        yield name if count[plain] > 1 or plain in above else plain
