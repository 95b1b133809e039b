"""Cases and runs."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _errors, _railcrack, _toml
from ._errors import PUBLIC, BadInput, FolderError, RailcrackError
from ._html import facts
from ._packed import packed, unpack
from ._plot import RunPlots
from ._progress import Progress, teller
from ._results import RunResults
from ._section import Section
from ._sections import Changes, Sections
from ._source import Source, Sourced
from ._table import Table

if TYPE_CHECKING:
    from typing_extensions import Unpack

History = NDArray[np.float64]
"""K through the stabilised passage: shape (samples, 2), K_I and K_II in MPa√m, in the order of
events, both unloaded ends included."""


@dataclass(frozen=True)
class Check:
    """Sizes, bounds and warnings of a case before it is computed."""

    text: str
    """The complete summary, as printed by `railcrack check`."""
    face_points: int
    """Points on the crack faces at the start."""
    tips: int
    """Crack tips at the start."""
    displacement_unknowns: int
    """Finite-element unknowns; 0 with dislocations."""
    memory_bytes: int
    """Estimated memory."""
    p0_over_k: float
    """Peak pressure over the shear yield stress."""
    first_yield_p0_over_k: float | None
    """Its value at first yield of the virgin rail; None if the contact has no such bound."""
    shakedown_limit_p0_over_k: float | None
    """Its value at the elastic shakedown limit; None if the contact has no such bound."""
    warnings: list[str]
    """Warnings, as sentences."""

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return f"<pre>{escape(self.text)}</pre>"


class Case(Sourced):
    """A validated case: rail, wheel, cracks, growth.

    >>> case = Case(contact=rc.Hertz(845.0, 6.75, friction=0.1), growth=rc.Growth(steps=5),
    ...             cracks=[rc.Crack(mouth_mm=0.0, length_mm=6.0, angle_deg=15.0, friction=0.3)])

    The keys are those of the case file (docs/case-file.md); a section is an object of its class or
    a dictionary. A case never changes; `with_` makes
    another one. It can be pickled together with the files that it names.

    Raises `CaseError` with all errors at once, each with file, line, column and key.
    """

    _core: _railcrack.Case
    _parse = staticmethod(_railcrack.Case.parse)

    def __init__(self, sections: Mapping[str, Any] | str | None = None, **given: Unpack[Sections]) -> None:
        """A case from its sections (`contact`, `cracks` or `wheels`, `growth`, …), from a
        dictionary of them, or from the text of a case file. File names are relative to the working
        directory."""
        self._set(Source.of(_sections(sections, given), "case"))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Case:
        """The case in the file `path`."""
        return cls._read(path)

    def with_(self, **sections: Unpack[Changes]) -> Case:
        """The case with other values: `case.with_(growth={"steps": 5}, cracks={"friction": 0.2})`.

        Sections are changed key by key and added if missing; None removes a key or a section. A
        dictionary for `cracks` changes every crack, a list replaces them.
        """
        return Case._of(self._source.changed(_singular(sections)))

    @property
    def title(self) -> str:
        """Title, the heading of plots and reports."""
        return self._core.title

    @property
    def steps(self) -> int:
        """Number of increments."""
        return self._core.steps

    @property
    def _is_open_ended(self) -> bool:
        """Whether the run ends when the answer is known, with `steps` as a limit."""
        return "steps" not in _toml.read(self.text).get("growth", {})

    @property
    def engine(self) -> str:
        """`xfem` or `dislocation`."""
        return self._core.engine

    @property
    def cracks(self) -> list[NDArray[np.float64]]:
        """Each crack: shape (points, 2), x and y in mm, from the first point on."""
        return [np.array(points) for points in self._core.cracks]

    def to_toml(self) -> str:
        """The case with every default filled in."""
        return self._core.to_toml()

    def check(self) -> Check:
        """Sizes, bounds and warnings; nothing is computed."""
        return Check(**self._core.check())

    def wheels(self) -> Table:
        """What each wheel makes of the cracks as they are at the beginning: `wheels.csv` of
        `railcrack contact`, with a row per wheel of the case or of its table, in its order. A table
        of wheels may be given as a data frame:

        >>> case = Case({"wheel": [{"table": frame, "creepage_sign": "vehicle"}], "crack": …})
        >>> joined = frame.merge(case.wheels().to_pandas(), on="wheel")

        Raises `RailcrackError` if a passage cannot be computed.
        """
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder)
            for name, content in self._source.files:
                file = path / "case" / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(content)
            (path / "case").mkdir(exist_ok=True)
            (path / "case" / "case.toml").write_text(self._source.text, encoding="utf-8")
            out = path / "out"
            code = _railcrack.command(
                ["railcrack", "contact", str(path / "case" / "case.toml"), "--out", str(out), "--quiet"]
            )
            if code:
                raise RailcrackError(f"`railcrack contact` ended with exit code {code}")
            return _wheels((out / "wheels.csv").read_text(encoding="utf-8"))

    def run(
        self,
        *,
        progress: Progress = False,
        threads: int | None = None,
        resume: Run | None = None,
        law: Callable[[History], float] | None = None,
        direction: Callable[[History], float | None] | None = None,
    ) -> Run:
        """Computes crack growth in memory; `Run.save` writes the run folder.

        progress: True for a bar, or a function that is called with a `Step`.
        threads: number of threads, None for one per processor; it does not affect the results.
        resume: an interrupted run of this case to continue.
        law: user-defined growth rate in mm per cycle as a function of the history of a tip,
            replacing the law of the case.
        direction: user-defined kink in degrees from straight ahead, counter-clockwise, as a
            function of the same history, replacing the criterion of the case; None for an unloaded
            tip.

        Raises `NotConverged` and, on Ctrl-C, within one load step, `Interrupted`; the finished
        steps are in their `partial_run`. Other Python threads continue to run.
        """
        told = teller(progress, self.steps + 1, ends_before=self._is_open_ended)
        try:
            before = resume._core if resume is not None else None
            if before is not None and not resume._is_in_memory:  # type: ignore[union-attr]
                raise BadInput("a run in a folder is resumed by `railcrack run --resume`")
            core, ended, why = self._core.run(threads, told, before, law, direction)
        finally:
            told.close()
        run = Run(core, in_memory=True, case=self)
        if not ended:
            return run
        partial = run if len(run.growth.step) else None
        if ended == "interrupted":
            raise Interrupted(partial_run=partial)
        if ended == "NotConverged":
            raise NotConverged(why, partial_run=partial)
        raise getattr(_errors, ended)(why)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Case) and self._source.files == other._source.files and self.to_toml() == other.to_toml()

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __repr__(self) -> str:
        limit = "at most " if self._is_open_ended else ""
        cracks = len(self._core.cracks)
        what = f"{cracks} crack{'s' * (cracks != 1)}, {limit}{self.steps} steps, {self.engine}"
        return f"<railcrack.Case {self.title!r}: {what}>"

    def _repr_html_(self) -> str:
        rows = [("engine", self.engine), ("cracks", len(self._core.cracks)), ("increments", self.steps)]
        text = f"<details><summary>all values</summary><pre>{escape(self.to_toml())}</pre></details>"
        return facts(self.title, rows, text)


def _singular(sections: Mapping[str, Any]) -> dict[str, Any]:
    """`sections` with the names of the case file for lists: `crack` of `cracks`."""
    names = {"cracks": "crack", "wheels": "wheel"}
    for several, one in names.items():
        if several in sections and one in sections:
            raise TypeError(f"{several}, {one}: only one of them")
    return {names.get(name, name): section for name, section in sections.items()}


def _sections(sections: Mapping[str, Any] | str | None, given: Mapping[str, Any]) -> Mapping[str, Any] | str:
    """The sections of a case, given as one argument or as several."""
    if isinstance(sections, str) and given:
        raise TypeError(f"{', '.join(given)}: not beside a text; Case(text).with_(…) changes it")
    if isinstance(sections, str):
        return sections
    for name, section in given.items():
        if name in ("crack", "cracks", "wheel", "wheels") and isinstance(section, Section):
            raise TypeError(f"{name}: a list, [{section!r}]")
    return _singular({**(sections or {}), **given})


_COUNTS = ("wheel", "representative")


def _wheels(text: str) -> Table:
    """The table in the text of `wheels.csv`."""
    header, *rows = [line.split(",") for line in text.splitlines() if line and not line.startswith("#")]
    columns: dict[str, tuple[Any, list[str] | None, str]] = {}
    for i, name in enumerate(header):
        values = np.array([float(row[i]) if row[i] else np.nan for row in rows])
        whole = name in _COUNTS and not np.isnan(values).any()
        columns[name] = (values.astype(np.int64) if whole else values, None, "")
    return Table("wheels", columns)


class Run(RunResults):
    """A run, computed by `Case.run` or stored in a run folder (`Run.open`).

    The tables are those of the run folder, with the same columns (docs/file-formats.md). A run can
    be pickled; the pickle contains its run folder without plots and report.
    """

    def __init__(self, core: _railcrack.Run, *, in_memory: bool, case: Case | None = None, folder: Path | None = None) -> None:
        super().__init__(core, in_memory=in_memory, folder=folder)
        self._case = case

    @classmethod
    def open(cls, folder: str | os.PathLike[str]) -> Run:
        """The run in `folder`."""
        return cls(_railcrack.Run.open(Path(folder)), in_memory=False, folder=Path(folder))

    @property
    def case(self) -> Case:
        """The case."""
        if self._case is None:
            if self._folder is None:
                raise FolderError("the run has no case")
            self._case = Case.read(self._folder / "case.toml")
        return self._case

    @property
    def plot(self) -> RunPlots:
        """Plots by matplotlib: `run.plot.sif()`, `.paths()`, `.length()`, `.faces()`."""
        return RunPlots(self)

    def __reduce__(self) -> tuple[Any, ...]:
        with tempfile.TemporaryDirectory(prefix="railcrack-") as scratch:
            folder = self.save(Path(scratch) / "run", report=False) if self._is_in_memory else self._folder
            return _unpacked, (packed(folder or Path()),)

    def __repr__(self) -> str:
        where = "in memory" if self._is_in_memory else str(self._folder)
        return f"<railcrack.Run {self.title!r}: {self.steps} steps, {self.stop or 'not ended'}, {where}>"


def _unpacked(content: bytes) -> Run:
    """A run from its packed folder, which is kept as long as the run."""
    folder = tempfile.TemporaryDirectory(prefix="railcrack-")
    unpack(content, Path(folder.name))
    run = Run.open(folder.name)
    run._keeps = folder
    return run


class NotConverged(RailcrackError):
    """No solution was found. `partial_run` has the growth steps before the failure; None without
    any."""

    __module__ = PUBLIC

    partial_run: Run | None

    def __init__(self, message: str, partial_run: Run | None = None) -> None:
        super().__init__(message)
        self.partial_run = partial_run


class Interrupted(KeyboardInterrupt):
    """Interrupted by Ctrl-C. `partial_run` has the finished growth steps; continue with
    `case.run(resume=error.partial_run)`."""

    __module__ = PUBLIC

    partial_run: Run | None

    def __init__(self, message: str = "interrupted", partial_run: Run | None = None) -> None:
        super().__init__(message)
        self.partial_run = partial_run
