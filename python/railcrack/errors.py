"""Exceptions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._run import Run
    from ._study import Study


class RailcrackError(Exception):
    """Base of what railcrack raises."""


class BadInput(RailcrackError, ValueError):
    """An argument that cannot be, or a problem that has no answer."""


class FolderError(RailcrackError, OSError):
    """A folder that is not what it should be, or a file that the system refuses."""


@dataclass(frozen=True)
class Fault:
    """One error of a case or study."""

    message: str
    """Key, value given and what is accepted."""
    file: str
    """The file, or the name of the text."""
    line: int | None
    """Line, from 1."""
    column: int | None
    """Column, in characters, from 1."""
    key: str | None
    """`section.key`; repeated sections count from 1, `crack[2].length_mm`."""
    help: str | None
    """A remedy."""
    text: str
    """All of it on one line."""

    def __str__(self) -> str:
        return self.text


class CaseError(BadInput):
    """A case or study that is wrong: all its errors at once, in `errors`."""

    errors: list[Fault]

    def __init__(self, errors: list[Any]) -> None:
        self.errors = [e if isinstance(e, Fault) else Fault(*e) for e in errors]
        super().__init__(self.errors)

    def __str__(self) -> str:
        return "\n".join(map(str, self.errors))


class NotConverged(RailcrackError):
    """No solution was found. `partial_run` has the growth steps before; None where there are none."""

    partial_run: Run | None

    def __init__(self, message: str, partial_run: Run | None = None) -> None:
        super().__init__(message)
        self.partial_run = partial_run


class Interrupted(KeyboardInterrupt):
    """Ctrl-C. `partial_run` has the growth steps that were finished; go on with
    `case.run(resume=error.partial_run)`."""

    partial_run: Run | None

    def __init__(self, message: str = "interrupted", partial_run: Run | None = None) -> None:
        super().__init__(message)
        self.partial_run = partial_run


class StudyIncomplete(RailcrackError):
    """Runs of a study that could not be computed: `failed` (number, values, reason) and `missing`
    (numbers of runs whose worker was lost; `map` with `resume=True` and the same `out` computes
    them). `study` has the results of all others."""

    def __init__(
        self, message: str, failed: list[tuple[int, str, str]] | None = None, missing: list[int] | None = None
    ) -> None:
        super().__init__(message)
        self.failed = failed or []
        self.study: Study | None = None
        self.missing = missing or []
