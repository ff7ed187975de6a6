"""A tour in a real browser: edit, see numbers change, make mistakes, compare, replay, take files away."""

from __future__ import annotations

import csv
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Generator
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Browser, Download, Error, Page, expect, sync_playwright

from catenaria.line import Line
from catenaria.line.load import load_line, model_from
from catenaria.studio.documents import MOST_BYTES, Document, as_yaml, example, replaced

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome") or ""
START = "from catenaria.cli.main import main; main()"
SOLVED = "audit passed"
PATIENCE = 30_000  # ms
CONDUCTOR = {
    "youngs_modulus": "120 GPa",
    "area": "120 mm^2",
    "mass_per_length": "1.08 kg/m",
    "bending_stiffness": "131.7 N*m^2",
}


@pytest.fixture(scope="module")
def url() -> Generator[str]:
    """Return the address of a studio that runs as people start it."""
    command = [sys.executable, "-c", START, "studio", "--no-browser"]
    # NiceGUI does not listen where it believes that it is itself under test.
    here = {name: value for name, value in os.environ.items() if not name.startswith(("PYTEST", "NICEGUI"))}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=here
    ) as server:
        assert server.stdout is not None
        try:
            yield server.stdout.readline().split()[1]
        finally:
            server.terminate()


@pytest.fixture(scope="module")
def browser(url: str) -> Generator[Browser]:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser
        browser.close()


class Visit:
    """A person with a browser of their own, and what the page complained of."""

    def __init__(self, browser: Browser, url: str) -> None:
        self.said: list[str] = []
        context = browser.new_context(viewport={"width": 1500, "height": 950}, accept_downloads=True)
        self.page: Page = context.new_page()
        self.page.set_default_timeout(PATIENCE)
        self.page.on("console", lambda message: self.said.append(message.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        for _ in range(100):  # the address is said just before the server listens
            try:
                self.page.goto(url)
                break
            except Error as error:
                if "ERR_CONNECTION_REFUSED" not in str(error):
                    raise
                self.page.wait_for_timeout(200)
        self.said.clear()
        self.solved()

    def status(self) -> str:
        return self.page.locator(".status").text_content() or ""

    def solved(self) -> None:
        expect(self.page.locator(".status")).to_contain_text(SOLVED, timeout=PATIENCE)

    def choose(self, label: str) -> None:
        self.page.locator(".chooser").click()
        self.page.get_by_text(label, exact=True).click()

    def enter(self, field: str, text: str) -> None:
        place = self.page.locator(f'[data-field="{field}"]')
        place.fill(text)
        place.press("Enter")

    def tab(self, name: str) -> None:
        self.page.get_by_role("tab", name=name).click()

    def take(self, label: str) -> Download:
        with self.page.expect_download() as download:
            self.page.get_by_role("button", name="Download", exact=True).click()
            self.page.get_by_text(label, exact=True).click()
        return download.value

    def wind_on(self) -> None:
        """Stop a film that plays, and go to its end."""
        self.page.get_by_label("play", exact=True).click()
        slider = self.page.locator(".slider").bounding_box()
        assert slider is not None
        self.page.mouse.click(slider["x"] + slider["width"] - 1, slider["y"] + slider["height"] / 2)

    def close(self) -> None:
        self.page.context.close()


@pytest.fixture
def visit(browser: Browser, url: str) -> Generator[Visit]:
    visit = Visit(browser, url)
    yield visit
    assert visit.said == []
    visit.close()


def schedule(download: Download) -> list[float]:
    with Path(download.path()).open(encoding="utf-8") as file:
        return [float(row["cut_length_m"]) for row in csv.DictReader(file)]


@pytest.mark.slow
def test_an_editing_tour(visit: Visit) -> None:
    page = visit.page
    visit.choose("AC line, 60 m spans, cantilevers")
    expect(page.locator('[data-field="spans[11].length"]')).to_have_value("60")
    visit.solved()
    expect(page.locator(".js-plotly-plot .main-svg").first).to_be_visible()
    before = schedule(visit.take("Droppers, CSV"))
    page.get_by_label("pin this variant").click()

    visit.enter("supports[3].stagger", "-150")
    expect(page.locator(".status")).to_contain_text("1 of")  # the arm there pushes now: a check fails
    visit.enter("spans[2].pre_sag_per_mille", "0.8")
    visit.tab("Compare")
    expect(page.get_by_text("Against the pinned variant")).to_be_visible()
    visit.solved()
    after = schedule(visit.take("Droppers, CSV"))
    changed = [i for i, (old, new) in enumerate(zip(before, after, strict=True)) if abs(new - old) > 5e-3]
    assert changed
    assert set(changed) <= set(range(18, 27))  # droppers of the third span

    visit.enter("spans[2].length", "60 kg")
    expect(page.get_by_text('found "60 kg"; allowed: a length')).to_be_visible()
    expect(page.locator(".status")).to_contain_text("not solved")
    page.get_by_label("undo", exact=True).click()
    visit.solved()
    expect(page.get_by_text('found "60 kg"')).to_have_count(0)

    line = load_line(visit_file(visit.take("Line file")))
    tree = replaced(example("simple_60m").tree, ("supports", 3, "stagger"), -0.15)
    tree = replaced(tree, ("spans", 2, "pre_sag_per_mille"), 0.8)
    assert line == model_from(tree, Line)
    for name in ("Tension", "Droppers", "Supports", "Checks", "Form"):
        visit.tab(name)
        page.wait_for_timeout(300)


def visit_file(download: Download) -> Path:
    path = Path(download.path())
    return path.rename(path.with_suffix(".yaml"))


@pytest.mark.slow
def test_the_replay_reaches_the_form(visit: Visit) -> None:
    page = visit.page
    visit.tab("Replay")
    page.get_by_role("button", name="Move it").click()
    expect(page.locator(".panel .js-plotly-plot .main-svg").first).to_be_visible(timeout=120_000)
    expect(page.get_by_text(re.compile(r"contact wire, [\d.]+ s ·"))).to_be_visible()  # it plays by itself
    expect(page.get_by_text("messenger wire, ")).to_be_visible(timeout=120_000)
    visit.wind_on()
    expect(page.get_by_text("dropper force error 0.0")).to_be_visible(timeout=120_000)
    visit.enter("speed", "200")
    expect(page.get_by_text("The line is another one: its motion is not computed yet.")).to_be_visible()


@pytest.mark.slow
def test_a_line_in_space_is_replayed(visit: Visit, tmp_path: Path) -> None:
    page, tree = visit.page, example("stitched_re250").tree
    tree |= {"spans": tree["spans"][:2], "supports": tree["supports"][:3]}
    file = tmp_path / "short.yaml"
    file.write_text(as_yaml(Document("short", tree)), encoding="utf-8")
    page.locator("input[type=file]").set_input_files(file)
    expect(page.locator('[data-field="name"]')).to_have_value("stitched line, Re 250")
    visit.solved()
    visit.tab("Replay")
    page.get_by_role("button", name="Move it").click()
    expect(page.get_by_text("s of simulated time after")).to_be_visible(timeout=60_000)
    expect(page.get_by_text(re.compile(r"line, [\d.]+ s · .* of gravity · tension error"))).to_be_visible(
        timeout=60_000
    )
    expect(page.locator(".panel .js-plotly-plot .main-svg:first-child")).to_have_count(3)
    visit.wind_on()
    expect(page.get_by_text("· at rest")).to_be_visible(timeout=60_000)


def test_an_uploaded_line_is_solved_and_a_large_file_is_not(visit: Visit, tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    tree = replaced(example("yang2017_three_span").tree, ("name",), "<b>mine</b>")
    file.write_text(as_yaml(Document("mine", tree)), encoding="utf-8")
    upload = visit.page.locator("input[type=file]")
    upload.set_input_files(file)
    expect(visit.page.locator('[data-field="name"]')).to_have_value("<b>mine</b>")
    visit.solved()
    large = tmp_path / "large.yaml"
    large.write_bytes(b"#" * (MOST_BYTES + 1))
    upload.set_input_files(large)
    expect(visit.page.get_by_text("YAML or JSON, 1 MB at most")).to_be_visible()


def test_a_file_is_edited_as_text_and_keeps_what_was_written(visit: Visit, tmp_path: Path) -> None:
    page, asked = visit.page, set[str]()
    page.on("request", lambda request: asked.add(urlsplit(request.url).hostname or ""))
    file = tmp_path / "mine.yaml"
    paper = example("yang2017_three_span")
    text = "# by me\n" + paper.text.replace("Yang et al. 2017, three spans", "mine")
    file.write_text(text, encoding="utf-8")
    page.locator("input[type=file]").set_input_files(file)
    expect(page.locator('[data-field="name"]')).to_have_value("mine")
    visit.solved()
    visit.tab("File")
    editor = page.locator(".cm-content")
    expect(editor).to_contain_text("# by me")
    expect(editor.locator("span").filter(has_text="# by me").first).to_be_visible()  # YAML in colours

    editor.click()
    page.keyboard.press("Control+Home")
    page.keyboard.type("# typed\nwrong: 1\nspeed: 200 km/h\n")
    page.keyboard.press("Control+Enter")
    expect(page.locator('[data-field="speed"]')).to_have_value("200")
    fault = page.get_by_role("button", name="2:8 wrong: found")
    expect(fault).to_be_visible()
    fault.click()
    page.keyboard.press("Home")
    page.keyboard.press("Shift+ArrowDown")
    page.keyboard.press("Delete")
    expect(editor).not_to_contain_text("wrong: 1")
    page.get_by_role("button", name="Apply").click()
    visit.solved()
    expect(fault).to_have_count(0)
    visit.enter("spans[2].length", "64.5")
    visit.solved()
    expect(editor).to_contain_text("# typed")

    download = visit.take("Line file")
    assert download.suggested_filename == "mine.yaml"
    mine = paper.rewritten("# typed\nspeed: 200 km/h\n" + text)
    taken = Path(download.path()).read_text(encoding="utf-8")
    assert taken == mine.edited(replaced(mine.tree, ("spans", 2, "length"), "64.5 m")).text
    assert set(taken.splitlines()) > set(text.splitlines()) - {"  - *span"}
    assert asked <= {"127.0.0.1"}


COUNT = """() => {
  window.counted = 0;
  window.socket.prependAny((kind) => { if (kind === "update") window.counted += 1; });
}"""
HIGHEST = """plot => Math.max(...plot._fullData.map(trace => Math.max(...trace.y.filter(Number.isFinite))))"""


def test_an_edit_changes_what_is_shown_and_nothing_else(visit: Visit) -> None:
    page, field = visit.page, "supports[1].messenger_wire.height"
    figure = page.locator(".js-plotly-plot").first
    expect(figure.locator(".main-svg").first).to_be_visible()
    heights = [figure.evaluate(HIGHEST)]
    for height in ("1.6", "1.7"):
        visit.enter(field, height)
        page.wait_for_function(
            f"({HIGHEST})(document.querySelector('.js-plotly-plot')) > {heights[-1]} + 0.05"
        )
        heights.append(figure.evaluate(HIGHEST))
        if height == "1.6":
            visit.solved()
            page.evaluate(COUNT)  # from now on: the first edit also enables the button that takes it back
    visit.solved()
    assert heights[2] == pytest.approx(1.7, abs=1e-3)
    assert page.evaluate("window.counted") == 0
    visit.enter("spans[0].length", "long")  # a fault does render the page anew, and is counted
    expect(page.get_by_text('found "long"')).to_be_visible()
    assert page.evaluate("window.counted") > 0


@pytest.mark.parametrize(
    ("tab", "cell"),
    [
        ("Droppers", ".listing td:nth-child(4)"),
        ("Supports", ".listing tr:has-text('messenger wire') td:nth-child(2)"),
        ("Checks", ".listing tr:has-text('shortest dropper') td:nth-child(3)"),
        ("Compare", ".words"),
    ],
)
def test_tables_follow_edits_and_undo(visit: Visit, tab: str, cell: str) -> None:
    page = visit.page
    visit.enter("messenger_wire.tension.force", "15.5")
    visit.solved()
    visit.tab(tab)
    shown = page.locator(f".panel {cell}").first
    page.wait_for_timeout(300)
    before = shown.text_content() or ""
    page.evaluate(COUNT)
    visit.enter("messenger_wire.tension.force", "18")
    expect(shown).not_to_have_text(before)
    after = shown.text_content() or ""
    assert page.evaluate("window.counted") == 0
    visit.tab("Form")
    visit.tab(tab)  # made anew, from what came by messages
    expect(shown).to_have_text(after)
    if tab != "Compare":
        page.get_by_label("undo", exact=True).click()
        expect(shown).to_have_text(before)


def test_what_comes_with_its_change_at_once_counts(visit: Visit) -> None:
    """As browsers do that fill fields in by themselves."""
    fill = """([field, text]) => {
      const input = document.querySelector(field);
      Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set.call(input, text);
      for (const kind of ["input", "change"]) input.dispatchEvent(new Event(kind, { bubbles: true }));
    }"""
    field = '[data-field="spans[1].length"]'
    visit.page.evaluate(fill, [field, "64.5 m"])
    expect(visit.page.locator(field)).to_have_value("64.5")  # read, and shown as it is kept
    visit.solved()


def test_two_people_do_not_see_each_other(visit: Visit, browser: Browser, url: str) -> None:
    visit.enter("name", "secret")
    other = Visit(browser, url)
    assert other.page.locator('[data-field="name"]').input_value() != "secret"
    assert "secret" not in other.page.content()
    other.close()
    visit.page.reload()
    expect(visit.page.locator('[data-field="name"]')).to_have_value("secret")
    visit.solved()


def test_another_example_can_be_taken_back(visit: Visit) -> None:
    length = visit.page.locator('[data-field="spans[0].length"]')
    visit.enter("spans[0].length", "64.5")
    visit.choose("low bridge on a gradient")
    expect(visit.page.locator('[data-field="spans[9].length"]')).to_be_visible()
    visit.solved()
    first = length.input_value()
    visit.enter("spans[0].length", "44")
    visit.choose("low bridge on a gradient")  # once more: from its beginning
    expect(length).to_have_value(first)
    for value in ("44", first, "64.5"):
        visit.page.get_by_label("undo", exact=True).click()
        expect(length).to_have_value(value)
    visit.solved()


def test_the_keyboard_stays_where_a_span_was_added_or_taken_away(visit: Visit) -> None:
    page = visit.page
    page.get_by_label("add a span after 2").press("Enter")
    expect(page.get_by_label("length [m], span 3", exact=True)).to_be_focused()
    expect(page.get_by_label("length [m], span 4", exact=True)).to_be_visible()
    page.get_by_label("take away span 4").press("Enter")
    expect(page.get_by_label("length [m], span 4", exact=True)).to_have_count(0)
    expect(page.get_by_label("length [m], span 3", exact=True)).to_be_focused()


def test_what_is_wrong_stays_in_sight(visit: Visit) -> None:
    visit.choose("AC line, 60 m spans, cantilevers")
    visit.enter("supports[11].stagger", "9000")
    told = visit.page.get_by_text("1 field is wrong")
    expect(told).to_be_visible()
    place = visit.page.locator('[data-field="supports[12].stagger"]')
    place.scroll_into_view_if_needed()
    assert visit.page.locator(".half").first.evaluate("half => half.scrollTop") > 100
    expect(told).to_be_in_viewport()


def test_faults_in_the_dark_and_buttons_in_a_narrow_window(visit: Visit) -> None:
    page = visit.page
    page.set_viewport_size({"width": 1000, "height": 900})
    button = page.get_by_label("take away span 1").bounding_box()
    half = page.locator(".half").first.bounding_box()
    assert button is not None
    assert half is not None
    assert button["x"] + button["width"] < half["x"] + half["width"]
    page.get_by_label("light or dark").click()
    visit.enter("spans[0].length", "long")
    wrong = page.locator(".q-field__messages").filter(has_text='found "long"')
    expect(wrong).to_have_css("color", "rgb(255, 143, 134)")  # 8 to 1 on the background


def test_names_of_fields_differ(visit: Visit) -> None:
    names = visit.page.locator("[data-field]").evaluate_all("all => all.map(e => e.ariaLabel)")
    assert len(names) == len(set(names)) > 30
    assert {"pre-sag [mm], span 1", "pre-sag [‰], span 1"} <= set(names)
    visit.tab("Replay")
    expect(visit.page.get_by_role("slider", name="state of the motion")).to_be_visible()
    assert visit.page.evaluate("document.documentElement.lang") == "en"


@pytest.mark.parametrize("lost", [True, False])
def test_a_page_whose_session_is_gone_says_so(browser: Browser, url: str, lost: bool) -> None:
    context = browser.new_context()
    if lost:  # as it is in the browser's tab when the studio was started again meanwhile
        context.add_init_script("sessionStorage.setItem('catenaria studio', 'begun')")
    page = context.new_page()
    page.goto(url)
    expect(page.locator(".status")).to_contain_text(SOLVED, timeout=PATIENCE)
    expect(page.get_by_text("This page begins anew")).to_have_count(int(lost))
    page.reload()
    expect(page.locator(".status")).to_contain_text(SOLVED, timeout=PATIENCE)
    expect(page.get_by_text("This page begins anew")).to_have_count(0)
    context.close()


def test_an_error_would_be_noticed(browser: Browser, url: str) -> None:
    visit = Visit(browser, url)
    visit.page.evaluate("setTimeout(() => nowhere(), 0)")
    visit.page.wait_for_timeout(300)
    assert any("nowhere" in text for text in visit.said)
    visit.close()


@pytest.mark.slow
def test_names_are_no_markup_anywhere(visit: Visit, tmp_path: Path) -> None:
    attack = "<img src=data:, onerror='window.attacked=1'><script>window.attacked=1</script>"
    tree = example("simple_60m").tree
    tree = replaced(tree, ("name",), attack) | {"conductors": {attack: CONDUCTOR}}
    tree = replaced(tree, ("supports", 1, "name"), attack)
    tree = replaced(tree, ("contact_wire", "conductor"), attack)
    file = tmp_path / "attack.yaml"
    file.write_text(as_yaml(Document("attack", tree)), encoding="utf-8")
    visit.page.locator("input[type=file]").set_input_files(file)
    expect(visit.page.locator('[data-field="name"]')).to_have_value(attack)
    visit.solved()
    for tab in ("Tension", "Droppers", "Supports", "Checks", "File", "Form"):
        visit.tab(tab)
    visit.enter("speed", attack)  # it is told beside the field then
    expect(visit.page.get_by_text("window.attacked=1").first).to_be_visible()
    assert visit.page.evaluate("window.attacked") is None
    visit.page.evaluate("text => document.body.insertAdjacentHTML('beforeend', text)", attack)
    visit.page.wait_for_function("window.attacked === 1")  # as markup it does act
