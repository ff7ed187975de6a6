"""From a result to a folder of files."""
from catenaria.report.figures import write_figures
