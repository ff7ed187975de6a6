"""An audit of results: geometry, lengths and forces checked by code of its own, whatever the method."""

from __future__ import annotations

from catenaria.audit.audit import audit_result
from catenaria.results.audit import Audit

__all__ = ["Audit", "audit_result"]
