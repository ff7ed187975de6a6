"""Print a page to PDF by an installed Chromium or Chrome."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Final

from catenaria.errors import NotConvergedError, UnsupportedError

BROWSERS: Final = (
    *("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "microsoft-edge"),
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
    r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
)
_TIME = 180.0  # s
_MOMENT: Final = re.compile(rb"D:\d{14}(?=[+\-Z])")
_NO_MOMENT: Final = b"D:19800101000000"  # the page says its date, if it has one


def browser() -> str:
    """Return the path of a browser that prints.

    Raises
    ------
    UnsupportedError
        If there is none, with what to install.
    """
    for name in BROWSERS:
        path = shutil.which(name)
        if path is not None:
            return path
    raise UnsupportedError(
        "a PDF needs Chromium or Google Chrome, and none is installed: on Debian and Ubuntu, "
        "sudo apt install chromium; elsewhere, install Chrome. Or open the HTML report "
        "in any browser and print it"
    )


def print_to_pdf(page: Path, file: Path) -> Path:
    """Print an HTML page that was written by catenaria.

    Parameters
    ----------
    page : Path
        The page.
    file : Path
        The PDF file.

    Raises
    ------
    UnsupportedError
        If there is no browser.
    NotConvergedError
        If the browser fails.

    Notes
    -----
    The moment of printing, which Chromium writes into the file, is taken out.
    """
    with tempfile.TemporaryDirectory(prefix="catenaria-") as profile:
        command = [
            browser(),
            "--headless",
            "--disable-gpu",
            "--no-first-run",
            "--no-pdf-header-footer",
            "--generate-pdf-document-outline",
            "--virtual-time-budget=30000",
            f"--user-data-dir={profile}",
            f"--print-to-pdf={file.resolve()}",
            *_as_root(),
            f"{page.resolve().as_uri()}#paper",
        ]
        try:
            done = subprocess.run(command, capture_output=True, timeout=_TIME, check=False)
        except subprocess.TimeoutExpired as error:
            raise NotConvergedError(f"{command[0]} did not print within {_TIME:.0f} s", _ADVICE) from error
    if not file.exists():
        said = done.stderr.decode(errors="replace").strip().splitlines()[-1:]
        raise NotConvergedError(f"{command[0]} printed nothing ({' '.join(said) or 'silently'})", _ADVICE)
    file.write_bytes(_MOMENT.sub(_NO_MOMENT, file.read_bytes()))
    return file


_ADVICE: Final = "open the HTML report in a browser and print it"


def _as_root() -> list[str]:
    """Chromium's sandbox does not start for root, as in containers; the page loads nothing from outside."""
    root = hasattr(os, "geteuid") and os.geteuid() == 0
    return ["--no-sandbox"] if root else []
