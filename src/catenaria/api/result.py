"""A result as people look at it: tables as data frames, figures, places, studies."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

from catenaria import workflow
from catenaria.api import notebook, summary
from catenaria.api.cross_section import CrossSection, cross_section
from catenaria.api.output import Output
from catenaria.api.plots import Plots
from catenaria.errors import InconsistentInputError
from catenaria.line import Line
from catenaria.line.load import model_from
from catenaria.line.load_case import LoadCases
from catenaria.loading.tolerance import Options
from catenaria.report.tables import TABLES, TableName
from catenaria.report.tables import table as form_table
from catenaria.results import Audit, FormResult, Rebuilt
from catenaria.results.case import LoadStudy
from catenaria.results.codec import encode
from catenaria.results.elasticity import ElasticityStudy
from catenaria.results.tolerance import ToleranceStudy
from catenaria.workflow.elasticity import elasticity

if TYPE_CHECKING:
    from pandas import DataFrame  # pyright: ignore[reportMissingTypeStubs]  # pandas-stubs are optional


@dataclass(frozen=True, eq=False, repr=False)
class Result(Output):
    """What was found for a line.

    Every table is a new `pandas.DataFrame` in full precision, whose column names carry the unit as suffix
    (``length_m``, ``force_top_N``); they are those of the CSV files. Two results are equal if everything in
    them is, times of computation aside.

    Attributes
    ----------
    form : FormResult
        The same as arrays in SI units.
    """

    @property
    def name(self) -> str:
        """Name of the line."""
        return self.form.name

    @property
    def method(self) -> str:
        """Name of the method that found it."""
        return self.form.method

    @property
    def line(self) -> Line:
        """The line that was solved."""
        return Line.model_validate(self.form.inputs)

    @property
    def audit(self) -> Audit:
        """What an independent audit found: `passed`, `findings`, and all its checks."""
        return self.form.audit

    @property
    def rebuilt(self) -> Rebuilt:
        """Where a line that is built from the found lengths comes to rest."""
        return self.form.rebuilt

    @property
    def passed(self) -> bool:
        """Whether there was an audit and it passed, and the rebuild too, if there was one."""
        audited = bool(self.audit.name) and self.audit.passed
        return audited and (not self.rebuilt.way or self.rebuilt.passed)

    @property
    def droppers(self) -> DataFrame:
        """The dropper schedule, one row for each dropper."""
        return self.table("droppers")

    @property
    def wires(self) -> DataFrame:
        """Lengths, tensions, travel and sag, one row for each wire."""
        return self.table("wires")

    @property
    def supports(self) -> DataFrame:
        """Forces on supports, one row for each wire held at each support."""
        return self.table("supports")

    @property
    def arms(self) -> DataFrame:
        """Forces and hinges of steady arms, one row for each; empty for lines without arms."""
        return self.table("arms")

    @property
    def controls(self) -> DataFrame:
        """How closely every wanted tension, height and force was met."""
        return self.table("controls")

    def table(self, name: TableName) -> DataFrame:
        """Return any table that ``catenaria solve --out`` writes, by the name of its CSV file.

        Parameters
        ----------
        name : str
            ``droppers``, ``wires``, ``supports``, ``arms``, ``ties``, ``masses``, ``cantilevers``,
            ``controls``, ``counters``, ``configuration`` or ``history``.

        Raises
        ------
        InconsistentInputError
            If there is no such table.
        """
        if name not in TABLES:
            raise InconsistentInputError(f"there is no table {name!r}; there is {', '.join(TABLES)}")
        return form_table(self.form, name)

    def profile(self, wire: str = "contact wire") -> DataFrame:
        """Return the shape of a wire, its tension and its moment, one row for each point along it.

        Parameters
        ----------
        wire : str
            Its name.

        Raises
        ------
        InconsistentInputError
            If there is no wire of that name.

        Examples
        --------
        >>> from catenaria import solve
        >>> result = solve("examples/yang2017_three_span.yaml", rebuild="none")
        >>> shape = result.profile("messenger wire")
        >>> float(shape["height_m"].min().round(4))
        0.9657
        """
        only = replace(self.form, wires=(self.form.wire(wire),))
        return form_table(only, "configuration").drop(columns="wire")

    def at(self, chainage: float) -> CrossSection:
        """Return where all wires are at a chainage, their tensions, and the nearest dropper.

        Between the points of `profile` lines are taken as straight, which on the meshes of the examples
        misses the curve by less than 0.05 mm.

        Parameters
        ----------
        chainage : float
            Where [m].

        Raises
        ------
        InconsistentInputError
            If no wire is there.

        Examples
        --------
        >>> from catenaria import solve
        >>> result = solve("examples/yang2017_three_span.yaml", rebuild="none")
        >>> result.at(97.5)
        CrossSection at 97.500 m
          contact wire     0.0000 m high, 0.0000 m to the left, 15000.1 N
          messenger wire   0.9657 m high, 0.0000 m to the left, 14992.6 N
          nearest dropper  4 of span 2 at 97.500 m, 0.9657 m long, lifts the contact wire with 86.05 N
        """
        return cross_section(self.form, chainage)

    @property
    def plot(self) -> Plots:
        """Figures: ``result.plot.profile()``, ``plan()``, ``tension(wire)``, ``moments()``."""
        return Plots(self.form)

    def under(self, cases: LoadCases | str | os.PathLike[str] | Mapping[str, Any]) -> LoadStudy:
        """Return the line, built with the lengths that were found, under load cases.

        Parameters
        ----------
        cases : LoadCases, path or mapping
            The cases, the file that describes them, or a mapping from their names to what would stand in
            such a file, as in ``{"summer": {"temperature": {"change": "40 K"}}}``.

        Raises
        ------
        LineFileError, InconsistentInputError
            If a case cannot be used, or names what the line does not have.
        UnsupportedError
            If the result comes from a method without nodes.
        NotConvergedError, InfeasibleError
            If the line does not come to rest under a case.

        Examples
        --------
        >>> from catenaria import solve
        >>> result = solve("examples/yang2017_three_span.yaml", rebuild="none")
        >>> study = result.under({"pushed": {"push": [{"chainage": "97.5 m", "force": "100 N"}]}})
        >>> study.cases[0].pushed.uplift.round(3).tolist()  # m
        [0.057]
        """
        if isinstance(cases, Mapping):
            cases = model_from({"format": 1, "cases": dict(cases)}, LoadCases, "load cases")
        return workflow.under_loads(self.form, cases)

    def elasticity(
        self,
        force: float = 100.0,
        spacing: float = 0.5,
        *,
        nonlinear: bool = False,
        start: float | None = None,
        end: float | None = None,
    ) -> ElasticityStudy:
        """Return how far the contact wire rises where a static force pushes it.

        Parameters
        ----------
        force : float
            On all contact wires together [N]; 0 for the limit of a small force.
        spacing : float
            Of the points [m]; supports, droppers and middles of spans are added.
        nonlinear : bool
            Whether to solve every point with all nonlinearities.
        start, end : float, optional
            First and last chainage [m]; by default the first and the last support of the contact wire.

        Raises
        ------
        InconsistentInputError, UnsupportedError
            If force or points make no sense, or the result comes from a method without nodes.
        NotConvergedError, InfeasibleError
            If the line does not come to rest.
        """
        return elasticity(self.form, force, spacing, nonlinear=nonlinear, start=start, end=end)

    def tolerance(
        self,
        errors: str | os.PathLike[str] | None = None,
        *,
        samples: int = 10_000,
        model: Literal["nonlinear", "linear"] = "nonlinear",
        workers: int = 1,
        band: float = 0.005,
        seed: int | None = None,
    ) -> ToleranceStudy:
        """Return how the line scatters under errors of its installation.

        Parameters
        ----------
        errors : path, optional
            The file that describes them. If left out, those of the line, or the usual ones.
        samples : int
            Number of lines with random errors.
        model : {"nonlinear", "linear"}
            Whether every sample is brought to rest, or the line is linearised.
        workers : int
            Number of processes.
        band : float
            By how much heights of the contact wire may be off [m].
        seed : int, optional
            Instead of that of the errors.

        Raises
        ------
        LineFileError, InconsistentInputError, UnsupportedError
            If the errors cannot be used, or the result comes from a method without nodes.
        NotConvergedError, InfeasibleError
            If the line does not rest where it was found, or no sample comes to rest.
        """
        options = Options(samples=samples, model=model, workers=workers, tolerance=band)
        return workflow.tolerances(self.form, errors, options, seed)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Result):
            return NotImplemented
        (tree, arrays), (their_tree, theirs) = _comparable(self.form), _comparable(other.form)
        return tree == their_tree and all((arrays[name] == theirs[name]).all() for name in arrays)

    __hash__ = None  # pyright: ignore[reportAssignmentType]  # arrays have no hash

    def __repr__(self) -> str:
        return summary.as_text(self.form)

    def _repr_html_(self) -> str:
        return notebook.as_html(self.form)


def _comparable(form: FormResult) -> tuple[Any, Mapping[str, Any]]:
    """Return all that a result says of its line, without the times of its computation."""
    counters = tuple(replace(counter, wall_time=0.0) for counter in form.counters)
    return encode(replace(form, counters=counters), FormResult)
