"""Lines that are too large for the studio."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria import workflow
from catenaria.errors import UnsupportedError
from catenaria.line import Line
from catenaria.line.load import model_from
from catenaria.studio.documents import EXAMPLES, Document, example, replaced
from catenaria.studio.limits import MOST_ELEMENTS, element_bound, refuse_long_waits
from catenaria.studio.solve import outcomes


def line_of(document: Document) -> Line:
    return model_from(document.tree, Line, document.name)


@pytest.mark.parametrize("name", ["yang2017_three_span", "curve_800m", "compound", "two_contact_wires_3kv"])
def test_the_bound_is_above_the_elements_that_there_are(name: str) -> None:
    line = line_of(example(name))
    form = workflow.find(line)
    main = [stage for stage in form.stages]
    wires = {wire.name for wire in form.wires}
    count = sum(
        int(nodes) - 1
        for stage in main
        for chain, nodes in zip(stage.chain, stage.node_count.tolist(), strict=True)
        if chain in wires
    )
    assert 0.9 * count < element_bound(line) < 4 * count


def test_examples_are_far_from_the_limit() -> None:
    assert max(element_bound(line_of(example(name))) for name in EXAMPLES) < 0.2 * MOST_ELEMENTS


@pytest.mark.parametrize("field", ["refine", "even"])
def test_a_mesh_that_takes_minutes_is_refused_before_anything_is_computed(
    paper: Document, field: str
) -> None:
    tree = replaced(paper.tree, ("solver", "mesh", field), 10**9)
    with pytest.raises(UnsupportedError, match="catenaria solve"):
        refuse_long_waits(line_of(Document("large", tree)))
    (outcome,) = outcomes(Document("large", tree))
    assert outcome.result is None
    assert "elements" in outcome.message


def test_many_droppers_are_counted(paper: Document) -> None:
    positions = np.linspace(1.0, 64.0, 1000).round(4).tolist()
    tree = paper.tree
    for i in range(3):
        tree = replaced(tree, ("spans", i, "droppers"), {"positions": positions})
        tree = replaced(tree, ("spans", i, "contact_wire_height"), None)
    assert element_bound(line_of(Document("dense", tree))) > 3 * 1000
