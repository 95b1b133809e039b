"""Classes of the sections of a case for the Python package, from the JSON Schema of the case file.

    python_sections.py [--schema FILE] [--check]

Writes `python/railcrack/_sections.py`: for each section a class with the keys as attributes, their units, usual and accepted ranges,
defaults and words, and a TypedDict of the same keys for dictionaries. The schema is that of the installed package (`railcrack schema`),
and comes from the tables of keys by which cases are read. With --check nothing is written; ends with 1 where the file is out of date.
"""

import argparse
import json
import keyword
import subprocess
import sys
import textwrap
from pathlib import Path

TARGET = Path(__file__).resolve().parents[1] / "python/railcrack/_sections.py"
# Classes whose names are not those of their sections: results have those.
NAMES = {"passage": "PassageSettings", "shakedown": "ShakedownSettings"}
# The kinds of contact have classes of their own, with the keys that mean something with them.
KINDS = {"hertz": "Hertz", "carter": "Carter", "table": "ContactTable", "rolling": "Rolling"}
# Attributes that may be given by position.
BY_POSITION = {"Hertz": ["peak_pressure_mpa", "half_width_mm", "friction"]}
# Sections that are written several times, with the names of their lists.
LISTS = {"crack": "cracks", "wheel": "wheels"}

HEAD = '''\
"""The sections of a case as classes and as dictionaries: units, ranges and words are those of the
reader of case files. Written by `tools/python_sections.py`."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any, ClassVar, Literal, Protocol, TypedDict

import numpy as np

from ._section import Section

Number = float | np.floating[Any] | np.integer[Any]
Count = int | np.integer[Any]
Numbers = Sequence[Number] | np.ndarray[Any, np.dtype[Any]]


class PandasFrame(Protocol):
    """A pandas table in the position of a file."""

    def to_csv(self) -> str: ...


class PolarsFrame(Protocol):
    """A polars table in the position of a file."""

    def write_csv(self) -> str: ...


File = str | os.PathLike[str] | PandasFrame | PolarsFrame
'''


def short(number):
    size = abs(number)
    if size and not 1e-3 <= size < 1e5:
        mantissa, exponent = f"{number:e}".split("e")
        return f"{float(mantissa):g}e{int(exponent)}"
    return f"{number:g}"


def class_name(section):
    return NAMES.get(section, "".join(part.capitalize() for part in section.split("_")))


def type_of(key, schema):
    """The type of the values of a key."""
    if "enum" in schema:
        return f"Literal[{', '.join(literal(word) for word in schema['enum'])}]"
    if "anyOf" in schema:
        return " | ".join(type_of(key, part) for part in schema["anyOf"])
    if "const" in schema:
        return f"Literal[{literal(schema['const'])}]"
    kind = schema["type"]
    if kind == "array":
        inner = schema["items"]
        if inner["type"] == "array":
            return "Sequence[Sequence[str]]" if inner["items"]["type"] == "string" else "Sequence[Numbers] | Numbers"
        return "Numbers"
    if kind == "object":
        return given(key)
    if kind == "string":
        return "File" if "minLength" in schema else "str"
    return {"number": "Number", "integer": "Count", "boolean": "bool"}[kind]


def literal(word):
    return str(word) if isinstance(word, bool) else json.dumps(word)


def given(section):
    """The type of a section: its class or its dictionary."""
    name = class_name(section)
    classes = [name, *KINDS.values()] if section == "contact" else [name]
    return " | ".join([*classes, f"{name}Keys"])


def bounds(schema):
    """Accepted numbers in words."""
    low, above = schema.get("minimum"), schema.get("exclusiveMinimum")
    high, below = schema.get("maximum"), schema.get("exclusiveMaximum")
    words = []
    if low is not None and high is not None:
        return f"{short(low)} to {short(high)}"
    if low is not None or above is not None:
        words.append(f"from {short(low)}" if low is not None else f"above {short(above)}")
    if high is not None or below is not None:
        words.append(f"to {short(high)}" if high is not None else f"below {short(below)}")
    return " ".join(words)


def docstring(schema):
    """Meaning, unit, ranges, default, words."""
    numbers = schema
    if "anyOf" in schema:
        numbers = next((part for part in schema["anyOf"] if part.get("type") in ("number", "integer")), schema)
    if schema.get("type") == "array":
        numbers = schema["items"]
    unit = schema.get("x-unit", "")
    facts = []
    if unit:
        facts.append(f"In {unit}")
    if usual := schema.get("x-usual"):
        facts.append(f"usual: {short(usual[0])} to {short(usual[1])}")
    if accepted := bounds(numbers):
        facts.append(f"accepted: {accepted}")
    if "default" in schema:
        facts.append(f"default: {literal(schema['default'])}")
    if only := schema.get("x-only-with"):
        facts.append(f"only with {only}")
    text = schema["description"]
    if facts:
        line = "; ".join(facts)
        text += f" {line[0].upper()}{line[1:]}."
    if "enum" in schema and (meanings := schema.get("enumDescriptions")):
        words = [f"{literal(word)}: {meaning}" for word, meaning in zip(schema["enum"], meanings, strict=True)]
        text += " " + "; ".join(words) + "."
    return text


def quoted(text, indent):
    """`text` as a docstring."""
    pad = " " * indent
    text = text.replace("\\", "\\\\")
    lines = textwrap.wrap(text, 100 - indent, initial_indent='"""', break_long_words=False, break_on_hyphens=False)
    if len(lines) == 1 and len(lines[0]) + indent + 3 <= 100 and not lines[0].endswith('"'):
        return f'{pad}{lines[0]}"""\n'
    end = f' """' if lines[-1].endswith('"') else '"""'
    return "".join(f"{pad}{line}\n" for line in lines[:-1]) + f"{pad}{lines[-1]}{end}\n"


def is_of(kind, schema):
    """Whether a key of [contact] means something with this kind."""
    only = schema.get("x-only-with", "")
    return not only.startswith("kind = ") or f'"{kind}"' in only


def attributes(schema):
    """The keys that may be names in Python: others, such as `from`, are left to case files."""
    return {key: of for key, of in schema["properties"].items() if not keyword.iskeyword(key)}


def section_class(name, section, schema, fixed=None):
    keys = attributes(schema)
    if fixed:
        keys = {key: of for key, of in keys.items() if key != "kind" and is_of(fixed, of)}
    positional = BY_POSITION.get(name, [])
    required = set(schema.get("required", []))
    doc = schema["description"]
    if fixed:
        kind = schema["properties"]["kind"]
        doc = f"{doc} {dict(zip(kind['enum'], kind['enumDescriptions'], strict=True))[fixed].capitalize()}."
    text = f"\n\n@dataclass(frozen=True, repr=False{'' if positional else ', kw_only=True'})\nclass {name}(Section):\n{quoted(doc, 4)}\n"
    text += f"    _section: ClassVar[str] = {json.dumps(section)}\n"
    if fixed:
        text += f'    _fixed: ClassVar[dict[str, str]] = {{"kind": {json.dumps(fixed)}}}\n'
    order = [*positional, *(key for key in keys if key not in positional)]
    for key in order:
        if positional and key == order[len(positional)]:
            text += "    _: KW_ONLY\n"
        of = keys[key]
        kind = type_of(key, of)
        if key in required:
            text += f"    {key}: {kind}\n"
        else:
            text += f"    {key}: {kind} | None = None\n"
        if of.get("x-only-with", "").startswith("kind = ") and fixed:
            of = {name: value for name, value in of.items() if name != "x-only-with"}
        text += quoted(docstring(of), 4)
    return text


def section_keys(section, schema):
    text = f"\n\nclass {class_name(section)}Keys(TypedDict, total=False):\n"
    text += quoted(f"Keys of `{section}`, those of `{class_name(section)}`.", 4) + "\n"
    for key, of in attributes(schema).items():
        text += f"    {key}: {type_of(key, of)} | None\n"
    return text


def sections_of(schema):
    """Every section with the schema of one table."""
    return {
        name: of.get("items", of) for name, of in schema["properties"].items() if of["type"] in ("object", "array")
    }


def generated(schema):
    sections = sections_of(schema)
    text = HEAD
    for section, of in sections.items():
        text += section_class(class_name(section), section, of)
        if section == "contact":
            for kind, name in KINDS.items():
                text += section_class(name, section, of, kind)
        text += section_keys(section, of)
    for name, doc, none in [
        ("Sections", "The sections of a case.", ""),
        ("Changes", "Changes of a case: None removes a key or a section.", " | None"),
    ]:
        text += f"\n\nclass {name}(TypedDict, total=False):\n{quoted(doc, 4)}\n    title: str{none}\n"
        for section in sections:
            if section in LISTS:
                several = f"Sequence[{given(section)}]"
                one = f"{class_name(section)}Keys | " if none else ""
                text += f"    {section}: {one}{several}{none}\n    {LISTS[section]}: {one}{several}{none}\n"
            else:
                text += f"    {section}: {given(section)}{none}\n"
    names = [class_name(section) for section in sections] + list(KINDS.values())
    text += "\n\n__all__ = [\n" + "".join(f'    "{name}",\n' for name in sorted(names)) + "]\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--schema", type=Path, help="a schema in a file")
    parser.add_argument("--check", action="store_true", help="write nothing")
    arguments = parser.parse_args()
    if arguments.schema:
        schema = arguments.schema.read_text()
    else:
        program = "from railcrack._command import main; main()"
        schema = subprocess.run([sys.executable, "-c", program, "schema"], check=True, capture_output=True, text=True).stdout
    text = generated(json.loads(schema))
    if arguments.check:
        if TARGET.read_text() != text:
            print(f"{TARGET} is out of date: tools/python_sections.py writes it", file=sys.stderr)
            return 1
        return 0
    TARGET.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
