"""Pages of the Python package from its docstrings and types, by pdoc.

    python_pages.py OUT

The package must be importable. Docstrings are those of the sources, where a line `name: text` describes an argument; such lines
become a list. Ends with 1 where a public name has no docstring.
"""

import re
import sys
import warnings
from pathlib import Path

import pdoc.doc
import pdoc.render
from jinja2 import pass_context
from pdoc.render_helpers import to_markdown_with_context
from railcrack._section import Explained

PACKAGE = "railcrack"
HERE = Path(__file__).resolve().parent
ARGUMENT = re.compile(r"^(\w+(?:, \w+)*): (.*)$")


def arguments_as_list(text):
    """Lines `name: text`, and the indented ones below them, as items of a list; examples as they are."""
    lines, in_list, in_code = [], False, False
    for line in text.splitlines():
        # An example by prompts ends with an empty line.
        if line.lstrip().startswith(">>>") and not in_code:
            lines += ["```python"]
            in_code = True
        elif in_code and not line.strip():
            lines += ["```"]
            in_code = False
        found = None if in_code else ARGUMENT.match(line)
        if found:
            if not in_list and lines and lines[-1].strip():
                lines.append("")
            lines.append(f"* `{found.group(1)}`: {found.group(2)}")
            in_list = True
        elif in_list and line.startswith(" "):
            lines.append(f"  {line.strip()}")
        else:
            if in_list and line.strip():
                lines.append("")
            in_list = False
            lines.append(line)
    return "\n".join([*lines, "```"] if in_code else lines)


@pass_context
def to_markdown(context, docstring):
    return to_markdown_with_context(context, arguments_as_list(docstring))


def with_inherited(module):
    """The module, whose classes also show what they have from classes in private modules, which have no page."""
    for member in module.members.values():
        if member.kind == "class":
            # The attributes have the rest.
            if isinstance(explained := vars(member.obj).get("__doc__"), Explained):
                member.docstring = explained.summary
            for (origin, _), inherited in member.inherited_members.items():
                if origin.startswith(f"{PACKAGE}._"):
                    member.own_members.extend(inner for inner in inherited if not inner.name.startswith("_"))
    return module


def undocumented(module):
    """Public classes and functions of a module, and those within its classes, without a docstring."""
    for member in module.members.values():
        # A variable has its docstring where it stands, which is another module.
        if member.name.startswith("_") or member.kind in ("module", "variable"):
            continue
        if not member.docstring:
            yield member.fullname
        if member.kind == "class":
            own = [inner for inner in member.own_members if not inner.name.startswith("_") and inner.kind != "variable"]
            yield from (inner.fullname for inner in own if not inner.docstring)


def main():
    out = Path(sys.argv[1])
    # Types of libraries that need not be installed stay words.
    warnings.filterwarnings("ignore", module="pdoc")
    pdoc.render.configure(docformat="markdown", show_source=False, template_directory=HERE / "pdoc")
    pdoc.render.env.filters["to_markdown"] = to_markdown
    modules = {name: with_inherited(pdoc.doc.Module.from_name(name)) for name in [PACKAGE, f"{PACKAGE}.errors"]}
    for name, module in modules.items():
        page = out / f"{name.replace('.', '/')}.html"
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(pdoc.render.html_module(module, modules))
    (out / "search.js").write_text(pdoc.render.search_index(modules))
    missing = [name for module in modules.values() for name in undocumented(module)]
    for name in missing:
        print(f"{name} has no docstring", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
