"""A stand-in for the workflow, so that the command line is tested without solving anything."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from catenaria.line import load_line
from catenaria.workflow import Progress

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"
Listener = Callable[[Progress], None]


def small_result(droppers: int) -> Any:
    """Build what the summary reads of a result."""
    n = np.arange(droppers)
    wires = [
        SimpleNamespace(
            name=name,
            tension=15_000.0 + error,
            target_tension=15_000.0,
            tension_error=error,
            unstressed_length=194.8125,
            travel=0.0942,
            sag=0.00641,
        )
        for name, error in (("contact wire", -5.31), ("messenger wire", 21.5))
    ]
    return SimpleNamespace(
        inputs=load_line(EXAMPLE).model_dump(mode="json"),
        physics="bending",
        spatial=False,
        audit=SimpleNamespace(passed=True, findings=(), lines=lambda: ("Audit of equilibrium: passed.",) * 3),
        rebuilt=SimpleNamespace(findings=lambda: (), lines=lambda: ("Rebuilt: comes back.",)),
        stop_reason="contact wire: at rest; messenger wire: at rest",
        droppers=SimpleNamespace(
            x=4.0 + 9.5 * n,
            span=n // 7 + 1,
            number=n % 7 + 1,
            length=1.37904 + 0.0 * n,
            cut_length=1.35 + 0.0 * n,
            force_bottom=61.73 + 0.0 * n,
            height_error=-1.07e-5 + 0.0 * n,
            force_error=0.021 + 0.0 * n,
        ),
        wires=wires,
        counters=[
            SimpleNamespace(
                step="contact wire",
                simulated_time=492.3,
                wall_time=0.84,
                steps=475,
                rejected=17,
                factorisations=72,
                unknowns=1452,
            )
        ],
    )


@dataclass
class FakeWorkflow:
    """Records how it was called, reports some progress, and fails as it is told."""

    result: Any = field(default_factory=lambda: small_result(21))
    solve_failure: BaseException | None = None
    write_failure: BaseException | None = None
    solved: list[dict[str, Any]] = field(default_factory=list[dict[str, Any]])
    written: list[tuple[Path, bool]] = field(default_factory=list[tuple[Path, bool]])

    def solve(self, line: Path, method: str, start: Any, progress: Listener, rebuild: str, mesh: Any) -> Any:
        self.solved.append({"line": line, "method": method, "start": start, "rebuild": rebuild, "mesh": mesh})
        progress(Progress("compiling", 1, 3))
        for step, elapsed in ((1, 0.1), (2, 3.0), (3, 10.2), (4, 10.3)):
            progress(
                Progress(
                    "contact wire", 1, 3, 2.5 * step, 0.25, step, 2, "height of dropper 3", 41.7, elapsed
                )
            )
        if self.solve_failure is not None:
            raise self.solve_failure
        progress(Progress("lengths", 3, 3, elapsed=11.0))
        progress(Progress("rebuild", 3, 3, elapsed=11.1))
        return self.result

    def write(
        self,
        result: Any,
        folder: Path,
        figures: bool = True,
        report: bool = False,
        progress: Callable[[str, int, int], None] | None = None,
    ) -> tuple[Path, ...]:
        if self.write_failure is not None:
            raise self.write_failure
        self.written.append((folder, figures))
        return (folder / "result.json", folder / "droppers.csv")


@pytest.fixture
def workflow(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> FakeWorkflow:
    """Put the stand-in in place of the workflow, in an empty working folder."""
    fake = FakeWorkflow()
    monkeypatch.setattr("catenaria.workflow.solve", fake.solve)
    monkeypatch.setattr("catenaria.workflow.write", fake.write, raising=False)
    monkeypatch.chdir(tmp_path)
    return fake
