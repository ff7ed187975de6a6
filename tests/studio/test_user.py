"""The page without a browser: NiceGUI's simulation of a person."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

from nicegui import ui
from nicegui.testing.user import User
from nicegui.testing.user_simulation import user_simulation

from catenaria.studio.app import root_page
from catenaria.studio.documents import Document, example
from catenaria.studio.limits import AT_ONCE, MOST_TYPED, MOVING

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


def test_droppers_without_counterpart_are_not_compared(paper: Document) -> None:
    async def story(user: User) -> None:
        one(user, "tabs").value = "compare"
        user.find(marker="pin this variant").click()
        for span in range(3):
            await enter(user, f"spans[{span}].droppers", "5, 16, 27, 38, 49, 60")
            said = "no span has as many droppers" if span == 2 else "droppers differ by up to"
            await until(lambda said=said: said in str(one(user, "text-compare").text))

    play(paper, story)


def test_the_description_is_edited_beside_the_name(paper: Document) -> None:
    async def story(user: User) -> None:
        await enter(user, "description", "with <b>other</b> droppers")
        assert "audit passed" in status(user)
        user.find(marker="undo").click()
        await solved(user)
        assert one(user, "description").value == paper.tree["description"]

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


def told(user: User) -> list[str]:
    """Return the faults that the tab of the file lists."""
    buttons = sorted(user.find(kind=ui.button).elements, key=lambda element: element.id)
    return [str(button.text) for button in buttons if "found" in button.text]


async def applied(user: User, text: str) -> None:
    one(user, "file-text").value = text
    user.find(marker="apply").click()
    await asyncio.sleep(0.2)
    await solved(user)


def test_the_file_is_edited_as_text(paper: Document) -> None:
    async def story(user: User) -> None:
        one(user, "tabs").value = "file"
        editor = one(user, "file-text")
        assert editor.value == paper.text
        await applied(user, "# mine\n" + paper.text.replace("length: 65 m", "length: 66 m"))
        assert "audit passed" in status(user)
        assert one(user, "spans[2].length").value == "66"
        await enter(user, "spans[1].length", "67")
        assert "    length: 66 m\n" in editor.value
        assert "  - length: 67 m\n" in editor.value
        assert editor.value.startswith("# mine\n# A three-span")
        user.find(marker="undo").click()
        user.find(marker="undo").click()
        await solved(user)
        assert editor.value == paper.text
        assert one(user, "spans[2].length").value == "65"

    play(paper, story)


def test_what_is_wrong_with_a_text_is_told_by_line_and_column(paper: Document) -> None:
    async def story(user: User) -> None:
        one(user, "tabs").value = "file"
        editor = one(user, "file-text")
        await applied(user, "a: [\n" + paper.text)
        assert told(user)[0].startswith("17:5 the file: found a YAML error")
        assert "audit passed" in status(user)  # the line is what it was
        assert one(user, "apply").enabled
        await applied(user, "speed: fast\n" + paper.text.replace("65 m\n", "65 kg\n"))
        assert [text.split(":")[:2] for text in told(user)] == [
            ["1", "8 speed"],
            ["72", "13 spans[0].length"],
        ]
        assert status(user) == "not solved: shown is the last form"
        assert not one(user, "apply").enabled
        assert one(user, "speed").value == "fast"
        await enter(user, "speed", "")
        assert editor.value.startswith("# A three-span")
        assert told(user)[0].startswith("71:13 spans[0].length")

    play(paper, story)


def test_what_was_typed_stays_until_it_is_given_up(paper: Document) -> None:
    async def story(user: User) -> None:
        one(user, "tabs").value = "file"
        said = one(user, "file-said")
        one(user, "file-text").value = typed = "# typed\n" + paper.text
        assert said.text == "Changed, not applied yet."
        await enter(user, "name", "other")
        assert one(user, "file-text").value == typed
        assert "edited elsewhere" in said.text
        await user.open("/")
        await solved(user)
        one(user, "tabs").value = "file"
        assert one(user, "file-text").value == typed
        assert "edited elsewhere" in one(user, "file-said").text
        user.find(marker="take-text").click()
        await until(lambda: "name: other\n" in one(user, "file-text").value)
        assert "# typed" not in one(user, "file-text").value
        await user.should_not_see(marker="take-text")

    play(paper, story)


def test_line_breaks_of_other_systems_stay(paper: Document) -> None:
    text = paper.text.replace("\n", "\r\n")

    async def story(user: User) -> None:
        one(user, "tabs").value = "file"
        assert one(user, "file-text").value == paper.text
        await applied(user, "# mine\n" + paper.text)
        user.find(marker="save-line").click()
        assert (await user.download.next()).content == b"# mine\r\n" + text.encode()

    play(paper.rewritten(text), story)


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


def test_a_replay_can_be_stopped_and_begun_again() -> None:
    async def story(user: User) -> None:
        said = one(user, "replayed")
        user.find(marker="move").click()
        await until(lambda: "steps" in said.text)
        assert "s of computing: line, " in said.text
        assert "dead bands" in said.text
        user.find(marker="stop").click()
        await until(lambda: said.text.startswith("Stopped after "))
        assert one(user, "move").enabled
        assert not one(user, "play").enabled
        tree = example("simple_60m").tree
        await enter(user, "name", tree["name"] + " again")
        assert said.text.startswith("The dynamic method")

    play(example("simple_60m"), story)


def test_a_replay_plays_to_its_end(paper: Document) -> None:
    async def story(user: User) -> None:
        user.find(marker="move").click()
        slider = one(user, "frame")
        await until(lambda: one(user, "play").enabled)
        slider.value = 195  # of 200
        await until(lambda: one(user, "replayed").text.endswith("at rest"))
        assert slider.value == 199
        assert one(user, "replayed").text.startswith("2 of 2: messenger wire, ")

    play(paper, story)


def test_a_field_takes_no_books(paper: Document) -> None:
    async def story(user: User) -> None:
        element = one(user, "description")
        before = element.value
        element.value = "x" * (MOST_TYPED + 1)
        user.find(marker="description").trigger("change")
        await user.should_see("characters at most")
        assert element.value == before
        element = await enter(user, "description", "x" * MOST_TYPED)
        assert element.value == "x" * MOST_TYPED

    play(paper, story)


def test_a_motion_waits_for_nobody_and_is_refused_while_others_are_computed(paper: Document) -> None:
    async def story(user: User) -> None:
        user.find("Replay").click()
        for _ in range(AT_ONCE):
            assert MOVING.acquire(blocking=False)
        try:
            user.find(marker="move").click()
            await until(lambda: "Other tabs" in one(user, "replayed").text)
        finally:
            MOVING.release(AT_ONCE)
        user.find(marker="move").click()
        await until(lambda: "simulated time" in one(user, "replayed").text)
        await until(lambda: one(user, "play").enabled)
        assert MOVING.acquire(blocking=False)  # it was given back
        MOVING.release()

    play(paper, story)


def test_a_row_becomes_all_rows(paper: Document) -> None:
    async def story(user: User) -> None:
        await enter(user, "spans[0].pre_sag_per_mille", "0.5")
        await enter(user, "spans[2].pre_sag", "20")
        user.find(marker="all-spans[0].pre_sag_per_mille").click()
        await solved(user)
        assert [one(user, f"spans[{i}].pre_sag_per_mille").value for i in range(3)] == ["0.5"] * 3
        assert one(user, "spans[2].pre_sag").value == ""
        assert "audit passed" in status(user)
        user.find(marker="undo").click()
        await solved(user)
        assert one(user, "spans[2].pre_sag").value == "20"
        assert one(user, "spans[1].pre_sag_per_mille").value == ""

    play(paper, story)


def test_staggers_and_names_have_no_button_for_all(paper: Document) -> None:
    async def story(user: User) -> None:
        await user.should_see(marker="all-supports[0].contact_wire.height")
        for name in ("stagger", "name"):
            await user.should_not_see(marker=f"all-supports[0].{name}")

    play(paper, story)
