"""What the server lets in: requests of bounded size to its own name, from its own pages."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any, Final
from urllib.parse import urlsplit

Message = MutableMapping[str, Any]
Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
Application = Callable[[Scope, Receive, Send], Awaitable[None]]

_ENVELOPE: Final = 20_000  # bytes around an uploaded file

# No other site shows the studio in a frame, where clicks could be led astray, or makes anything of its files.
_HEADERS: Final = (
    (b"content-security-policy", b"frame-ancestors 'none'; object-src 'none'; base-uri 'self'"),
    (b"x-frame-options", b"DENY"),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-resource-policy", b"same-origin"),
)


class _TooLargeError(Exception):
    """A request goes on after it should have ended."""


class Guard:
    """A layer around the application.

    A page of another site that a person has open in the same browser can send requests to this computer: such
    requests name another host (when a name was bound anew to this address) or another origin.

    Parameters
    ----------
    app : callable
        What it guards.
    hosts : frozenset of str
        Names under which the server is reached; empty for any.
    most : int
        Size of an uploaded file [bytes].
    """

    def __init__(self, app: Application, hosts: frozenset[str], most: int) -> None:
        self._app = app
        self._hosts = hosts
        self._most = most + _ENVELOPE

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Hand a request on, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        headers = {key.decode("latin-1").lower(): value.decode("latin-1") for key, value in scope["headers"]}
        if not self._is_ours(headers):
            await _refuse(scope, _protected(send), 403, "another host or origin")
        elif _declared(headers) > self._most:
            await _refuse(scope, _protected(send), 413, "too large")
        else:
            await self._bounded(scope, receive, _protected(send))

    def _is_ours(self, headers: dict[str, str]) -> bool:
        host, origin = headers.get("host", ""), headers.get("origin")
        try:
            known = not self._hosts or (urlsplit(f"//{host}").hostname or "") in self._hosts
            return known and (origin is None or urlsplit(origin).netloc == host)
        except ValueError:  # no name of a host at all
            return False

    async def _bounded(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "websocket":
            await self._app(scope, receive, send)
            return
        received = 0

        async def counted() -> Message:
            nonlocal received
            message = await receive()
            received += len(message.get("body", b""))
            if received > self._most:
                raise _TooLargeError
            return message

        try:
            await self._app(scope, counted, send)
        except _TooLargeError:
            await _refuse(scope, send, 413, "too large")


def _declared(headers: dict[str, str]) -> int:
    length = headers.get("content-length", "0")
    return int(length) if length.isdecimal() else 0


def _protected(send: Send) -> Send:
    """Return what sends an answer with the headers that tell a browser to keep others out."""

    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            message = {**message, "headers": [*message.get("headers", ()), *_HEADERS]}
        await send(message)

    return sent


async def _refuse(scope: Scope, send: Send, status: int, why: str) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": why})
        return
    kind = [(b"content-type", b"text/plain; charset=utf-8")]
    await send({"type": "http.response.start", "status": status, "headers": kind})
    await send({"type": "http.response.body", "body": f"Refused: {why}.\n".encode()})
