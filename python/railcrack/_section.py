"""Sections of a case as objects."""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Mapping
from dataclasses import fields
from typing import TYPE_CHECKING, Any, ClassVar

from ._text import unknown


class Explained:
    """The docstring of a class of a section, read when it is asked for: what the class is, and the
    strings below its attributes, which editors show and `help` does not."""

    def __init__(self, summary: str | None) -> None:
        self.summary = summary

    def __get__(self, _: object, cls: type) -> str | None:
        # A dataclass in the making only asks whether there is one.
        if "__match_args__" not in vars(cls):
            return self.summary
        try:
            body = ast.parse(textwrap.dedent(inspect.getsource(cls))).body[0].body  # type: ignore[attr-defined]
        except OSError:
            return self.summary
        keys = [
            textwrap.fill(f"{ast.unparse(name.target)}: {' '.join(ast.literal_eval(text.value).split())}", 96, subsequent_indent="    ")
            for name, text in zip(body, body[1:], strict=False)
            if isinstance(name, ast.AnnAssign) and isinstance(text, ast.Expr)
        ]
        return "\n".join([inspect.cleandoc(self.summary or ""), "", *keys])


class Section:
    """A section of a case: its attributes are the keys; those that are None have their defaults."""

    def __init_subclass__(cls) -> None:
        cls.__doc__ = Explained(cls.__doc__)  # type: ignore[assignment]

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
