"""A stored result comes back bit by bit, and no damaged or foreign file is taken for one."""

from __future__ import annotations

import json
import pickle
import zipfile
from dataclasses import fields, is_dataclass, replace
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.results import FormResult, load_result, save_result


def leaves(value: Any) -> Any:
    """Reduce a result to nested lists that compare with ==, arrays bit by bit."""
    if isinstance(value, np.ndarray):
        return [str(value.dtype), value.shape, value.tobytes()]
    if is_dataclass(value):
        return [leaves(getattr(value, field.name)) for field in fields(value)]
    if isinstance(value, tuple):
        return [leaves(item) for item in value]
    return value


def edit(folder: Path, **changes: Any) -> None:
    file = folder / "result.json"
    file.write_text(json.dumps(json.loads(file.read_text(encoding="utf-8")) | changes), encoding="utf-8")


@pytest.fixture
def folder(result: FormResult, tmp_path: Path) -> Path:
    save_result(result, tmp_path / "run")
    return tmp_path / "run"


def test_round_trip_by_folder_and_by_file(result: FormResult, folder: Path) -> None:
    assert leaves(load_result(folder)) == leaves(result)
    assert leaves(load_result(str(folder / "result.json"))) == leaves(result)


def test_the_comparison_sees_a_change_in_the_last_bit(result: FormResult) -> None:
    """Negative control of the round trip."""
    x = result.droppers.x.copy()
    x[1] = np.nextafter(x[1], np.inf)
    assert leaves(replace(result, droppers=replace(result.droppers, x=x))) != leaves(result)


def test_loaded_arrays_are_read_only(folder: Path) -> None:
    loaded = load_result(folder)
    with pytest.raises(ValueError, match="read-only"):
        loaded.wires[0].profile.x[0] = 0.0


def test_equal_results_give_equal_bytes(result: FormResult, folder: Path, tmp_path: Path) -> None:
    error = np.asfortranarray(np.arange(6.0).reshape(2, 3))
    histories = (replace(result.histories[0], error=error), result.histories[1])
    other = (replace(result.histories[0], error=error.copy(order="C")), result.histories[1])
    save_result(load_result(folder), tmp_path / "again")
    save_result(replace(result, histories=histories), tmp_path / "fortran")
    save_result(replace(result, histories=other), tmp_path / "c")
    for name in ("result.json", "result.npz"):
        assert (tmp_path / "again" / name).read_bytes() == (folder / name).read_bytes()
        assert (tmp_path / "fortran" / name).read_bytes() == (tmp_path / "c" / name).read_bytes()


def test_json_is_readable_and_arrays_have_dotted_names(folder: Path) -> None:
    document = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    assert document["format"] == "catenaria form-finding result"
    assert document["version"] == 2
    assert document["result"]["inputs"]["key 0"]["name"] == "Ölfjord"
    with zipfile.ZipFile(folder / "result.npz") as archive:
        assert {"droppers.x.npy", "wires.1.profile.tension.npy"} <= set(archive.namelist())


def test_numpy_reads_the_archive_by_itself(result: FormResult, folder: Path) -> None:
    with np.load(folder / "result.npz", allow_pickle=False) as archive:
        assert archive["droppers.length"].tobytes() == result.droppers.length.tobytes()


def test_nan_is_refused_by_name_and_nothing_is_written(result: FormResult, tmp_path: Path) -> None:
    broken = replace(result, droppers=replace(result.droppers, length=np.array([1.0, np.nan])))
    with pytest.raises(InconsistentInputError, match=r"droppers\.length: the array holds NaN"):
        save_result(broken, tmp_path / "new")
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("name", ["result.json", "result.npz"])
def test_a_missing_file_is_named(folder: Path, name: str) -> None:
    (folder / name).unlink()
    with pytest.raises(InconsistentInputError, match=rf"{name} cannot be read: No such file"):
        load_result(folder)


@pytest.mark.parametrize("fraction", [0.0, 0.01, 0.5, 0.99])
@pytest.mark.parametrize("name", ["result.json", "result.npz"])
def test_a_truncated_file_is_refused(folder: Path, name: str, fraction: float) -> None:
    content = (folder / name).read_bytes()
    (folder / name).write_bytes(content[: int(fraction * len(content))])
    with pytest.raises(InconsistentInputError, match=rf"{name} is damaged"):
        load_result(folder)


def test_one_flipped_bit_in_the_arrays_is_noticed(folder: Path) -> None:
    content = bytearray((folder / "result.npz").read_bytes())
    content[len(content) // 2] ^= 1
    (folder / "result.npz").write_bytes(content)
    with pytest.raises(InconsistentInputError, match=r"result\.npz is damaged, or does not belong"):
        load_result(folder)


def test_arrays_of_another_result_are_noticed(result: FormResult, folder: Path, tmp_path: Path) -> None:
    droppers = replace(result.droppers, x=result.droppers.x + 1.0)
    save_result(replace(result, droppers=droppers), tmp_path / "other")
    (folder / "result.npz").write_bytes((tmp_path / "other" / "result.npz").read_bytes())
    with pytest.raises(InconsistentInputError, match="does not belong"):
        load_result(folder)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"format": "something else"}, "is not a catenaria form-finding result"),
        ({"version": 3}, "written by a newer catenaria: its format version is 3, this one reads 2"),
        ({"version": 1}, "written by an older catenaria: its format version is 1, .* Solve the line again"),
        ({"version": "1"}, "its format version is '1'"),
        ({"version": 0}, "its format version is 0"),
        ({"arrays": None}, "is damaged"),
        ({"result": {}}, "cannot be used: result: fields differ"),
        ({"result": []}, "a group of fields expected, found list"),
    ],
)
def test_a_foreign_or_newer_document_is_refused(folder: Path, changes: dict[str, Any], message: str) -> None:
    edit(folder, **changes)
    with pytest.raises(InconsistentInputError, match=message):
        load_result(folder)


@pytest.mark.parametrize(
    "text",
    ["", "[]", "null", "not json", '{"a": NaN}', '{"a": 1e999}', '"\\ud800', "[" * 100_000, "\x00\xff"],
)
def test_what_is_not_a_document_is_refused(folder: Path, text: str) -> None:
    (folder / "result.json").write_text(text, encoding="utf-8")
    with pytest.raises(InconsistentInputError, match=r"result\.json is "):
        load_result(folder)


def test_a_missing_document_field_is_named(folder: Path) -> None:
    file = folder / "result.json"
    document = json.loads(file.read_text(encoding="utf-8"))
    del document["arrays"]
    file.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(InconsistentInputError, match="has no field 'arrays'"):
        load_result(folder)


class Trap:
    """Unpickling it leaves a file behind."""

    def __init__(self, mark: Path) -> None:
        self.mark = mark

    def __reduce__(self) -> tuple[Any, ...]:
        return (Path.touch, (self.mark,))


def test_a_pickle_in_the_archive_is_never_opened(folder: Path) -> None:
    file = folder / "result.npz"
    np.savez(file, trap=np.array([Trap(folder / "sprung")], dtype=object))
    edit(folder, arrays={"file": "result.npz", "sha256": sha256(file.read_bytes()).hexdigest()})
    with pytest.raises(InconsistentInputError, match="not an archive of plain arrays: Object arrays"):
        load_result(folder)
    assert not (folder / "sprung").exists()


def test_the_trap_would_have_sprung(tmp_path: Path) -> None:
    """Negative control: the archive above is dangerous for a reader that unpickles."""
    pickle.loads(pickle.dumps(Trap(tmp_path / "sprung")))
    assert (tmp_path / "sprung").exists()


def test_an_archive_that_is_no_archive_is_refused(folder: Path) -> None:
    content = b"PK not really"
    (folder / "result.npz").write_bytes(content)
    edit(folder, arrays={"file": "result.npz", "sha256": sha256(content).hexdigest()})
    with pytest.raises(InconsistentInputError, match="not an archive of plain arrays"):
        load_result(folder)
