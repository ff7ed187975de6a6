"""Save a form-finding result and load it again: ``result.json`` to be read, ``result.npz`` with the arrays.

Nothing is pickled, so a result of unknown origin is safe to load. Equal results give equal bytes: there are
no time stamps, and arrays are stored uncompressed in a fixed order. The JSON file holds the SHA-256 of the
array file, which tells damage and mixed-up files from a result.
"""

from __future__ import annotations

import hashlib
import io
import json
import math
import os
import zipfile
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.results.adjustment import Adjustment
from catenaria.results.case import LoadStudy
from catenaria.results.codec import Arrays, decode, encode
from catenaria.results.elasticity import ElasticityStudy
from catenaria.results.form import FormResult
from catenaria.results.rounding import RoundingStudy
from catenaria.results.structure import StructureForm
from catenaria.results.tolerance import ToleranceStudy

Stored = (
    FormResult | StructureForm | LoadStudy | ElasticityStudy | RoundingStudy | ToleranceStudy | Adjustment
)
Result = TypeVar(
    "Result",
    FormResult,
    StructureForm,
    LoadStudy,
    ElasticityStudy,
    RoundingStudy,
    ToleranceStudy,
    Adjustment,
)

FORMATS: dict[type, str] = {
    FormResult: "catenaria form-finding result",
    StructureForm: "catenaria structure result",
    LoadStudy: "catenaria load cases",
    ElasticityStudy: "catenaria elasticity study",
    RoundingStudy: "catenaria rounding study",
    ToleranceStudy: "catenaria tolerance study",
    Adjustment: "catenaria adjustment",
}
VERSION = 2
JSON_NAME = "result.json"
ARRAYS_NAME = "result.npz"

_EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest date that a zip file can hold
_UNIX = 3  # ZipInfo.create_system would otherwise tell on which platform the file was written


def save_result(result: Stored, folder: str | os.PathLike[str]) -> Path:
    """Write ``result.json`` and ``result.npz`` into a folder, which is made if need be.

    Parameters
    ----------
    result : Stored
        What to save: a form or a study.
    folder : path
        Where to; earlier files of these two names are replaced. (`catenaria.results.replace_folder` replaces
        a whole folder safely.)

    Returns
    -------
    Path
        The JSON file.

    Raises
    ------
    InconsistentInputError
        If a field is not of its declared type or holds NaN or infinity; nothing is written then.
    """
    tree, arrays = encode(result, type(result))
    archive = _archive(arrays)
    document = {
        "format": FORMATS[type(result)],
        "version": VERSION,
        "arrays": _stated(archive),
        "result": tree,
    }
    text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / ARRAYS_NAME).write_bytes(archive)
    (folder / JSON_NAME).write_bytes(text.encode())
    return folder / JSON_NAME


def load_result(path: str | os.PathLike[str], kind: type[Result] = FormResult) -> Result:
    """Read a result that `save_result` wrote.

    Parameters
    ----------
    path : path
        The folder, or the JSON file within it.
    kind : type
        What is read: a `FormResult`, a `StructureForm` or a `LoadStudy`.

    Returns
    -------
    FormResult, StructureForm or LoadStudy
        Equal to what was saved, to the last bit; arrays are read-only.

    Raises
    ------
    InconsistentInputError
        If a file is missing, damaged, of another kind, of another program or of another version.
    """
    path = Path(path)
    file = path / JSON_NAME if path.is_dir() else path
    document = _read_document(file, FORMATS[kind])
    arrays = _read_arrays(file.parent / ARRAYS_NAME, _field(document, "arrays", file))
    try:
        return decode(_field(document, "result", file), kind, arrays)
    except InconsistentInputError as error:
        raise InconsistentInputError(f"{file} cannot be used: {error}. Solve the line again") from error


def _stated(archive: bytes) -> dict[str, str]:
    return {"file": ARRAYS_NAME, "sha256": hashlib.sha256(archive).hexdigest()}


def _archive(arrays: Arrays) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_STORED) as archive:
        for name, array in arrays.items():
            entry = zipfile.ZipInfo(f"{name}.npy", _EPOCH)
            entry.create_system = _UNIX
            content = io.BytesIO()
            np.lib.format.write_array(content, array, version=(1, 0), allow_pickle=False)
            archive.writestr(entry, content.getvalue())
    return buffer.getvalue()


def _read_document(file: Path, expected: str) -> dict[str, Any]:
    try:
        document: Any = json.loads(_read_bytes(file), parse_float=_finite, parse_constant=_finite)
    except (ValueError, RecursionError) as error:
        raise InconsistentInputError(f"{file} is damaged or not a JSON file: {error}") from error
    if not isinstance(document, dict) or cast(dict[str, Any], document).get("format") != expected:
        raise InconsistentInputError(f"{file} is not a {expected}")
    document = cast(dict[str, Any], document)
    version = document.get("version")
    if not isinstance(version, int) or version < 1:
        raise InconsistentInputError(f"{file} is damaged: its format version is {version!r}")
    if version < VERSION:
        raise InconsistentInputError(
            f"{file} was written by an older catenaria: its format version is {version}, this one reads "
            f"{VERSION}. Solve the line again"
        )
    if version > VERSION:
        raise InconsistentInputError(
            f"{file} was written by a newer catenaria: its format version is {version}, "
            f"this one reads {VERSION}. Upgrade catenaria, or solve the line again"
        )
    return document


def _read_arrays(file: Path, stated: Any) -> Arrays:
    content = _read_bytes(file)
    if stated != _stated(content):
        raise InconsistentInputError(f"{file} is damaged, or does not belong to the {JSON_NAME} beside it")
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            return {name.removesuffix(".npy"): _read_array(archive.read(name)) for name in archive.namelist()}
    except (ValueError, OSError, NotImplementedError, zipfile.BadZipFile) as error:
        raise InconsistentInputError(f"{file} is not an archive of plain arrays: {error}") from error


def _read_array(content: bytes) -> NDArray[Any]:
    return np.lib.format.read_array(io.BytesIO(content), allow_pickle=False)


def _read_bytes(file: Path) -> bytes:
    try:
        return file.read_bytes()
    except OSError as error:
        raise InconsistentInputError(f"{file} cannot be read: {error.strerror}") from error


def _field(document: dict[str, Any], name: str, file: Path) -> Any:
    if name not in document:
        raise InconsistentInputError(f"{file} is damaged: it has no field '{name}'")
    return document[name]


def _finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text} is not a finite number")
    return value
