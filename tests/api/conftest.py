"""Results that several tests look at."""

from __future__ import annotations

from pathlib import Path

import pytest

import catenaria

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="session")
def paper_file() -> Path:
    return EXAMPLES / "yang2017_three_span.yaml"


@pytest.fixture(scope="session")
def paper(paper_file: Path) -> catenaria.Result:
    """The plane line of the paper."""
    return catenaria.solve(paper_file)


@pytest.fixture(scope="session")
def stitched() -> catenaria.Result:
    """A line in space with wires that do not reach over all of it."""
    return catenaria.solve(EXAMPLES / "stitched_re250.yaml")
