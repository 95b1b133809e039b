"""Notebooks of the Python package with their outputs.

    notebooks.py OUT

Runs `python/notebooks/*.ipynb` with the installed package and writes them with their outputs into OUT, whose pages `build.py` makes with
`--notebooks OUT`. Needs nbclient, ipykernel, matplotlib and pandas.
"""

import html
import json
import re
import sys
import tempfile
from pathlib import Path

from markdown_it.token import Token

SOURCES = Path(__file__).resolve().parents[2] / "python/notebooks"


def shown(output):
    """An output of a cell as HTML; what it wrote to standard error, such as a progress bar, is left out."""
    if output["output_type"] == "stream":
        return f'<pre class="output">{html.escape("".join(output["text"]))}</pre>\n' if output["name"] == "stdout" else ""
    data = {kind: "".join(content) for kind, content in output["data"].items() if isinstance(content, (str, list))}
    if picture := data.get("image/png"):
        return f'<p class="output"><img src="data:image/png;base64,{"".join(picture.split())}" alt="Plot by the code above"></p>\n'
    if table := data.get("text/html"):
        # The style is that of the site.
        return f'<div class="output">{re.sub(r"<style.*?</style>|(?<=<table)[^>]*", "", table, flags=re.DOTALL)}</div>\n'
    return f'<pre class="output">{html.escape(data["text/plain"])}</pre>\n'


def tokens(path, markdown):
    """Tokens of the page of a notebook: text, code, outputs."""
    for cell in json.loads(path.read_text())["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            yield from markdown.parse(source)
        else:
            yield Token("fence", "code", 0, content=f"{source}\n", info="python")
            for output in cell["outputs"]:
                yield Token("html_block", "", 0, content=shown(output))


def main():
    import nbclient
    import nbformat

    out = Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    for path in sorted(SOURCES.glob("*.ipynb")):
        notebook = nbformat.read(path, as_version=4)
        with tempfile.TemporaryDirectory() as folder:
            nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
        nbformat.write(notebook, out / path.name)


if __name__ == "__main__":
    main()
