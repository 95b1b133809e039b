"""What notebooks show."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._table import Table

ROWS = 10


def table(content: Table) -> str:
    """The first and the last rows of a table, with units."""
    rows = content.rows
    shown = range(rows) if rows <= ROWS else [*range(ROWS // 2), *range(rows - ROWS // 2, rows)]
    head = "".join(f"<th title='{escape(content.meanings[c], quote=True)}'>{escape(c)}</th>" for c in content)
    body = ""
    for place, row in enumerate(shown):
        if rows > ROWS and place == ROWS // 2:
            body += f"<tr><td colspan='{len(content)}'>…</td></tr>"
        body += "<tr>" + "".join(f"<td>{_number(content[c][row])}</td>" for c in content) + "</tr>"
    return (
        f"<div><b>{escape(content.name)}</b>: {rows} rows<table><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table></div>"
    )


def facts(title: str, rows: list[tuple[str, Any]], below: str = "") -> str:
    """A title with a table of names and values, and more below."""
    lines = "".join(
        f"<tr><th style='text-align:left'>{escape(name)}</th><td style='text-align:left'>{escape(str(value))}</td></tr>"
        for name, value in rows
    )
    return f"<div><b>{escape(title)}</b><table>{lines}</table>{below}</div>"


def _number(value: Any) -> str:
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    return escape("" if text == "nan" else text)
