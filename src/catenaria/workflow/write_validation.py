"""From validated cases to pages with figures."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from catenaria.results import files_of, replace_folder
from catenaria.validation.page import FIGURES, case_page, figure_name, overview
from catenaria.workflow.validate import ValidatedCase


def write_validation(cases: Sequence[ValidatedCase], folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write an overview, a page for each case and its figures into a folder, all of it or nothing.

    Parameters
    ----------
    cases : sequence of ValidatedCase
        What was validated.
    folder : path
        Where to; earlier pages in it are replaced, anything else is not touched.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    InconsistentInputError
        If the folder holds something that this function did not write.
    """
    from catenaria.report import style  # slow to import
    from catenaria.workflow.validation_figures import draw

    with replace_folder(folder) as new:
        (new / "index.md").write_text(overview([case.outcome for case in cases]), encoding="utf-8")
        (new / FIGURES).mkdir()
        for case in cases:
            outcome = case.outcome
            (new / f"{outcome.name}.md").write_text(case_page(outcome), encoding="utf-8")
            for drawing in outcome.case.figures:
                file = new / FIGURES / figure_name(outcome.name, drawing)
                style.save(draw(case, drawing), file, compact=True)
    return files_of(folder)
