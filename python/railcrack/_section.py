"""Sections of a case as objects."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import TYPE_CHECKING, Any, ClassVar

from ._text import unknown


class Section:
    """A section of a case: its attributes are the keys; those that are None have their defaults."""

    _section: ClassVar[str] = ""
    _fixed: ClassVar[dict[str, str]] = {}

    if not TYPE_CHECKING:

        def __new__(cls, *args: Any, **keys: Any) -> Section:
            known = [field.name for field in fields(cls)]
            for key in keys:
                if key not in known:
                    raise TypeError(unknown(key, known, f"{cls.__name__}() has no argument"))
            return super().__new__(cls)

    def to_dict(self) -> dict[str, Any]:
        """The keys that are given, as a dictionary of the section."""
        given = {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]
        return {**self._fixed, **{key: plain(value) for key, value in given.items() if value is not None}}

    def __repr__(self) -> str:
        keys = {key: value for key, value in self.to_dict().items() if key not in self._fixed}
        return f"{type(self).__name__}({', '.join(f'{key}={value!r}' for key, value in keys.items())})"


def plain(value: Any) -> Any:
    """`value` with dictionaries for the sections in it."""
    if isinstance(value, Section):
        return value.to_dict()
    if isinstance(value, Mapping) and not hasattr(value, "__arrow_c_stream__"):
        return {key: plain(inner) for key, inner in value.items()}
    return [plain(inner) for inner in value] if isinstance(value, (list, tuple)) else value
