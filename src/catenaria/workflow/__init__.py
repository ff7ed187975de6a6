"""The one place that wires line, method and result together."""

from catenaria.formfinding.progress import Progress
from catenaria.workflow.solve import METHODS, solve
from catenaria.workflow.write import write

__all__ = ["METHODS", "Progress", "solve", "write"]
