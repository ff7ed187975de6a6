"""Checks of a result by rules of standards and practice: value, limit, place and verdict."""

from catenaria.report.checks.check import Check
from catenaria.report.checks.judge import check_columns, judge, write_checks
from catenaria.report.checks.rules import Rule, Rules, load_rules

__all__ = ["Check", "Rule", "Rules", "check_columns", "judge", "load_rules", "write_checks"]
