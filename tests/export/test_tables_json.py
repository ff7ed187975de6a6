"""Exported tables, and the schema that explains them."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator, ValidationError

from catenaria.export.tables_json import tables_document, write_tables_json
from catenaria.export.tables_schema import tables_schema
from catenaria.report.tables import TABLES
from catenaria.results import FormResult

VALIDATOR = Draft202012Validator(tables_schema())


def test_every_example_is_as_the_schema_says(every: FormResult, tmp_path: Path) -> None:
    write_tables_json(every, tmp_path / "tables.json")
    document = json.loads((tmp_path / "tables.json").read_text(encoding="utf-8"))
    VALIDATOR.validate(document)
    droppers = document["tables"]["droppers"]
    np.testing.assert_array_equal(droppers["cut_length_m"], every.droppers.cut_length)
    np.testing.assert_array_equal(document["tables"]["supports"]["force_z_N"], every.supports.force_z)
    for columns in document["tables"].values():
        assert len({len(values) for values in columns.values()}) == 1


def test_strings_too(strings: FormResult) -> None:
    VALIDATOR.validate(tables_document(strings))


def test_the_schema_is_one_and_knows_all_columns_in_order(plane: FormResult) -> None:
    Draft202012Validator.check_schema(tables_schema())
    for name, table in tables_schema()["properties"]["tables"]["properties"].items():
        assert list(table["properties"]) == list(TABLES[name](plane))
        for column, explained in table["properties"].items():
            text, suffix = explained["description"], column.rpartition("_")[2]
            assert text[0].isupper()
            assert text[-1] == "."
            if suffix in ("m", "mm", "N", "Nm", "kg", "deg", "degC"):
                assert " In " in text


def without_column(document: dict[str, Any]) -> None:
    del document["tables"]["droppers"]["cut_length_m"]


def with_column(document: dict[str, Any]) -> None:
    document["tables"]["droppers"]["colour"] = []


def with_text(document: dict[str, Any]) -> None:
    document["tables"]["droppers"]["cut_length_m"][0] = "1.234 m"


def of_another_format(document: dict[str, Any]) -> None:
    document["version"] = 2


@pytest.mark.parametrize("change", [without_column, with_column, with_text, of_another_format])
def test_what_is_wrong_is_refused(plane: FormResult, change: Any) -> None:
    document = tables_document(plane)
    change(document)
    with pytest.raises(ValidationError):
        VALIDATOR.validate(document)


def test_what_is_not_there_is_null(plane: FormResult, tmp_path: Path) -> None:
    droppers = replace(plane.droppers, force_error=np.full(21, np.nan))
    write_tables_json(replace(plane, droppers=droppers), tmp_path / "tables.json")
    document = json.loads((tmp_path / "tables.json").read_text(encoding="utf-8"))
    assert document["tables"]["droppers"]["force_error_N"] == [None] * 21
    assert document["audit"] == {"done": True, "passed": True, "findings": []}
    assert document["rebuilt"]["done"] is False
