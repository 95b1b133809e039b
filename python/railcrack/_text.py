"""Texts for terminals: tables, and names that are meant."""

from __future__ import annotations

import difflib
import shutil
from collections.abc import Iterable, Mapping
from typing import Any

# Rows shown of a longer table: half of them at each end.
ROWS = 10


def unknown(name: object, known: Iterable[str], sentence: str) -> str:
    """`sentence` on the unknown `name`, with the nearest of the `known` names."""
    known = list(known)
    near = difflib.get_close_matches(str(name), known, n=1, cutoff=0.5)
    near = near or [other for other in known if str(name) in other][:1]
    return f"{sentence} {name}: did you mean {near[0]}?" if near else f"{sentence} {name}: there are {', '.join(known)}"


def table(name: str, rows: int, columns: Mapping[str, Any], units: Mapping[str, str]) -> str:
    """The first and the last rows of a table, with units, in blocks as wide as the terminal."""
    shown = list(range(rows)) if rows <= ROWS else [*range(ROWS // 2), *range(rows - ROWS // 2, rows)]
    gap = ROWS // 2 if rows > ROWS else None
    blocks: list[list[str]] = []
    width = shutil.get_terminal_size((120, 24)).columns
    for column in columns:
        cells = [number(columns[column][row]) for row in shown]
        if gap is not None:
            cells.insert(gap, "…")
        cells = [column, units.get(column, ""), *cells]
        wide = max(map(len, cells))
        cells = [f"{cell:>{wide}}" for cell in cells]
        if blocks and len(blocks[-1][0]) + 2 + wide <= width:
            blocks[-1] = [f"{line}  {cell}" for line, cell in zip(blocks[-1], cells, strict=True)]
        else:
            blocks.append(cells)
    text = "\n\n".join("\n".join(line.rstrip() for line in block) for block in blocks)
    return f"{name}: {rows} rows of {len(list(columns))} columns\n{text}"


def number(value: Any) -> str:
    """Six digits at most; empty for NaN."""
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    return "" if text == "nan" else text
