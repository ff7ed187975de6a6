"""The synthetic network: reproducible, within its bounds, and made of lines."""

from __future__ import annotations

import itertools
from collections import Counter
from typing import Any

import pytest

from catenaria.errors import InconsistentInputError
from catenaria.line import Line, refuse_unsupported
from catenaria.line.network import network


@pytest.fixture(scope="module")
def documents() -> list[Any]:
    return list(network(120, seed=5))


@pytest.fixture(scope="module")
def lines(documents: list[Any]) -> list[Line]:
    return [Line.model_validate(document) for document in documents]


def test_the_same_seed_gives_the_same_network_and_a_smaller_one_is_its_beginning(
    documents: list[Any],
) -> None:
    assert list(network(7, seed=5)) == documents[:7]
    assert list(network(7, seed=6)) != documents[:7]


def test_no_two_lines_are_alike(documents: list[Any]) -> None:
    plain = [{key: value for key, value in document.items() if key != "name"} for document in documents]
    assert all(one != other for one, other in itertools.combinations(plain, 2))


def test_lengths_and_spans_are_within_their_bounds(lines: list[Line]) -> None:
    for line in lines:
        refuse_unsupported(line)
        lengths = [span.length for span in line.spans]
        assert 1200.0 <= line.length <= 1500.0
        assert min(lengths) >= 45.0
        assert max(lengths) <= 65.0
        assert all(abs(a - b) <= 5.0 for a, b in itertools.pairwise(lengths))
        assert len(set(lengths)) > 1


def test_all_kinds_are_there(lines: list[Line]) -> None:
    kinds = Counter(line.name.split(", ")[1] for line in lines)
    assert set(kinds) == {"simple", "stitched", "curved"}
    assert min(kinds.values()) > 20
    curves = [line.track.curves[0] for line in lines if line.track.curves]
    assert {abs(curve.radius) for curve in curves} == {800.0, 1200.0, 2000.0, 3000.0}
    assert len({curve.radius > 0 for curve in curves}) == 2
    assert all((line.stitch_wire is not None) == line.name.endswith("stitched") for line in lines)


def test_in_curves_the_wires_are_staggered_to_the_outside(lines: list[Line]) -> None:
    for line in lines:
        for curve in line.track.curves:
            inside = [
                support.stagger * curve.radius
                for x, support in zip(line.support_x, line.supports, strict=True)
                if curve.start <= x <= curve.start + curve.length
            ]
            assert max(inside) < 0.0


def test_equal_supports_are_one_object(documents: list[Any]) -> None:
    for document in documents:
        supports = document["supports"]
        assert len({id(support) for support in supports}) == len({str(support) for support in supports})


@pytest.mark.parametrize(("count", "seed"), [(0, 1), (3, -1)])
def test_what_makes_no_network_is_refused(count: int, seed: int) -> None:
    with pytest.raises(InconsistentInputError, match="count of one or more"):
        network(count, seed)
