"""From an edit in the studio to what the browser has painted of it, for every example line and every tab.

Server and browser share the processors of this machine. The first edits of a line are not counted: they
compile what has not been needed before, in Python and in the browser.
"""

from __future__ import annotations

import argparse
import os
import shutil
import statistics
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import cycle

from playwright.sync_api import Error, Page, sync_playwright

from catenaria.studio.documents import EXAMPLES

_START = "from catenaria.cli.main import main; main()"
_TABS = ("Form", "Tension", "Droppers", "Supports", "Checks")
_FIELD = '[data-field="spans[1].length"]'
_UNCOUNTED, _COUNTED = 3, 9

# Resolves with the times [ms] at which the frames after the changes are painted: of the first figure or table
# that is seen, and of the verdict in the head.
_EDIT = """([field, text]) => new Promise((resolve) => {
  const input = document.querySelector(field), status = document.querySelector(".status");
  const figure = [...document.querySelectorAll(".js-plotly-plot")].find((plot) => plot.offsetParent);
  const painted = {}, observers = [];
  let began = 0;
  const paint = (what) => {
    if (what in painted) return;
    painted[what] = 0;
    requestAnimationFrame(() => {
      const channel = new MessageChannel();
      channel.port1.onmessage = () => {
        painted[what] = performance.now() - began;
        if (painted.shown && painted.verdict) {
          for (const observer of observers) observer.disconnect();
          resolve([painted.shown, painted.verdict]);
        }
      };
      channel.port2.postMessage(0);
    });
  };
  const watch = (element, act) => {
    const observer = new MutationObserver(act);
    observer.observe(element, { childList: true, subtree: true, characterData: true });
    observers.push(observer);
  };
  let solving = false;
  watch(status, () => {
    if (status.textContent.includes("solving")) solving = true;
    else if (solving && status.textContent.includes("checks")) paint("verdict");
  });
  if (figure) figure.once("plotly_afterplot", () => paint("shown"));
  else watch(document.querySelector(".panel .listing"), () => paint("shown"));
  input.focus();
  Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set.call(input, text);
  input.dispatchEvent(new Event("input", { bubbles: true }));
  setTimeout(() => {
    began = performance.now();
    input.dispatchEvent(new Event("change", { bubbles: true }));
  }, 100);
})"""


@contextmanager
def studio() -> Iterator[str]:
    """Yield the address of a studio."""
    command = [sys.executable, "-c", _START, "studio", "--no-browser"]
    own = {name: value for name, value in os.environ.items() if not name.startswith(("PYTEST", "NICEGUI"))}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=own
    ) as server:
        assert server.stdout is not None
        try:
            yield server.stdout.readline().split()[1]
        finally:
            server.terminate()


def opened(page: Page, url: str) -> None:
    """Open the studio, which says its address just before it listens."""
    for _ in range(100):
        try:
            page.goto(url)
            break
        except Error:
            page.wait_for_timeout(200)
    page.wait_for_selector(".js-plotly-plot .main-svg")


def measured(page: Page) -> list[tuple[float, float]]:
    """Return the times of edits, to and fro, with what is typed between them shown and at rest."""
    length = float(page.locator(_FIELD).input_value())
    texts = cycle((f"{length + 0.25:g}", f"{length:g}"))
    found: list[tuple[float, float]] = []
    for _ in range(_UNCOUNTED + _COUNTED):
        shown, verdict = page.evaluate(_EDIT, [_FIELD, next(texts)])
        found.append((shown, verdict))
        page.wait_for_timeout(400)
    return found[_UNCOUNTED:]


def main() -> None:
    """Print medians and largest times."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("lines", nargs="*", default=list(EXAMPLES), help="names of example lines")
    parser.add_argument("--tab", action="append", choices=_TABS, help="tabs that are open; all by default")
    chosen = parser.parse_args()
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    with studio() as url, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1500, "height": 950})
        opened(page, url)
        print(f"{'median (largest) [ms]':26s}{'tab':10s}{'what it shows':>18s}{'verdict':>18s}")
        for name in chosen.lines:
            page.locator(".chooser").click()
            page.get_by_text(EXAMPLES[name], exact=True).click()
            page.wait_for_timeout(2500)
            for tab in chosen.tab or _TABS:
                page.get_by_role("tab", name=tab).click()
                page.wait_for_timeout(700)
                columns = zip(*measured(page), strict=True)
                cells = [f"{statistics.median(times):.0f} ({max(times):.0f})" for times in columns]
                print(f"{name:26s}{tab:10s}{cells[0]:>18s}{cells[1]:>18s}", flush=True)
        browser.close()


if __name__ == "__main__":
    main()
