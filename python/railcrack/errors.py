"""Exceptions."""

from ._case import Interrupted, NotConverged
from ._errors import BadInput, CaseError, Fault, FolderError, RailcrackError
from ._study import StudyIncomplete

__all__ = [
    "BadInput",
    "CaseError",
    "Fault",
    "FolderError",
    "Interrupted",
    "NotConverged",
    "RailcrackError",
    "StudyIncomplete",
]
