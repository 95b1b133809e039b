"""Conversion between TOML and dictionaries."""

from __future__ import annotations

import datetime
import os
import sys
from collections.abc import Mapping, Sequence
from typing import Any

import tomli_w

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


def read(text: str) -> dict[str, Any]:
    """The dictionary that `text` describes."""
    return tomllib.loads(text)


def write(sections: Mapping[str, Any]) -> str:
    """The text of `sections`: a dictionary of values, of dictionaries (sections) and of lists of
    dictionaries (repeated sections), with NumPy or Python numbers; None is left out."""
    return tomli_w.dumps(_plain(sections))


def without_tables(sections: Mapping[str, Any], prefix: str) -> tuple[dict[str, Any], list[tuple[str, bytes]]]:
    """`sections` with data frames (pandas, polars) replaced by names of CSV files, and these files."""
    files: list[tuple[str, bytes]] = []

    def named(value: Any) -> Any:
        text = _csv(value)
        if text is not None:
            files.append((f"{prefix}-{len(files)}.csv", text.encode()))
            return files[-1][0]
        if isinstance(value, Mapping):
            return {key: named(inner) for key, inner in value.items()}
        return [named(inner) for inner in value] if isinstance(value, list) else value

    return {name: named(value) for name, value in sections.items()}, files


def _csv(value: Any) -> str | None:
    """The text of a data frame; None of anything else."""
    if hasattr(value, "write_csv"):
        return str(value.write_csv())
    if hasattr(value, "to_csv"):
        # An index with a name is a column.
        named = any(name is not None for name in value.index.names)
        return str(value.to_csv(index=named))
    return None


def changed(sections: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """`sections` with `changes`: sections are changed key by key; a list of sections is replaced,
    or changed crack by crack if the change is a dictionary; None removes a key."""
    result = dict(sections)
    for name, change in changes.items():
        old = result.get(name)
        if change is None:
            result.pop(name, None)
        elif isinstance(change, Mapping) and isinstance(old, list):
            result[name] = [_section(section, change) for section in old]
        elif isinstance(change, Mapping):
            result[name] = _section(old if isinstance(old, Mapping) else {}, change)
        else:
            result[name] = change
    return result


def _section(section: Mapping[str, Any], change: Mapping[str, Any]) -> dict[str, Any]:
    merged = {**section, **change}
    return {key: value for key, value in merged.items() if value is not None}


def _plain(value: Any) -> Any:
    """`value` in the types of TOML."""
    if hasattr(value, "tolist"):  # a NumPy number or array
        value = value.tolist()
    if isinstance(value, Mapping):
        return {str(key): _plain(inner) for key, inner in value.items() if inner is not None}
    if isinstance(value, (bool, int, float, str, datetime.date, datetime.time)):
        return value
    if isinstance(value, Sequence):
        return [_plain(inner) for inner in value]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"{value!r} is not valid in a case: must be a number, a text, true, false, a list or a section")
