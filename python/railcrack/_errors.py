"""Exceptions without results. The public names of all exceptions are in `railcrack.errors`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

PUBLIC = "railcrack.errors"
"""The public module of the exceptions, also for pickles."""


class RailcrackError(Exception):
    """Base class of the exceptions of railcrack."""

    __module__ = PUBLIC


class BadInput(RailcrackError, ValueError):
    """An invalid argument, or a problem without a solution."""

    __module__ = PUBLIC


class FolderError(RailcrackError, OSError):
    """An unsuitable folder, or a file that cannot be read or written."""

    __module__ = PUBLIC


@dataclass(frozen=True)
class Fault:
    """One error of a case or study."""

    message: str
    """Key, value given and what is accepted."""
    file: str
    """File, or name of the text."""
    line: int | None
    """Line, from 1."""
    column: int | None
    """Column, in characters, from 1."""
    key: str | None
    """`section.key`; repeated sections count from 1, `crack[2].length_mm`."""
    help: str | None
    """A remedy."""
    text: str
    """The complete error on one line."""

    def __str__(self) -> str:
        return self.text

    def by_argument(self) -> Fault:
        """The error of a value that was given in Python: with the argument instead of a line."""
        # A dictionary is written as a table, whose heading is not its value.
        message = self.message.removeprefix(f"`{self.key} = [{self.key}]`: ")
        text = ": ".join(filter(None, [self.key, message]))
        text += f" ({self.help})" if self.help else ""
        return replace(self, message=message, line=None, column=None, text=text)


class CaseError(BadInput):
    """An invalid case or study; `errors` lists all its errors."""

    __module__ = PUBLIC

    errors: list[Fault]

    def __init__(self, errors: list[Any]) -> None:
        self.errors = [e if isinstance(e, Fault) else Fault(*e) for e in errors]
        super().__init__(self.errors)

    def by_argument(self, name: str) -> CaseError:
        """The same errors, those of the text called `name` with their arguments instead of lines."""
        return CaseError([fault.by_argument() if fault.file == name else fault for fault in self.errors])

    def __str__(self) -> str:
        return "\n".join(map(str, self.errors))
