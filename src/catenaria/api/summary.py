"""A result in a few lines of text, for terminals and notebooks."""

from __future__ import annotations

from collections import Counter

import numpy as np

from catenaria.results import FormResult


def facts(form: FormResult) -> dict[str, str]:
    """Return what is worth knowing at first, by label."""
    return {
        "line": _line(form),
        "method": form.method,
        "wires": _wires(form),
        "droppers": _droppers(form),
        "errors": _errors(form),
        "audit": audit_verdict(form),
        "rebuild": rebuild_verdict(form),
    }


def as_text(form: FormResult) -> str:
    """Return the facts below each other, as a terminal shows them."""
    told = facts(form)
    width = max(map(len, told))
    rows = (f"  {label:{width}}  {text}" for label, text in told.items())
    return "\n".join((f"Result: {form.name or 'a line without name'}", *rows))


def audit_verdict(form: FormResult) -> str:
    """Say in a few words how the audit ended."""
    audit = form.audit
    if not audit.name:
        return "none"
    if audit.passed:
        return f"passed, {len(audit.name)} checks"
    return f"FAILED: {audit.findings[0]}{_more(len(audit.findings))}"


def rebuild_verdict(form: FormResult) -> str:
    """Say in a few words how the rebuild ended."""
    rebuilt = form.rebuilt
    if not rebuilt.way:
        return "none"
    findings = rebuilt.findings()
    if findings:
        return f"FAILED: {findings[0]}{_more(len(findings))}"
    height, force = (float(np.abs(part.change).max(initial=0.0)) for part in (rebuilt.height, rebuilt.force))
    return f"passed, comes back within {1e3 * height:.4f} mm and {force:.3f} N"


def _more(count: int) -> str:
    return f" (and {count - 1} more)" if count > 1 else ""


def _line(form: FormResult) -> str:
    spans = len(set(form.supports.support)) - 1
    chainage = form.supports.chainage
    length = float(chainage.max() - chainage.min())
    return f"{spans} spans, {length:g} m, {len(form.wires)} wires, {form.droppers.x.size} droppers"


def _wires(form: FormResult) -> str:
    """Name wires that supports hold, and count those between other wires."""
    named = [f"{wire.name} {wire.tension:.1f} N" for wire in form.wires if wire.name in form.supports.wire]
    others = Counter(wire.role for wire in form.wires if wire.name not in form.supports.wire)
    counted = [f"{count} {role}{'s' if count > 1 else ''}" for role, count in others.items()]
    return ", ".join(named + counted)


def _droppers(form: FormResult) -> str:
    droppers = form.droppers
    if not droppers.x.size:
        return "none"
    slack = int(np.count_nonzero(droppers.slack))
    return (
        f"{droppers.length.min():.3f} to {droppers.length.max():.3f} m long, "
        f"lift {droppers.force_bottom.min():.1f} to {droppers.force_bottom.max():.1f} N, "
        f"{f'{slack} SLACK' if slack else 'none slack'}"
    )


def _errors(form: FormResult) -> str:
    height = 1e3 * np.abs(form.droppers.height_error).max(initial=0.0)
    tension = max(abs(wire.tension_error) for wire in form.wires)
    return f"height {height:.4f} mm, tension {tension:.2f} N"
