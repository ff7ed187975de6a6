"""The server of the studio: where it listens, whom it lets in, and a session for each tab."""

from __future__ import annotations

import ipaddress
import socket
import sys
from collections.abc import Callable
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

from catenaria.errors import InconsistentInputError, UnsupportedError
from catenaria.studio.documents import MOST_BYTES, Document
from catenaria.studio.state import Session

_OWN = frozenset({"localhost", "127.0.0.1", "::1"})
_SHARE = 1e-3  # s that a computation has before pages are served again
_FORGOTTEN = 12 * 3600.0  # s after which a page that is loaded again begins anew


# Figures follow the width of the window, as far as they are shown.
_RESIZED = """<script type="module">
document.documentElement.lang = "en";
window.addEventListener("resize", async () => {
  const { Plotly } = await import("nicegui-plotly");
  for (const figure of document.querySelectorAll(".js-plotly-plot")) {
    if (figure.offsetWidth > 0 && figure.layout) Plotly.Plots.resize(figure);
  }
});
</script>"""


# The browser's tab knows that it had a session, also when the studio that had it is gone.
_REMEMBERED = """
if (sessionStorage.getItem("catenaria studio")) emitEvent("begun_anew");
sessionStorage.setItem("catenaria studio", "begun");
"""
_ANEW = (
    "This page begins anew: the studio was started again, or the page was closed for more than 12 hours, "
    "or it is a copy of another one. What was edited here before is gone."
)


@dataclass(frozen=True)
class Address:
    """Where the studio listens.

    Attributes
    ----------
    host : str
        Name or address.
    port : int
        Of TCP.
    """

    host: str
    port: int

    @property
    def url(self) -> str:
        """What a browser opens."""
        return f"http://{f'[{self.host}]' if ':' in self.host else self.host}:{self.port}"


def is_loopback(host: str) -> bool:
    """Return whether only this computer reaches a host.

    Examples
    --------
    >>> is_loopback("127.0.0.1"), is_loopback("localhost"), is_loopback("0.0.0.0")
    (True, True, False)
    """
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def address(host: str, port: int, expose: bool) -> Address:
    """Return where to listen; port 0 stands for one that is free.

    Raises
    ------
    InconsistentInputError
        If others would reach the host and that is not wanted explicitly, or it is taken.
    """
    if not is_loopback(host) and not expose:
        raise InconsistentInputError(
            f"--host: found {host!r}; allowed: 127.0.0.1, or --expose as well: others who reach this "
            "computer could then use the studio, which asks for no password"
        )
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except (OSError, OverflowError) as error:
            raise InconsistentInputError(f"{host}, port {port}, cannot be used: {error}") from error
        return Address(host, probe.getsockname()[1])


def require_studio_libraries() -> None:
    """Refuse to go on without NiceGUI.

    Raises
    ------
    UnsupportedError
        With what to install.
    """
    try:
        import nicegui  # noqa: F401  # pyright: ignore[reportUnusedImport]
    except ModuleNotFoundError as error:
        raise UnsupportedError(
            'the studio needs NiceGUI, which is not installed: pip install "catenaria[studio]"'
        ) from error


def _session_of(tab: str, document: Document) -> Session:
    """Return the session of a tab, which outlives a reload; a duplicate of the tab gets one of its own."""
    from nicegui import app

    kept: Any = app.storage.tab
    key = f"session of {tab}"
    session: Session = kept.get(key) or Session(document)
    kept[key] = session  # also if it was there: its age is that of the latest change
    return session


def _say_what_was_lost() -> None:
    """Tell a page that had a line before why it has another one."""
    from nicegui import ui

    ui.on(
        "begun_anew", lambda: ui.notify(_ANEW, type="warning", multi_line=True, timeout=0, close_button=True)
    )
    ui.run_javascript(_REMEMBERED)


def root_page(document: Document) -> Callable[[], object]:
    """Return what builds a page: each tab of a browser begins with the document and goes on by itself."""
    from nicegui import ui

    from catenaria.studio.page import Page

    style = files("catenaria.studio").joinpath("studio.css").read_text(encoding="utf-8")

    async def page() -> None:
        client = ui.context.client
        ui.add_css(style)
        ui.add_body_html(_RESIZED)
        await client.connected()
        if not client.has_socket_connection:  # whoever asked for the page did not stay
            return
        session = _session_of(client.tab_id or "", document)
        begins = session.outcome is None and not session.can_undo
        Page(session)
        if begins:
            _say_what_was_lost()

    return page


def serve(document: Document, where: Address, browser: bool) -> None:
    """Serve the studio until it is interrupted.

    Parameters
    ----------
    document : Document
        With which every tab begins.
    where : Address
        Where to listen.
    browser : bool
        Whether to open a browser.
    """
    from nicegui import app, ui

    from catenaria.studio.guard import Guard

    hosts = _OWN | {where.host} if is_loopback(where.host) else frozenset[str]()
    app.add_middleware(Guard, hosts=hosts, most=MOST_BYTES)
    app.storage.max_tab_storage_age = _FORGOTTEN
    sys.setswitchinterval(_SHARE)
    run: Any = ui.run  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
    run(
        root_page(document),
        host=where.host,
        port=where.port,
        title="catenaria studio",
        show=browser,
        reload=False,
        show_welcome_message=False,
        ws_per_message_deflate=not is_loopback(where.host),  # takes longer than sending to oneself
    )
