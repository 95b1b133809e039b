"""HTML for notebooks."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Any

from ._text import ROWS, number


def table(name: str, rows: int, columns: Mapping[str, Any], meanings: Mapping[str, str]) -> str:
    """The first and the last `rows` of a table, with the meaning of each column."""
    shown = range(rows) if rows <= ROWS else [*range(ROWS // 2), *range(rows - ROWS // 2, rows)]
    head = "".join(f"<th title='{escape(meanings[c], quote=True)}'>{escape(c)}</th>" for c in columns)
    body = ""
    for place, row in enumerate(shown):
        if rows > ROWS and place == ROWS // 2:
            body += f"<tr><td colspan='{len(list(columns))}'>…</td></tr>"
        body += "<tr>" + "".join(f"<td>{_number(columns[c][row])}</td>" for c in columns) + "</tr>"
    return (
        f"<div><b>{escape(name)}</b>: {rows} rows<table><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table></div>"
    )


def facts(title: str, rows: list[tuple[str, Any]], below: str = "") -> str:
    """A title, a table of names and values, and further content below."""
    lines = "".join(
        f"<tr><th style='text-align:left'>{escape(name)}</th><td style='text-align:left'>{escape(str(value))}</td></tr>"
        for name, value in rows
    )
    return f"<div><b>{escape(title)}</b><table>{lines}</table>{below}</div>"


def _number(value: Any) -> str:
    return escape(number(value))
