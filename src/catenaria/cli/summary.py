"""What `catenaria solve` says at the end: dropper schedule, wires, errors, work done."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from rich import box
from rich.console import Console
from rich.table import Table

from catenaria.cli.space_lines import space_lines

if TYPE_CHECKING:
    from catenaria.line import Line
    from catenaria.results import Counters, FormResult

_MOST_ROWS = 24
_HELD = {"contact wire": "contact", "second contact wire": "second", "auxiliary messenger": "aux."}


def show_result(result: FormResult, console: Console) -> None:
    """Print the result in short: droppers, wires, largest errors and counters."""
    from catenaria.line import Line

    console.print(_dropper_table(result))
    hidden = len(result.droppers.x) - _MOST_ROWS
    if hidden > 0:
        console.print(f"  ... and {hidden} more in droppers.csv\n")
    console.print(_wire_table(result))
    hidden = len(result.wires) - _MOST_ROWS
    if hidden > 0:
        console.print(f"  ... and {hidden} more in wires.csv\n")
    line = Line.model_validate(result.inputs)
    console.print(f"Unstressed lengths are those at {line.reference_temperature:g} °C.", soft_wrap=True)
    for text in (
        *space_lines(result),
        *_error_lines(result),
        *_counter_lines(result),
        *result.audit.lines(),
        *result.rebuilt.lines(),
        *_cautions(line, result),
    ):
        console.print(text, soft_wrap=True)


def _cautions(line: Line, result: FormResult) -> tuple[str, ...]:
    from catenaria.line import mesh_caution

    caution = mesh_caution(line)
    return () if caution is None or result.physics != "bending" else (caution,)


def _dropper_table(result: FormResult) -> Table:
    droppers = result.droppers
    columns = ("span", "dropper", "x [m]", "length [m]", "cut to [m]", "force [N]")
    several = result.spatial and len(set(droppers.lower_wire)) > 1
    last = ("error [mm]", "holds") if several else ("height error [mm]",)
    table = _table("Droppers", *columns, *last)
    for i in range(min(_MOST_ROWS, len(droppers.x))):
        table.add_row(
            str(droppers.span[i]),
            str(droppers.number[i]),
            f"{droppers.x[i]:.2f}",
            f"{droppers.length[i]:.4f}",
            f"{droppers.cut_length[i]:.4f}",
            f"{droppers.force_bottom[i]:.2f}",
            f"{1e3 * droppers.height_error[i]:.3f}",
            *((_HELD.get(droppers.lower_wire[i], ""),) if several else ()),
        )
    return table


def _wire_table(result: FormResult) -> Table:
    table = _table(
        "Wires: unstressed length between the end supports",
        "",
        "tension [N]",
        "wanted",
        "length [m]",
        "travel [mm]",
        "sag [mm]",
    )
    for wire in result.wires[:_MOST_ROWS]:
        table.add_row(
            wire.name,
            f"{wire.tension:.1f}",
            f"{wire.target_tension:.1f}",
            f"{wire.unstressed_length:.4f}",
            f"{round(1e3 * wire.travel, 1) + 0.0:.1f}",  # a zero never has a sign
            f"{1e3 * wire.sag:.2f}",
        )
    return table


def _table(title: str, *columns: str) -> Table:
    table = Table(
        title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0)
    )
    for column in columns:
        table.add_column(column, justify="right" if column else "left", no_wrap=True)
    return table


def _error_lines(result: FormResult) -> list[str]:
    height = 1e3 * np.max(np.abs(result.droppers.height_error), initial=0.0)
    force = np.max(np.abs(result.droppers.force_error), initial=0.0)
    tension = max(abs(wire.tension_error) for wire in result.wires)
    return [
        f"Stopped: {result.stop_reason}.",
        f"Largest errors: height {height:.4f} mm, dropper force {force:.3f} N, tension {tension:.2f} N.",
    ]


def _counter_lines(result: FormResult) -> list[str]:
    return [_counter_line(counter) for counter in result.counters]


def _counter_line(work: Counters) -> str:
    if work.simulated_time == 0.0:
        course = f"{work.steps} Newton iterations in {work.wall_time:.3f} s"
        return f"{work.step}: {course}, {work.unknowns} unknowns."
    return (
        f"{work.step}: {work.simulated_time:.0f} s simulated in {work.wall_time:.2f} s with {work.steps} "
        f"steps, {work.rejected} rejected, {work.factorisations} factorisations, {work.unknowns} unknowns."
    )
