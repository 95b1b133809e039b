"""Texts of cases and studies together with the contents of the files that they name."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any, TypeVar

from . import _toml
from ._errors import CaseError
from ._section import plain


@dataclass(frozen=True)
class Source:
    """A text, its name in errors, and the contents of the files that it names."""

    text: str
    name: str
    files: tuple[tuple[str, bytes], ...] = ()
    is_written: bool = True
    """Whether the user wrote the text, so that its lines mean something in errors."""

    @classmethod
    def of(cls, sections: Mapping[str, Any] | str, name: str) -> Source:
        """A source from a text or from a dictionary of sections; file names are relative to the
        working directory."""
        if isinstance(sections, str):
            return cls.gathered(sections, name, Path())
        named, tables = _toml.without_tables(plain(sections), "table")
        source = cls.gathered(_toml.write(named), name, Path())
        return cls(source.text, name, (*source.files, *tables), is_written=False)

    @classmethod
    def gathered(cls, text: str, name: str, folder: Path, under: str = "") -> Source:
        """`text` with the files that it names, relative to `folder`. Files outside of the folder
        are renamed, and so are all files if they are to be placed `under` a separate folder."""
        try:
            sections = _toml.read(text)
        except ValueError:
            return cls(text, name)  # the reader reports its errors
        files: dict[str, bytes] = {}
        renamed: dict[str, str] = {}
        for value in _texts({key: value for key, value in sections.items() if key != "title"}):
            file = folder / value
            if not value or "\n" in value or len(value) > 1000 or not file.is_file():
                continue
            inside = not file.is_absolute() and ".." not in PurePosixPath(value).parts
            inside = inside and not PurePosixPath(value).is_absolute()
            kept = value if inside and not under else f"{under or 'outside'}-{len(files)}/{file.name}"
            files[kept] = file.read_bytes()
            if kept != value:
                renamed[value] = kept
        if renamed:
            text = _toml.write(_renamed(sections, renamed))
        return cls(text, name, tuple(files.items()))

    def changed(self, changes: Mapping[str, Any]) -> Source:
        """The source with `changes`, whose file names are relative to the working directory."""
        changes, tables = _toml.without_tables(plain(changes), f"changed-{len(self.files)}")
        new = Source.gathered(_toml.write(changes), self.name, Path(), f"changed-{len(self.files)}")
        text = _toml.write(_toml.changed(_toml.read(self.text), _toml.read(new.text) | _removed(changes)))
        return Source(text, self.name, (*self.files, *new.files, *tables), is_written=False)


Made = TypeVar("Made", bound="Sourced")


class Sourced:
    """A validated case or study, pickled by its source."""

    _core: Any
    _source: Source

    @staticmethod
    def _parse(text: str, name: str, folder: Path, files: list[tuple[str, bytes]]) -> Any:
        """The Rust object of `text`; relative file names refer to `files`, or to `folder` without
        them."""
        raise NotImplementedError

    @classmethod
    def _of(cls: type[Made], source: Source, core: Any = None) -> Made:
        """The object of `source`, with the Rust object `core` if known."""
        made = cls.__new__(cls)
        made._set(source, core)
        return made

    def _set(self, source: Source, core: Any = None) -> None:
        self._source = source
        if core is None:
            try:
                core = self._parse(source.text, source.name, Path(), list(source.files))
            except CaseError as error:
                if source.is_written:
                    raise
                raise error.by_argument(source.name) from None
        self._core = core

    @classmethod
    def _read(cls: type[Made], path: str | os.PathLike[str]) -> Made:
        """The object of the file `path`, with the files that it names."""
        path = Path(path)
        text = _read_text(path)
        core = cls._parse(text, str(path), path.parent, [])
        return cls._of(Source.gathered(text, str(path), path.parent), core)

    @property
    def text(self) -> str:
        """The original text."""
        return self._source.text

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self)._of, (self._source,)


def _read_text(path: Path) -> str:
    """The text of a case or study file."""
    try:
        return path.read_bytes().decode("utf-8")
    except UnicodeDecodeError as error:
        message = f"not UTF-8 text: byte {error.start + 1} is not part of a valid character"
        fault = (message, str(path), None, None, None, "save the file as UTF-8", f"{path}: {message}")
        raise CaseError([fault]) from None


def _removed(changes: Mapping[str, Any]) -> dict[str, Any]:
    """The changes that remove keys, which TOML cannot express, with the changes next to them."""
    return {
        name: change
        for name, change in changes.items()
        if change is None or (isinstance(change, Mapping) and any(value is None for value in change.values()))
    }


def _texts(value: Any) -> list[str]:
    if isinstance(value, str):
        return [value]
    if isinstance(value, Mapping):
        value = list(value.values())
    return [text for item in value for text in _texts(item)] if isinstance(value, list) else []


def _renamed(value: Any, names: Mapping[str, str]) -> Any:
    if isinstance(value, str):
        return names.get(value, value)
    if isinstance(value, Mapping):
        return {key: value if key == "title" else _renamed(value, names) for key, value in value.items()}
    return [_renamed(item, names) for item in value] if isinstance(value, list) else value
