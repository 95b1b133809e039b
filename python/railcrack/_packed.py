"""Folders of results as bytes, for pickles."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path


def packed(folder: Path) -> bytes:
    """The files of `folder`, without plots and reports."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for file in sorted(folder.rglob("*")):
            inner = file.relative_to(folder)
            if file.is_file() and file.name != "report.html" and "plots" not in inner.parts:
                archive.write(file, inner)
    return content.getvalue()


def unpack(content: bytes, folder: Path) -> None:
    """Writes the files to `folder`."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        archive.extractall(folder)
