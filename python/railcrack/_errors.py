"""Exceptions without results. Users find them, with all others, in `railcrack.errors`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

PUBLIC = "railcrack.errors"
"""The module in which users and pickles find the exceptions."""


class RailcrackError(Exception):
    """Base of what railcrack raises."""

    __module__ = PUBLIC


class BadInput(RailcrackError, ValueError):
    """An argument that cannot be, or a problem that has no answer."""

    __module__ = PUBLIC


class FolderError(RailcrackError, OSError):
    """A folder that is not what it should be, or a file that the system refuses."""

    __module__ = PUBLIC


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

    __module__ = PUBLIC

    errors: list[Fault]

    def __init__(self, errors: list[Any]) -> None:
        self.errors = [e if isinstance(e, Fault) else Fault(*e) for e in errors]
        super().__init__(self.errors)

    def __str__(self) -> str:
        return "\n".join(map(str, self.errors))
