"""What a result is handed on as: the whole of it, files for other programs, and a report."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from catenaria import workflow
from catenaria.results import FormResult
from catenaria.workflow import ExportFormat


@dataclass(frozen=True, eq=False, repr=False)
class Output:
    """A result that can be written.

    Attributes
    ----------
    form : FormResult
        What was found, as arrays in SI units.
    """

    form: FormResult

    def save(self, folder: str | os.PathLike[str], figures: bool = True) -> tuple[Path, ...]:
        """Write everything into a folder, as ``catenaria solve --out`` does: all of it or nothing.

        Parameters
        ----------
        folder : path
            Where to; an earlier result in it is replaced, anything else is not touched.
        figures : bool
            Whether to draw figures.

        Returns
        -------
        tuple of Path
            The files.

        Raises
        ------
        InconsistentInputError
            If the folder holds something that is not an earlier result.
        """
        return workflow.write(self.form, folder, figures)

    def export(
        self,
        out: str | os.PathLike[str],
        formats: ExportFormat | Sequence[ExportFormat] | None = None,
        *,
        step: float = 1e-3,
        modes: int = 20,
    ) -> tuple[Path, ...]:
        """Write what others go on with, as ``catenaria export`` does: all of it or nothing.

        Parameters
        ----------
        out : path
            A folder; an earlier export in it is replaced, anything else is not touched. For one of xlsx, csv,
            vtk and json also the file.
        formats : str or sequence of str, optional
            Of ``xlsx``, ``csv``, ``dxf``, ``vtk``, ``json``, ``dynamics`` and ``exudyn``; by default all that
            the result has.
        step : float
            Cut lengths of droppers are also given rounded to whole steps [m].
        modes : int
            How many natural modes dynamics codes get.

        Returns
        -------
        tuple of Path
            The files.

        Raises
        ------
        InconsistentInputError
            If there is no such format, or `out` holds what catenaria did not write.
        UnsupportedError
            If a library is missing, or the result has no nodes and dynamics codes want them.
        NotConvergedError, InfeasibleError
            If the built line, which dynamics codes get, does not come to rest.
        """
        chosen = workflow.formats_of(self.form) if formats is None else formats
        named = (chosen,) if isinstance(chosen, str) else chosen
        return workflow.export(self.form, named, out, workflow.ExportOptions(step, modes))

    def report(
        self,
        file: str | os.PathLike[str],
        *,
        speed: float | None = None,
        rules: str | os.PathLike[str] | None = None,
        date: str = "",
        pdf: bool = False,
        elasticity: bool = True,
    ) -> tuple[Path, ...]:
        """Write a report, as ``catenaria report`` does: one HTML page that opens without a network.

        Parameters
        ----------
        file : path
            Where to; an earlier file of this name is replaced.
        speed : float, optional
            Of trains [m/s]; by default that of the line.
        rules : path, optional
            File of rules; by default those of catenaria.
        date : str
            As it shall stand in the report.
        pdf : bool
            Whether an installed Chromium or Chrome prints it to a PDF file of the same name too.
        elasticity : bool
            Whether elasticity is found for it, with the defaults of `elasticity`.

        Returns
        -------
        tuple of Path
            The files.

        Raises
        ------
        LineFileError, InconsistentInputError
            If the rules cannot be used.
        UnsupportedError
            If a library or the browser is missing.
        NotConvergedError
            If the browser does not print.
        """
        page = workflow.report(self.form, speed, rules, date, elasticity=elasticity)
        return workflow.write_report(page, file, pdf)
