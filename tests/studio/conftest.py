"""Lines that are solved once for all tests of the studio."""

from __future__ import annotations

import shutil
from importlib.util import find_spec

import pytest

from catenaria.results import FormResult
from catenaria.studio.documents import Document, example
from catenaria.studio.solve import Outcome, solved

STUDIO = find_spec("nicegui") is not None
BROWSER = any(shutil.which(name) for name in ("chromium", "google-chrome"))
NEEDED = {
    "test_user.py": STUDIO,
    "test_app.py": STUDIO,
    "test_browser.py": STUDIO and BROWSER and find_spec("playwright"),
}

collect_ignore = [file for file, installed in NEEDED.items() if not installed]  # extras: studio, browser


@pytest.fixture(scope="session")
def paper() -> Document:
    return example("yang2017_three_span")


@pytest.fixture(scope="session")
def outcome(paper: Document) -> Outcome:
    return solved(paper)


@pytest.fixture(scope="session")
def form(outcome: Outcome) -> FormResult:
    assert outcome.result is not None
    return outcome.result
