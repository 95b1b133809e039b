"""Studies."""

from __future__ import annotations

import os
import queue
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _railcrack
from ._case import Case, Interrupted, Run, _singular
from ._errors import PUBLIC, BadInput, RailcrackError
from ._html import facts
from ._packed import packed, unpack
from ._plot import StudyPlots
from ._progress import Progress, teller
from ._source import Source, Sourced
from ._table import Table

if TYPE_CHECKING:
    import pandas

Files = dict[str, bytes]
Failed = tuple[int, str, str]


class Study(Sourced):
    """A study, which is a case with lists of values, and its results.

    `map` computes it, in this process or in several; `table` has one row per run, and
    `for run in study` gives the runs. A study can be pickled; results in a temporary folder travel
    with it, those in a folder of the user stay there.

    Raises `CaseError` with all errors of all its cases at once.
    """

    _core: _railcrack.Study
    _parse = staticmethod(_railcrack.Study.parse)
    _out: Path | None = None
    _keeps: object = None

    def __init__(self, sections: Mapping[str, Any] | str) -> None:
        """A study from a dictionary of sections with lists of values, or from the text of a study
        file. File names are relative to the working directory."""
        self._set(Source.of(sections if isinstance(sections, str) else _singular(sections), "study"))

    @classmethod
    def of(cls, case: Case, **lists: Mapping[str, Any]) -> Study:
        """The study of `case` with lists instead of values:
        `Study.of(case, contact={"friction": [0.1, 0.2]}, cracks={"angle_deg": [15.0, 30.0]})`, or
        with distributions: `study={"samples": 50}, contact={"friction": {"uniform": [0.1, 0.2]}}`.
        `study={"combine": "zip"}` takes lists element by element."""
        source = case._source.changed(_singular(lists))
        return cls._of(replace(source, name="study"))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Study:
        """The study in the file `path`."""
        return cls._read(path)

    @classmethod
    def open(cls, folder: str | os.PathLike[str]) -> Study:
        """The study in `folder`, computed by `railcrack sweep` or `map`."""
        text = _railcrack.Study.stored_text(Path(folder))
        study = cls._of(Source.gathered(text, "study.toml", Path(folder)))
        study._out = Path(folder)
        return study

    @property
    def title(self) -> str:
        """Title, the heading of its plots."""
        return self._core.title

    @property
    def numbers(self) -> list[int]:
        """Numbers of its runs, from 1."""
        return [number for number, _, _ in self._core.runs]

    @property
    def keys(self) -> dict[str, list[str]]:
        """The varying keys with their values as text."""
        return dict(self._core.keys)

    def __len__(self) -> int:
        return len(self._core.runs)

    def __iter__(self) -> Iterator[Run]:
        """The runs of a computed study; those that could not be computed are left out."""
        states = self.results["state"]
        return (self.run(number) for number, state in zip(self.numbers, states, strict=True) if state == "done")

    @property
    def cases(self) -> Iterator[Case]:
        """The case of each run."""
        return (self.case(number) for number in self.numbers)

    def case(self, number: int) -> Case:
        """The case of a run."""
        core = self._core.case(number)
        if core is None:
            raise BadInput(f"run {number}: must be from 1 to {len(self)}")
        files = tuple((name, text.encode()) for name, text in core.companions())
        return Case._of(Source(core.to_toml(), f"run {number}", files), core)

    def map(
        self,
        executor: Any = None,
        *,
        out: str | os.PathLike[str] | None = None,
        resume: bool = False,
        replace: bool = False,
        progress: Progress = False,
        threads: int | None = None,
        report: bool = False,
    ) -> Study:
        """Computes the runs and returns the study with its results.

        executor: anything with `submit` (`concurrent.futures`, the client of `dask.distributed`,
            `mpi4py.futures`) or with `map` (a pool of `multiprocessing`), or a `joblib.Parallel`;
            None computes in this process, on `threads` threads. Workers return the files of the run folders.
        out: the folder of the study, as written by `railcrack sweep`; None: a temporary folder,
            kept as long as the returned study.
        resume: continue the study in `out` without computing finished runs again.
        replace: remove what `out` holds of another study.
        threads: threads of each run; by default 1 with an executor, otherwise all processors.
        report: plots and report of every run too, not only of the study.

        Raises `StudyIncomplete` at the end if runs failed or their workers were lost; the other
        results are in `out`. Raises `Interrupted` on Ctrl-C.
        """
        keeps = None if out is not None else tempfile.TemporaryDirectory(prefix="railcrack-study-")
        folder = Path(out) if out is not None else Path(keeps.name if keeps else "") / "study"
        waiting, failed = self._core.enter(folder, self.numbers, "resume" if resume else "replace" if replace else "begin")
        told = teller(progress, len(waiting), "run")
        lost: list[int] = []
        interrupted = False
        try:
            if executor is None:
                new, interrupted = self._core.compute(folder, waiting, report, threads, _Counted(told))
                failed.extend(f for f in new if f not in failed)
            else:
                task = _Task(self._source, 1 if threads is None else threads, report)
                results = _results(executor, task, waiting)
                folders = {number: name for number, _, name in self._core.runs}
                there: list[int] = []
                for done, (number, answer) in enumerate(results):
                    if isinstance(answer, BaseException):
                        lost.append(number)
                        told("said", f"run {number}: {answer!r}")
                    else:
                        files, new = answer
                        _put(folder, folders[number], files)
                        failed.extend(new)
                        there.append(number)
                        if len(there) == _PACKED_AT_ONCE:
                            self._core.pack(folder, there)
                            there = []
                    told("run", done)
                self._core.pack(folder, there)
        except KeyboardInterrupt:
            interrupted = True
        finally:
            told.close()
        self._core.gather(folder)
        study = Study._of(self._source)
        study._out, study._keeps = folder, keeps
        if interrupted:
            raise Interrupted(f"interrupted; continue the study in {folder} with resume=True")
        if failed or lost:
            raise _incomplete(failed, lost, study)
        return study

    def _folder_of(self, number: int) -> str:
        return next(folder for n, _, folder in self._core.runs if n == number)

    @property
    def folder(self) -> Path:
        """Folder of the results."""
        if self._out is None:
            raise BadInput("the study is not computed: study.map() computes it")
        return self._out

    @cached_property
    def results(self) -> Table:
        """A row per run: its number, its folder, the values that vary, and the columns of
        `summary.csv`."""
        folders, values, columns = _railcrack.Study.results(self.folder)
        first: dict[str, Any] = {
            "run": (np.arange(1, len(folders) + 1), None, "Number of the run."),
            "folder": (folders, None, "Its folder in runs/."),
        }
        for key, texts in values:
            first[key] = (_numbers(texts), None, f"Value of {key}.")
        return Table("summary", {**first, **columns})

    @property
    def table(self) -> pandas.DataFrame:
        """`results` as a `pandas.DataFrame`."""
        return self.results.to_pandas()

    def run(self, number: int) -> Run:
        """The results of a run."""
        if not 1 <= number <= len(self):
            raise BadInput(f"run {number}: must be from 1 to {len(self)}")
        run = Run.open(_railcrack.Study.run_folder(self.folder, number))
        run._keeps = self._keeps
        return run

    @property
    def plot(self) -> StudyPlots:
        """Plots with matplotlib."""
        return StudyPlots(self)

    def __reduce__(self) -> tuple[Any, ...]:
        if self._out is None:
            return _unpacked, (self._source, None, None)
        if self._keeps is None:
            return _unpacked, (self._source, self._out.absolute(), None)
        return _unpacked, (self._source, None, packed(self._out))

    def __repr__(self) -> str:
        where = "not computed" if self._out is None else str(self._out)
        return f"<railcrack.Study {self.title!r}: {len(self)} runs, {where}>"

    def _repr_html_(self) -> str:
        rows: list[tuple[str, Any]] = [("runs", len(self))]
        rows.extend((key, ", ".join(values)) for key, values in self.keys.items())
        return facts(self.title, rows, self.results._repr_html_() if self._out is not None else "")


def _unpacked(source: Source, folder: Path | None, content: bytes | None) -> Study:
    """A study with its results, if it has any."""
    study = Study._of(source)
    study._out = folder
    if content is not None:
        study._keeps = tempfile.TemporaryDirectory(prefix="railcrack-study-")
        study._out = Path(study._keeps.name) / "study"
        unpack(content, study._out)
    return study


class StudyIncomplete(RailcrackError):
    """Runs of a study that could not be computed: `failed` (number, values, reason) and `missing`
    (numbers of runs whose worker was lost; `map` with `resume=True` and the same `out` computes
    them). `study` has the results of all others."""

    __module__ = PUBLIC

    def __init__(
        self, message: str, failed: list[tuple[int, str, str]] | None = None, missing: list[int] | None = None
    ) -> None:
        super().__init__(message)
        self.failed = failed or []
        self.study: Study | None = None
        self.missing = missing or []


# Maximum number of runs from workers packed together, if the study keeps no run folders.
_PACKED_AT_ONCE = 200


class _Counted:
    """Counts finished runs."""

    def __init__(self, told: Any) -> None:
        self.told, self.done = told, 0

    def __call__(self, kind: str, value: Any) -> None:
        self.told("run", self.done)
        self.told("said", value)
        self.done += 1


class _Task:
    """Computes a run of a study in a worker process and returns the files of its run folder."""

    def __init__(self, source: Source, threads: int, report: bool) -> None:
        self.source, self.threads, self.report = source, threads, report

    def __call__(self, number: int) -> tuple[Files, list[Failed]]:
        study = _study_of(self.source)
        with tempfile.TemporaryDirectory(prefix="railcrack-run-") as scratch:
            folder = Path(scratch) / "study"
            failed, interrupted = study._core.compute(folder, [number], self.report, self.threads, None, travel=True)
            if interrupted:
                raise Interrupted()
            run = folder / "runs" / study._folder_of(number)
            files = {str(f.relative_to(run).as_posix()): f.read_bytes() for f in run.rglob("*") if f.is_file()}
        return files, failed


@lru_cache(maxsize=4)
def _study_of(source: Source) -> Study:
    """The study of a worker, read once."""
    return Study._of(source)


def _results(executor: Any, task: _Task, numbers: list[int]) -> Iterable[tuple[int, Any]]:
    """The results, or the exceptions of lost workers, in order of completion."""
    if hasattr(executor, "n_jobs") and callable(executor):  # joblib
        yield from zip(numbers, executor((task, (number,), {}) for number in numbers), strict=True)
        return
    if not hasattr(executor, "submit"):
        mapped = getattr(executor, "imap", None) or executor.map
        yield from zip(numbers, mapped(task, numbers), strict=True)
        return
    over: queue.SimpleQueue[tuple[int, Any]] = queue.SimpleQueue()
    futures, number = [], 0
    try:
        for number in numbers:
            future = executor.submit(task, number)
            futures.append(future)
            future.add_done_callback(lambda done, number=number: over.put((number, done)))
    except Exception as error:  # a broken executor accepts no more work
        for left in numbers[len(futures) :]:
            yield left, error
    try:
        for _ in range(len(futures)):
            number, future = _next(over)
            try:
                yield number, future.result()
            except (KeyboardInterrupt, RailcrackError):
                raise
            except BaseException as error:  # noqa: BLE001 - raised by the worker or by the executor
                yield number, error
    except BaseException:
        for future in futures:
            future.cancel()
        raise


def _next(over: queue.SimpleQueue[tuple[int, Any]]) -> tuple[int, Any]:
    """The next finished future; waits with a timeout, so that Ctrl-C is handled."""
    while True:
        try:
            return over.get(timeout=0.2)
        except queue.Empty:
            continue


def _put(study: Path, folder: str, files: Files) -> None:
    """Writes the files of a run to its folder, those that record its end last."""
    run = study / "runs" / folder
    for name in sorted(files, key=lambda name: (name in ("summary.json", "outcome.json"), name)):
        path = run / name
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(path.name + ".partial")
        partial.write_bytes(files[name])
        partial.replace(path)


def _incomplete(failed: list[Failed], lost: list[int], study: Study) -> StudyIncomplete:
    parts = [f"run {number} ({label}): {reason}" for number, label, reason in failed]
    if lost:
        parts.append(f"{len(lost)} runs were lost with their workers: map(..., resume=True) with the same `out` computes them")
    error = StudyIncomplete("\n".join(parts), failed, sorted(lost))
    error.study = study
    return error


def _numbers(texts: list[str]) -> Any:
    """Numbers if all texts are numbers."""
    try:
        return np.array([float(text) for text in texts])
    except ValueError:
        return texts
