"""The audit imports nothing of what it audits."""

from __future__ import annotations

import ast
from pathlib import Path

import catenaria.audit

ALLOWED = {"audit", "results", "errors"}


def shared(source: str) -> set[str]:
    """Return the packages of catenaria that a file imports and the audit may not."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    own = {name.split(".")[1] for name in names if name.startswith("catenaria.")}
    return own - ALLOWED


def test_the_audit_shares_no_code_with_what_it_checks() -> None:
    files = sorted(Path(catenaria.audit.__file__).parent.rglob("*.py"))
    assert len(files) > 5
    for file in files:
        assert shared(file.read_text(encoding="utf-8")) == set(), file.name


def test_a_shared_import_is_noticed() -> None:
    assert shared("from catenaria.mechanics.chain import Chain") == {"mechanics"}
    assert shared("import catenaria.numerics.gauss") == {"numerics"}
