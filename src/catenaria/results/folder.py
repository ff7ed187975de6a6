"""Replace a whole output folder at once, and nobody else's files.

A new folder is filled beside the old one under a hidden name and takes its place by renaming, so an
interruption leaves the old folder or the new one. A manifest lists every file with its SHA-256: a later run
replaces a folder only if each file in it is listed there and unchanged. Files that somebody added or edited
are therefore never deleted; the run is refused instead, and says which file stands in the way. So is one that
would replace a result of another kind, such as a line that was found by load cases of it.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import secrets
import shutil
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, cast

from catenaria.errors import InconsistentInputError
from catenaria.results.store import FORMATS, JSON_NAME

MANIFEST_NAME = "manifest.json"
_FORMAT = "catenaria output folder"
_HEAD = 200  # bytes of a result's file in which its kind is stated
_STATED_KIND = re.compile(rb'"format": "(catenaria [ -~]*?)"')
_HIDDEN = re.compile(r"\.(.+)\.[0-9a-f]{8}\.(?:new|old)")  # names that a run gives to its folders meanwhile


@contextmanager
def replace_folder(folder: str | os.PathLike[str]) -> Generator[Path, None, None]:
    """Fill a new folder that takes the place of `folder` when the block ends without an exception.

    Parameters
    ----------
    folder : path
        Does not exist yet, is empty, or was written through this function and not touched since. If it holds
        a result, the block writes one of the same kind.

    Yields
    ------
    Path
        The folder to write into; it is removed when the block fails or is interrupted.

    Raises
    ------
    InconsistentInputError
        If `folder` holds anything else (see `require_replaceable`).

    Notes
    -----
    Two renamings exchange the folders. An exception between them, Ctrl-C included, puts the old folder back;
    if the computer itself stops at that moment, old and new folder are both complete, under hidden names
    beside `folder`.

    Examples
    --------
    >>> import tempfile
    >>> parent = tempfile.TemporaryDirectory()
    >>> with replace_folder(Path(parent.name) / "run") as new:
    ...     _ = (new / "note.txt").write_text("complete")
    >>> sorted(path.name for path in (Path(parent.name) / "run").iterdir())
    ['manifest.json', 'note.txt']
    >>> parent.cleanup()
    """
    target = require_replaceable(folder)
    target.parent.mkdir(parents=True, exist_ok=True)
    token = secrets.token_hex(4)
    new = target.with_name(f".{target.name}.{token}.new")
    try:
        new.mkdir()
        yield new
        _write_manifest(new)
        _refuse_another_kind(target, _kind(new))
        _exchange(new, require_replaceable(target), target.with_name(f".{target.name}.{token}.old"))
    finally:
        shutil.rmtree(new, ignore_errors=True)


def require_replaceable(folder: str | os.PathLike[str], kind: type | None = None) -> Path:
    """Refuse a folder that `replace_folder` must not replace; ask before a long computation, not after it.

    Parameters
    ----------
    folder : path
        The folder that is to be replaced.
    kind : type, optional
        Type of the result that is to be written into it; a folder with one of another kind is refused then.

    Returns
    -------
    Path
        The folder, absolute and with links resolved.

    Raises
    ------
    InconsistentInputError
        If it is a file, lies where nothing can be written, contains the current working folder, or holds a
        file that is not listed in its manifest or was changed since, or a result of another kind.
    """
    target = Path(folder).resolve()
    if not target.exists():
        _require_writable_above(target)
        return target
    if not target.is_dir():
        raise InconsistentInputError(f"{folder} is a file. Name a folder for the output")
    if Path.cwd().is_relative_to(target):
        raise InconsistentInputError(f"{folder} contains the current working folder. Name another folder")
    foreign = _foreign_file(target)
    if foreign is not None:
        raise InconsistentInputError(
            f"{folder} is left as it is: {foreign} in it was not written by catenaria, or was changed since. "
            "Move that file away, or name another folder"
        )
    _require_writable_above(target)
    if kind is not None:
        _refuse_another_kind(target, FORMATS[kind])
    return target


def has_manifest(folder: str | os.PathLike[str]) -> bool:
    """Return whether a folder was written through `replace_folder`, changed since or not."""
    return _read_manifest(Path(folder)) is not None


def is_intact(folder: str | os.PathLike[str]) -> bool:
    """Return whether a folder holds every file that `replace_folder` left in it, unchanged.

    Parameters
    ----------
    folder : path
        May be missing, or hold other files besides.
    """
    folder = Path(folder)
    digests = _read_manifest(folder)
    if digests is None:
        return False
    return all((folder / name).is_file() and _digest(folder / name) == digests[name] for name in digests)


def clear_interrupted(parent: str | os.PathLike[str]) -> None:
    """Remove what killed runs of `replace_folder` have left beside the folders they were to replace.

    Parameters
    ----------
    parent : path
        The folder with these folders; nobody may be writing into it through `replace_folder` now.

    Notes
    -----
    A run that is killed between its two renamings leaves the earlier folder under a hidden name and nothing
    in its place; that folder is put back.
    """
    parent = Path(parent)
    paths = sorted(parent.iterdir()) if parent.is_dir() else []
    for path in (path for path in paths if _HIDDEN.fullmatch(path.name)):
        target = parent / _HIDDEN.sub(r"\1", path.name)
        if path.suffix == ".old" and not target.exists():
            path.rename(target)
        else:
            shutil.rmtree(path, ignore_errors=True)


def _require_writable_above(target: Path) -> None:
    """Refuse a place where no folder can be made or renamed."""
    above = next(parent for parent in target.parents if parent.exists())
    if not (above.is_dir() and os.access(above, os.W_OK | os.X_OK)):
        raise InconsistentInputError(f"{target} cannot be written: {above} is not a folder to write into")


def _refuse_another_kind(target: Path, kind: str | None) -> None:
    """Refuse a folder with a result that is not of the kind that is to take its place."""
    there = _kind(target)
    if there not in (None, kind):
        raise InconsistentInputError(f"{target} is left as it is: it holds a {there}. Name another folder")


def _kind(folder: Path) -> str | None:
    """Return of what kind the result in a folder is, which its file says first, or None."""
    try:
        with (folder / JSON_NAME).open("rb") as file:
            found = _STATED_KIND.search(file.read(_HEAD))
    except OSError:
        return None
    return None if found is None else found[1].decode()


def _foreign_file(folder: Path) -> str | None:
    """Path of one file that no manifest accounts for, or None."""
    digests = _read_manifest(folder)
    if digests is None:  # do not search what may be a large folder of somebody else
        return next((path.name for path in folder.iterdir()), None)
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if name == MANIFEST_NAME or (path.is_dir() and not path.is_symlink()):
            continue
        if path.is_symlink() or digests.get(name) != _digest(path):
            return name
    return None


def _read_manifest(folder: Path) -> dict[str, Any] | None:
    try:
        manifest: Any = json.loads((folder / MANIFEST_NAME).read_bytes())
    except (OSError, ValueError):
        return None
    if not isinstance(manifest, dict) or cast(dict[str, Any], manifest).get("format") != _FORMAT:
        return None
    files: Any = cast(dict[str, Any], manifest).get("files")
    return cast(dict[str, Any], files) if isinstance(files, dict) else None


def files_of(folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Return the files of a folder and of the folders in it, in order, without its manifest."""
    files = sorted(path for path in Path(folder).rglob("*") if path.is_file())
    return tuple(path for path in files if path != Path(folder) / MANIFEST_NAME)


def _write_manifest(folder: Path) -> None:
    digests = {path.relative_to(folder).as_posix(): _digest(path) for path in files_of(folder)}
    text = json.dumps({"format": _FORMAT, "files": digests}, indent=1, ensure_ascii=False)
    (folder / MANIFEST_NAME).write_text(text + "\n", encoding="utf-8")


def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


def _exchange(new: Path, target: Path, aside: Path) -> None:
    if not target.exists():
        new.rename(target)
        return
    try:
        target.rename(aside)
        new.rename(target)
    finally:
        if target.exists():
            shutil.rmtree(aside, ignore_errors=True)
        else:
            aside.rename(target)
