"""The page in a real browser: no errors, nothing loaded, figures that answer, light and dark."""

from __future__ import annotations

import shutil
from collections.abc import Generator
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome") or ""


@pytest.fixture(scope="module")
def browser() -> Generator[Any]:
    with import_module("playwright.sync_api").sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def file(curve_page: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("report") / "curve.html"
    file.write_text(curve_page, encoding="utf-8")
    return file


class Watched:
    """A page of the browser, what it complained of, and what it asked for."""

    def __init__(self, browser: Any, file: Path, width: int, scheme: str) -> None:
        self.said: list[str] = []
        self.asked: list[str] = []
        context = browser.new_context(
            viewport={"width": width, "height": 900},
            color_scheme="dark" if scheme == "dark" else "light",
            offline=True,
        )
        self.page: Any = context.new_page()
        self.page.on("console", lambda message: self.said.append(message.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto(file.as_uri())
        self.page.wait_for_selector("html[data-ready]", state="attached")

    def colour(self, of: str, name: str = "color") -> str:
        value: str = self.page.evaluate(f"getComputedStyle(document.querySelector('{of}')).{name}")
        return value


@pytest.mark.parametrize(
    ("width", "scheme"), [(1400, "light"), (1400, "dark"), (360, "light"), (360, "dark")]
)
def test_it_opens_without_errors(browser: Any, file: Path, width: int, scheme: str) -> None:
    watched = Watched(browser, file, width, scheme)
    assert watched.said == []
    assert [url for url in watched.asked if not url.startswith(("file:", "data:", "blob:"))] == []
    assert watched.page.locator(".figure .main-svg").count() >= 11
    assert watched.page.evaluate("document.documentElement.scrollWidth") == width
    widest = watched.page.evaluate(
        "Math.max(...[...document.querySelectorAll('.figure svg')].map(s => s.getBoundingClientRect().width))"
    )
    assert widest <= width
    watched.page.close()


def test_an_error_would_be_noticed(browser: Any, file: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken.html"
    text = file.read_text(encoding="utf-8").replace("const drawAll = ", "nowhere(); const drawAll = ")
    broken.write_text(text.replace("default-src 'none'", "default-src 'self'"), encoding="utf-8")
    page = browser.new_page()
    said: list[str] = []
    page.on("pageerror", lambda error: said.append(str(error)))
    page.goto(broken.as_uri())
    assert any("nowhere" in text for text in said)
    page.close()


@pytest.mark.parametrize("width", [360, 800, 1500])
def test_checks_need_no_scrolling(browser: Any, file: Path, width: int) -> None:
    watched = Watched(browser, file, width, "light")
    for of in ("table.checks", "table.checks .chip", "table.checks tr:last-child td:last-child"):
        right = watched.page.evaluate(f"document.querySelector('{of}').getBoundingClientRect().right")
        assert 0 < right <= width
    watched.page.close()


@pytest.mark.parametrize("width", [360, 800, 1500])
def test_names_of_supports_are_apart(browser: Any, file: Path, width: int) -> None:
    watched = Watched(browser, file, width, "light")
    boxes: list[list[list[float]]] = watched.page.evaluate(
        """[...document.querySelectorAll('.figure')].map(figure =>
        [...figure.querySelectorAll('.annotation-text')].map(text => text.getBoundingClientRect())
        .map(box => [box.left, box.right]))"""
    )
    assert len(boxes) >= 11
    for names in boxes:
        assert len(names) > 1
        assert all(before[1] < after[0] for before, after in pairwise(names))
        assert names[-1][1] <= width
    watched.page.close()


def test_all_spans_unfold_at_once(browser: Any, file: Path) -> None:
    watched = Watched(browser, file, 1200, "light")
    button, folded = watched.page.locator("#droppers button"), "#droppers details:not([open])"
    assert watched.page.locator(folded).count() == 19
    button.click()
    assert watched.page.locator(folded).count() == 0
    assert button.text_content() == "Fold all"
    button.click()
    assert watched.page.locator(folded).count() == 19
    assert watched.said == []
    watched.page.close()


def test_light_and_dark_differ_down_to_the_figures(browser: Any, file: Path) -> None:
    light, dark = (Watched(browser, file, 1200, scheme) for scheme in ("light", "dark"))
    stroke = "#profile-1 .scatterlayer .trace path.js-line"
    for of, name in (
        ("body", "backgroundColor"),
        ("body", "color"),
        (stroke, "stroke"),
        (".xtick text", "fill"),
    ):
        assert light.colour(of, name) != dark.colour(of, name)
    dark.page.emulate_media(color_scheme="light")
    dark.page.wait_for_timeout(1000)  # waiting for a condition needs eval, which the page forbids
    assert light.colour(stroke, "stroke") == dark.colour(stroke, "stroke")
    light.page.close()
    dark.page.close()


def test_pointing_says_chainage_height_and_force(browser: Any, file: Path) -> None:
    watched = Watched(browser, file, 1200, "light")
    place = watched.page.locator("#profile-1 .nsewdrag").first
    place.scroll_into_view_if_needed()
    box = place.bounding_box()
    assert box is not None
    found = ""
    for share in (0.97, 0.95, 0.93, 0.9, 0.85):  # the contact wire is near the lower edge
        watched.page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + share * box["height"])
        watched.page.wait_for_timeout(150)
        found = watched.page.locator("#profile-1 .hoverlayer").text_content() or ""
        if "contact wire" in found:
            break
    for word in ("chainage", "height", "tension"):
        assert word in found
    assert watched.said == []
    watched.page.close()


def test_no_button_sends_anything(browser: Any, file: Path) -> None:
    watched = Watched(browser, file, 1200, "light")
    buttons = watched.page.locator("#profile-1 .modebar-btn")
    titles = [buttons.nth(i).get_attribute("data-title") for i in range(buttons.count())]
    assert titles == ["Download plot as a PNG", "Zoom", "Pan", "Zoom in", "Zoom out", "Reset axes"]
    with watched.page.expect_download() as download:
        watched.page.locator("#profile-1 .modebar-btn").first.dispatch_event("click")
    assert download.value.suggested_filename.endswith(".png")
    assert watched.said == []
    watched.page.close()


def test_on_paper_nothing_is_folded(browser: Any, file: Path) -> None:
    watched = Watched(browser, file, 1200, "dark")
    closed = "document.querySelectorAll('details:not([open])').length"
    before = watched.page.evaluate(closed)
    watched.page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert before > 19
    assert watched.page.evaluate(closed) == 0
    assert watched.colour("body", "backgroundColor") == "rgb(255, 255, 255)"
    width = watched.page.evaluate(
        "document.querySelector('#profile-1 .main-svg').getBoundingClientRect().width"
    )
    assert width == pytest.approx(690, abs=2)
    watched.page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    assert watched.page.evaluate(closed) == before
    assert watched.said == []
    watched.page.close()
