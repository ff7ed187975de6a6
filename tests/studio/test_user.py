"""The page without a browser: NiceGUI's simulation of a person."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

from nicegui.testing.user import User
from nicegui.testing.user_simulation import user_simulation

from catenaria.studio.app import root_page
from catenaria.studio.documents import Document

Story = Callable[[User], Awaitable[None]]
TICKS = 300  # of 0.1 s


def play(paper: Document, story: Story) -> None:
    """Let a person open the studio and do something."""

    async def run() -> None:
        async with user_simulation(root_page(paper)) as user:
            await user.open("/")
            await solved(user)
            await story(user)

    asyncio.run(run())


async def until(true: Callable[[], bool]) -> None:
    for _ in range(TICKS):
        if true():
            return
        await asyncio.sleep(0.1)
    raise TimeoutError


def one(user: User, marker: str) -> Any:
    (element,) = user.find(marker=marker).elements
    return element


def status(user: User) -> str:
    try:
        return str(one(user, "status").text)
    except AssertionError:  # not there yet
        return ""


async def solved(user: User) -> None:
    await until(lambda: "solved" in status(user) or status(user).endswith(" ms"))


async def enter(user: User, field: str, text: str) -> Any:
    element = one(user, field)
    element.value = text
    user.find(marker=field).trigger("change")
    await asyncio.sleep(0)
    await solved(user)
    return element


def test_bad_input_is_marked_and_can_be_taken_back(paper: Document) -> None:
    async def story(user: User) -> None:
        assert "audit passed" in status(user)
        element = await enter(user, "spans[1].length", "65 kg")
        assert element.error == 'found "65 kg"; allowed: a length, for example "65 m"'
        assert status(user) == "not solved: shown is the last form"
        user.find(marker="undo").click()
        await solved(user)
        assert "audit passed" in status(user)
        assert one(user, "spans[1].length").value == "65"
        assert element.error is None

    play(paper, story)


def test_numbers_follow_an_edit(paper: Document) -> None:
    async def story(user: User) -> None:
        one(user, "tabs").value = "droppers"
        before = [row["length"] for row in one(user, "table-droppers").rows]
        await enter(user, "messenger_wire.tension.force", "16")
        after = [row["length"] for row in one(user, "table-droppers").rows]
        assert len(before) == len(after) == 21
        assert all(float(new) > float(old) for old, new in zip(before, after, strict=True))

    play(paper, story)


def test_two_people_do_not_see_each_other(paper: Document) -> None:
    async def run() -> None:
        async with user_simulation(root_page(paper)) as first:
            await first.open("/")
            await solved(first)
            await enter(first, "name", "secret")
            second = User(first.http_client)
            await second.open("/")
            await solved(second)
            assert one(second, "name").value == paper.tree["name"]
            assert one(first, "name").value == "secret"
            await first.open("/")  # a reload keeps what was edited
            await solved(first)
            assert one(first, "name").value == "secret"

    asyncio.run(run())
