"""The guard: own pages come in, other sites and large bodies do not."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator

import pytest

from catenaria.studio.guard import Guard, Message, Receive, Scope, Send

OWN = frozenset({"127.0.0.1", "localhost"})
MOST = 1000


class Inside:
    """An application that reads a whole request and says how long it was."""

    def __init__(self) -> None:
        self.read: list[int] = []

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        size, more = 0, scope["type"] == "http"
        while more:
            message = await receive()
            size += len(message.get("body", b""))
            more = bool(message.get("more_body", False))
        self.read.append(size)
        await send({"type": "http.response.start", "status": 200, "headers": []})


def ask(
    headers: dict[str, str], parts: tuple[bytes, ...] = (b"",), kind: str = "http"
) -> tuple[object, Inside]:
    """Return the status (or code) of the answer, and what came through."""
    inside, said = Inside(), list[Message]()
    scope: Scope = {"type": kind, "headers": [(k.encode(), v.encode()) for k, v in headers.items()]}
    bodies: Iterator[tuple[int, bytes]] = iter(enumerate(parts, start=1))

    async def receive() -> Message:
        number, body = next(bodies)
        return {"type": "http.request", "body": body, "more_body": number < len(parts)}

    async def send(message: Message) -> None:
        said.append(message)

    asyncio.run(Guard(inside, OWN, MOST)(scope, receive, send))
    return said[0].get("status", said[0].get("code")), inside


@pytest.mark.parametrize(
    "headers",
    [
        {"host": "127.0.0.1:8080"},
        {"host": "localhost"},
        {"host": "127.0.0.1:8080", "origin": "http://127.0.0.1:8080"},
    ],
)
def test_own_pages_come_in(headers: dict[str, str]) -> None:
    assert ask(headers)[0] == 200


@pytest.mark.parametrize("kind", ["http", "websocket"])
@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"host": "[::1"},
        {"host": "evil.example"},
        {"host": "evil.example:8080", "origin": "http://evil.example:8080"},
        {"host": "127.0.0.1:8080", "origin": "http://evil.example"},
        {"host": "127.0.0.1:8080", "origin": "http://127.0.0.1:9"},
        {"host": "127.0.0.1:8080", "origin": "null"},
    ],
)
def test_other_sites_do_not(headers: dict[str, str], kind: str) -> None:
    status, inside = ask(headers, kind=kind)
    assert status == (1008 if kind == "websocket" else 403)
    assert inside.read == []


def test_a_body_is_bounded_whatever_it_declares() -> None:
    host, part = {"host": "localhost"}, b"x" * 9000
    assert ask(host, (part, part))[1].read == [18000]
    status, inside = ask(host, (part, part, part))
    assert (status, inside.read) == (413, [])
    status, inside = ask(host | {"content-length": "999999"}, (b"",))
    assert (status, inside.read) == (413, [])


def test_an_exposed_server_has_any_name() -> None:
    inside, said = Inside(), list[Message]()

    async def receive() -> Message:
        return {"type": "http.request", "body": b""}

    async def send(message: Message) -> None:
        said.append(message)

    scope: Scope = {"type": "http", "headers": [(b"host", b"studio.example")]}
    asyncio.run(Guard(inside, frozenset(), MOST)(scope, receive, send))
    assert said[0]["status"] == 200


def answered(guarded: bool, headers: dict[str, str]) -> dict[bytes, bytes]:
    """Return the headers of an answer of the application with its guard or without."""
    said = list[Message]()

    async def receive() -> Message:
        return {"type": "http.request", "body": b""}

    async def send(message: Message) -> None:
        said.append(message)

    scope: Scope = {"type": "http", "headers": [(k.encode(), v.encode()) for k, v in headers.items()]}
    application = Guard(Inside(), OWN, MOST) if guarded else Inside()
    asyncio.run(application(scope, receive, send))
    return dict(said[0]["headers"])


@pytest.mark.parametrize("host", ["localhost", "evil.example"])
def test_no_other_site_frames_a_page_or_guesses_its_type(host: str) -> None:
    headers = answered(True, {"host": host})
    assert b"frame-ancestors 'none'" in headers[b"content-security-policy"]
    assert headers[b"x-frame-options"] == b"DENY"
    assert headers[b"x-content-type-options"] == b"nosniff"
    assert headers[b"referrer-policy"] == b"no-referrer"
    assert answered(False, {"host": host}) == {}
