"""What is shown of a form: figures, tables and differences carry its numbers."""

from __future__ import annotations

import json

import numpy as np
import pytest

from catenaria.results import FormResult
from catenaria.studio import tables
from catenaria.studio.compare import differences
from catenaria.studio.documents import EXAMPLES, Document, example, replaced
from catenaria.studio.palette import coloured, palette
from catenaria.studio.plots import difference_plots, plan_plot, profile_plot, tension_plots
from catenaria.studio.solve import Outcome, solved
from catenaria.studio.spans import with_span_after


@pytest.fixture(scope="module")
def higher(paper: Document) -> FormResult:
    """Return the paper's line with droppers of the second span that hold the contact wire 10 mm lower."""
    form = solved(
        Document("lower", replaced(paper.tree, ("spans", 1, "contact_wire_height"), "-10 mm"))
    ).result
    assert form is not None
    return form


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_example_can_be_drawn(name: str) -> None:
    outcome = solved(example(name))
    form = outcome.result
    assert form is not None
    for dark in (False, True):
        figures = [profile_plot(form, form, dark), plan_plot(form, None, dark), *tension_plots(form, dark)]
        text = json.dumps([*figures, *difference_plots(form, form, dark)], allow_nan=False)
        assert "var(--" not in text
    if not form.spatial:
        assert figures[1] is None
    assert len(tables.schedule(form, None).rows) == form.droppers.x.size
    assert len(tables.checks(outcome.checks).rows) == len(outcome.checks)


def test_light_and_dark_have_the_same_colours_by_name() -> None:
    assert palette(False).keys() == palette(True).keys()
    assert palette(False)["ink"] != palette(True)["ink"]
    assert coloured(["var(--ink)"], True) == ["var(--ink)"]  # texts in lists are data


def test_differences_are_those_of_the_numbers(form: FormResult, higher: FormResult) -> None:
    found = differences(higher, form)
    np.testing.assert_allclose(
        found.cut_length, 1e3 * (higher.droppers.cut_length - form.droppers.cut_length), atol=1e-12
    )
    np.testing.assert_allclose(found.dropper_height, np.repeat([0.0, -10.0, 0.0], 7), atol=1e-6)
    assert found.height.min() == pytest.approx(-10.0, abs=1.0)
    assert found.dropper[7:9] == ("2.1", "2.2")


def test_droppers_that_only_one_has_are_left_out(paper: Document, form: FormResult) -> None:
    longer = solved(Document("longer", with_span_after(paper.tree, 2))).result
    assert longer is not None
    assert len(differences(longer, form).dropper) == 21
    rows = tables.schedule(longer, form).rows
    assert [row["longer"] for row in rows[21:]] == ["new"] * 7
    assert rows[0]["longer"] != "new"


def test_droppers_of_spans_with_fewer_have_no_counterpart(paper: Document, form: FormResult) -> None:
    fewer = {"positions": [5, 16, 27, 38, 49, 60]}
    other = solved(Document("fewer", replaced(paper.tree, ("spans", 1, "droppers"), fewer))).result
    assert other is not None
    found = differences(other, form)
    assert [name[0] for name in found.dropper] == ["1"] * 7 + ["3"] * 7
    assert np.abs(found.cut_length).max() < 10.0  # mm; number by number, those of span 2 differ by more
    assert np.abs(other.droppers.cut_length[7:13] - form.droppers.cut_length[7:13]).max() > 0.05
    table = tables.schedule(other, form)
    assert [row["longer"] for row in table.rows[7:13]] == ["new"] * 6
    assert table.columns[-1]["label"] == "longer than pinned [mm]"


def test_a_pinned_variant_is_drawn_behind(form: FormResult, higher: FormResult) -> None:
    names = [trace["name"] for trace in profile_plot(higher, form, False)["data"]]
    assert names[:2] == ["pinned variant"] * 2
    assert "pinned variant" not in [trace["name"] for trace in profile_plot(higher, None, False)["data"]]


def test_verdicts_stand_in_the_table(outcome: Outcome) -> None:
    rows = tables.checks(outcome.checks).rows
    assert {row["verdict"] for row in rows} <= {"passes", "fails", "not judged", "stated"}
    assert rows[0]["check"] == outcome.checks[0].name


def test_a_line_elsewhere_has_no_heights_in_common(paper: Document, form: FormResult) -> None:
    away = solved(Document("away", replaced(paper.tree, ("start_chainage",), 10_000.0))).result
    assert away is not None
    assert differences(away, form).height.size == 0
    lengths, heights = difference_plots(away, form, False)
    assert lengths["data"][0]["x"]["bdata"]
    assert heights["data"][0]["x"]["bdata"] == ""
