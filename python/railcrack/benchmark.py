"""Scorer of the benchmark of rolling-contact-fatigue cracks.

    python -m railcrack.benchmark score RESULT.csv

compares the results of any program with the solution of a problem in the folder `benchmark`. It
needs neither numpy nor the engines: the same file is the package `railcrack_benchmark`, which
`pip install ./benchmark/scorer` installs, and it runs as a script. `benchmark/README.md` has the
format of a result.
"""

from __future__ import annotations

import argparse
import csv
import math
import sys
from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Union

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

__all__ = ["BenchmarkError", "Problem", "Row", "figure", "problems", "read_result", "score", "table"]

STRESS_INTENSITY = ("ki_mpa_sqrt_m", "kii_mpa_sqrt_m", "kiii_mpa_sqrt_m")
"""Columns that share one peak, because K_I of 0.1 beside K_II of 20 MPa√m is no large part of anything."""
RELEASE = "g_n_per_mm"
"""Energy release rate, derived from the columns of K where a result has all of those of the solution."""

Key = tuple[str, ...]
Curve = list[tuple[float, float]]
Curves = dict[tuple[Key, str], Curve]


class BenchmarkError(ValueError):
    """A result, or a folder of the benchmark, that cannot be read."""


@dataclass(frozen=True)
class Problem:
    """A problem of the benchmark: `problem.toml` and `solution.csv` of its folder."""

    name: str
    """Name of the folder: number and words."""
    folder: Path
    """The folder."""
    data: dict[str, Any]
    """Contents of `problem.toml`."""
    solution: Curves = field(repr=False)
    """Curves of the solution by key and column: lists of (position, value)."""

    @property
    def groups(self) -> list[str]:
        """Columns that say to which curve a row belongs."""
        return list(self.data["output"]["groups"])

    @property
    def along(self) -> str:
        """Column along which the values of a curve are given."""
        return str(self.data["output"]["along"])

    @property
    def values(self) -> list[str]:
        """Columns that are compared."""
        return list(self.data["output"]["values"])

    @property
    def shift(self) -> float:
        """Shift along a curve that is allowed where the fall of a curve is compared by its place."""
        return float(self.data["output"].get("shift", 0.0))

    def part(self, name: str) -> dict[str, Any]:
        """A part of the problem, with what all parts have in common."""
        for part in self.data["part"]:
            if part["name"] == name:
                return {**self.data.get("common", {}), **part}
        raise BenchmarkError(f"{self.name} has no part {name!r}: {', '.join(p['name'] for p in self.data['part'])}")

    def error_bar(self, key: Key, column: str) -> float:
        """Error bar of a column of the solution, in the unit of the column."""
        errors = self.part(key[0]).get("error", {})
        if column == RELEASE:
            return math.nan
        return float(errors.get(column, math.nan))


@dataclass(frozen=True)
class Row:
    """Differences of one column of one curve from the solution, in per cent of its peak."""

    key: Key
    """Values of the columns that name the curve: part, and crack or front point."""
    column: str
    """The column, or `g_n_per_mm`."""
    peak: float
    """Largest absolute value of the solution; of all columns of K for one of them."""
    by_position: float
    """Largest difference over the positions."""
    at: float
    """Position of that difference."""
    shifted: float
    """The same, where the result may be shifted along the curve at each position."""
    of_peak: float
    """Difference of the largest absolute values of this column, with its sign."""
    error_bar: float
    """Error bar of the solution; NaN where none is stated."""
    positions: int
    """Positions of the solution that are compared."""
    missing: int
    """Positions of the solution that the result does not reach."""


def find_folder(near: Sequence[Path] = ()) -> Path:
    """The folder of the benchmark: that of the package, or one above the given places."""
    here = Path(__file__).resolve()
    for place in [*(Path(p).resolve() for p in near), Path.cwd(), here]:
        for above in [place, *place.parents]:
            for folder in (above, above / "benchmark", above / "data"):
                if (folder / "VERSION").is_file() and any(folder.glob("01-*/problem.toml")):
                    return folder
    raise BenchmarkError("the folder of the benchmark is not found: name it by --benchmark FOLDER")


def problems(folder: Path) -> list[str]:
    """Names of the problems in the folder of the benchmark."""
    return sorted(path.parent.name for path in folder.glob("[0-9][0-9]-*/problem.toml"))


def problem(folder: Path, name: str) -> Problem:
    """The problem of that name or number."""
    number = name.zfill(2) if name.isdigit() else name
    found = [n for n in problems(folder) if n == number or n.split("-")[0] == number]
    if len(found) != 1:
        raise BenchmarkError(f"no problem {name!r} in {folder}: {', '.join(problems(folder))}")
    place = folder / found[0]
    with open(place / "problem.toml", "rb") as file:
        data = tomllib.load(file)
    output = data["output"]
    rows = read_rows(place / "solution.csv")[1]
    solution = curves(rows, output["groups"], output["along"], output["values"], place / "solution.csv")
    return Problem(found[0], place, data, solution)


def read_rows(path: Path) -> tuple[dict[str, str], list[dict[str, str]]]:
    """Remarks (`# name: value`) and rows of a table."""
    remarks: dict[str, str] = {}
    lines: list[str] = []
    with open(path, encoding="utf-8-sig", newline="") as file:
        for line in file:
            if line.startswith("#"):
                name, colon, value = line[1:].partition(":")
                if colon:
                    remarks[name.strip()] = value.strip()
            elif line.strip():
                lines.append(line)
    reader = csv.DictReader(lines, skipinitialspace=True)
    return remarks, list(reader)


def curves(
    rows: list[dict[str, str]], groups: list[str], along: str, values: list[str], path: Path, only: Key | None = None
) -> Curves:
    """Curves of the rows, sorted along `along`; empty fields are left out."""
    if not rows:
        raise BenchmarkError(f"{path} has no rows")
    present = [value for value in values if value in rows[0]]
    if not present:
        raise BenchmarkError(f"{path} has none of the columns {', '.join(values)}")
    result: Curves = {}
    for number, row in enumerate(rows, start=1):
        key = tuple(row[group].strip() if group in row else (only or ())[i] for i, group in enumerate(groups))
        try:
            place = float(row[along]) if along else 0.0
            for value in present:
                if row[value] not in ("", None):
                    result.setdefault((key, value), []).append((place, float(row[value])))
        except (KeyError, TypeError, ValueError) as fault:
            raise BenchmarkError(f"{path}, row {number}: {fault!r} in the column {along!r} or a value") from None
    for curve in result.values():
        curve.sort(key=lambda point: point[0])
    return result


def read_result(path: Union[str, Path], folder: Path, name: str | None = None) -> tuple[Problem, Curves]:
    """The problem that a result belongs to, by `name` or its line `# problem: 03`, and its curves."""
    path = Path(path)
    remarks, rows = read_rows(path)
    chosen = name or remarks.get("problem")
    if chosen is None:
        raise BenchmarkError(f"{path} does not say its problem: add the line `# problem: 03`, or --problem 03")
    the = problem(folder, chosen)
    names = [part["name"] for part in the.data["part"]]
    # A result of one part, or of one crack, need not repeat its name in every row.
    only = (remarks.get("part", names[0]), *("1" for _ in the.groups[1:]))
    if rows and "part" not in rows[0] and "part" not in remarks and len(names) > 1:
        raise BenchmarkError(f"{path} needs a column `part`, or the line `# part: NAME`: {', '.join(names)}")
    found = curves(rows, the.groups, the.along, the.values, path, only)
    unknown = {key for key, _ in found} - {key for key, _ in the.solution}
    if unknown:
        known = sorted({key for key, _ in the.solution})
        raise BenchmarkError(f"{path}: {sorted(unknown)[0]} is none of the curves of {the.name}: {known}")
    return the, found


def at(curve: Curve, place: float) -> float:
    """The value at a place, linear between points; NaN outside of the curve, but for round-off."""
    slack = 1e-6 * (1.0 + abs(place))
    if not curve[0][0] - slack <= place <= curve[-1][0] + slack:
        return math.nan
    i = min(max(bisect_left(curve, (place, -math.inf)), 1), len(curve) - 1)
    if len(curve) == 1:
        return curve[0][1]
    (x0, y0), (x1, y1) = curve[i - 1], curve[i]
    share = 0.0 if x1 == x0 else min(max((place - x0) / (x1 - x0), 0.0), 1.0)
    return y0 + share * (y1 - y0)


def nearest(curve: Curve, place: float, value: float, shift: float) -> float:
    """Smallest distance of `value` from the values of the curve within `shift` of the place."""
    ends = [at(curve, place - shift), at(curve, place), at(curve, place + shift)]
    inner = curve[bisect_left(curve, (place - shift, -math.inf)) : bisect_left(curve, (place + shift, math.inf))]
    met = [v for v in [*ends, *(y for _, y in inner)] if not math.isnan(v)]
    if not met:
        return math.nan
    low, high = min(met), max(met)
    return max(low - value, value - high, 0.0)


def with_release(found: Curves, elasticity: dict[str, Any], needed: Sequence[str]) -> Curves:
    """The curves with that of G = (1 − ν²)/E (K_I² + K_II²) + (1 + ν)/E K_III², N/mm."""
    e, nu = float(elasticity["young_modulus_mpa"]), float(elasticity["poisson_ratio"])
    factors = {"ki_mpa_sqrt_m": 1 - nu * nu, "kii_mpa_sqrt_m": 1 - nu * nu, "kiii_mpa_sqrt_m": 1 + nu}
    result = dict(found)
    for key in {key for key, _ in found}:
        columns = [found.get((key, name)) for name in needed]
        if any(column is None for column in columns):
            continue
        sums: Curve = []
        for i, (place, _) in enumerate(columns[0] or []):
            k = [(name, column[i][1]) for name, column in zip(needed, columns) if column and i < len(column)]
            sums.append((place, sum(1000.0 * factors[name] * value * value / e for name, value in k)))
        result[key, RELEASE] = sums
    return result


def score(the: Problem, found: Curves) -> list[Row]:
    """Differences of a result from the solution, curve by curve."""
    needed = [name for name in STRESS_INTENSITY if name in the.values]
    elasticity = the.data.get("elasticity")
    solution, result = the.solution, found
    if len(needed) > 1 and elasticity:
        solution = with_release(solution, elasticity, needed)
        result = with_release(result, elasticity, needed)
    rows = []
    for key, column in sorted(solution, key=lambda k: (list_index(the, k[0]), k[0])):
        if (key, column) not in result:
            continue
        want, have = solution[key, column], result[key, column]
        alike = STRESS_INTENSITY if column in STRESS_INTENSITY else (column,)
        peak = max(abs(v) for name in alike for _, v in solution.get((key, name), []))
        scale = 100.0 / peak if peak > 0.0 else math.nan
        differences = [(abs(at(have, x) - y), x) for x, y in want]
        met = [(d, x) for d, x in differences if not math.isnan(d)]
        if not met:
            raise BenchmarkError(f"{the.name} {' '.join(key)}: the result has no position of the solution")
        worst, place = max(met)
        shifted = max(nearest(have, x, y, the.shift) for x, y in want if not math.isnan(at(have, x)))
        reached = [x for _, x in met]
        own = max(abs(y) for x, y in want if x in set(reached))
        theirs = max(abs(y) for x, y in have if min(reached) <= x <= max(reached) or len(have) == 1)
        rows.append(
            Row(
                key,
                column,
                peak,
                worst * scale,
                place,
                shifted * scale,
                (theirs - own) * scale,
                the.error_bar(key, column) * scale,
                len(met),
                len(want) - len(met),
            )
        )
    return rows


def list_index(the: Problem, key: Key) -> int:
    """Place of the part of a key among the parts of the problem."""
    return [part["name"] for part in the.data["part"]].index(key[0])


def table(the: Problem, rows: list[Row]) -> str:
    """The rows as text."""
    head = ["curve", "column", "peak", "position %", f"at {the.along}", "shifted %", "peak %", "error bar %"]
    lines = [head]
    for row in rows:
        number = ["-" if math.isnan(v) else f"{v:.3f}" for v in (row.by_position, row.shifted, row.error_bar)]
        lines.append(
            [
                " ".join(row.key),
                row.column,
                f"{row.peak:.5g}",
                number[0],
                f"{row.at:g}",
                number[1],
                f"{row.of_peak:+.3f}",
                number[2] + (f" ({row.missing} positions missing)" if row.missing else ""),
            ]
        )
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    text = ["  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines]
    judged = [row for row in rows if row.column != RELEASE]
    worst = max(judged, key=lambda row: row.by_position)
    missing = sorted({k[0] for k, _ in the.solution} - {row.key[0] for row in rows})
    return "\n".join(
        [
            f"{the.name}: {the.data['title']}",
            *text,
            f"largest difference: {worst.by_position:.3f} % of the peak ({' '.join(worst.key)}, {worst.column})",
            *([f"parts without a result: {', '.join(missing)}"] if missing else []),
        ]
    )


def write_csv(path: Path, the: Problem, rows: list[Row]) -> None:
    """The rows as a table of their own, in per cent of the peak."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(
            ["problem", "curve", "column", "peak", "by_position_pct", "at", "shifted_pct", "of_peak_pct", "error_bar_pct"]
        )
        for r in rows:
            numbers = [r.peak, r.by_position, r.at, r.shifted, r.of_peak, r.error_bar]
            out.writerow([the.name, " ".join(r.key), r.column, *(f"{v:.6g}" for v in numbers)])


PANEL = (330, 190)
COLOURS = ("#1b6ca8", "#c8432f", "#3a7d44")


def figure(the: Problem, found: Curves) -> str:
    """Solution (lines) and result (dots) of every curve as SVG: a row for each curve of the result."""
    keys = sorted({key for key, _ in found}, key=lambda key: (list_index(the, key), key))
    sets = [[c for c in STRESS_INTENSITY if c in the.values]]
    sets += [[c] for c in the.values if c not in STRESS_INTENSITY]
    sets = [columns for columns in sets if columns]
    width, height = PANEL
    parts = []
    for i, key in enumerate(keys):
        for j, columns in enumerate(sets):
            parts.append(
                f'<g transform="translate({j * width},{24 + i * height})">{panel(the, found, key, columns)}</g>'
            )
    w, h = width * len(sets), 24 + height * len(keys)
    title = escaped(f"{the.name}: {the.data['title']} (lines: solution; dots: result)")
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" '
        f'font-family="sans-serif" font-size="10"><rect width="{w}" height="{h}" fill="white"/>'
        f'<text x="8" y="16" font-size="12">{title}</text>{"".join(parts)}</svg>\n'
    )


def panel(the: Problem, found: Curves, key: Key, columns: list[str]) -> str:
    """Axes and curves of one group of columns."""
    shown = [c for c in columns if (key, c) in the.solution]
    points = [p for c in shown for source in (the.solution, found) for p in source.get((key, c), [])]
    if not points:
        return ""
    x0, x1 = min(x for x, _ in points), max(x for x, _ in points)
    y0, y1 = min(y for _, y in points), max(y for _, y in points)
    dx, dy = (x1 - x0) or 1.0, (y1 - y0) or 1.0
    left, right, top, bottom = 48, PANEL[0] - 12, 22, PANEL[1] - 28

    def place(x: float, y: float) -> tuple[float, float]:
        return left + (right - left) * (x - x0) / dx, bottom - (bottom - top) * (y - y0) / dy

    parts = [f'<path d="M{left},{top}V{bottom}H{right}" fill="none" stroke="#555"/>']
    if y0 < 0.0 < y1:
        parts.append(f'<path d="M{left},{place(x0, 0.0)[1]:.1f}H{right}" stroke="#ccc"/>')
    for value, edge in ((y0, bottom), (y1, top + 4)):
        parts.append(f'<text x="{left - 4}" y="{edge}" text-anchor="end">{value:.4g}</text>')
    for value, anchor, edge in ((x0, "start", left), (x1, "end", right)):
        parts.append(f'<text x="{edge}" y="{bottom + 12}" text-anchor="{anchor}">{value:.4g}</text>')
    parts.append(f'<text x="{(left + right) // 2}" y="{bottom + 22}" text-anchor="middle">{escaped(the.along)}</text>')
    parts.append(f'<text x="{left}" y="12" font-weight="bold">{escaped(" ".join(key))}</text>')
    for i, column in enumerate(shown):
        colour = COLOURS[i % len(COLOURS)]
        line = " ".join("{:.1f},{:.1f}".format(*place(x, y)) for x, y in the.solution[key, column])
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}"/>')
        have = found.get((key, column), [])
        for x, y in have[:: max(1, len(have) // 80)]:
            cx, cy = place(x, y)
            parts.append(f'<circle cx="{cx:.1f}" cy="{cy:.1f}" r="1.6" fill="{colour}"/>')
        parts.append(f'<text x="{right - 75 * (len(shown) - i - 1)}" y="12" text-anchor="end" fill="{colour}">{column}</text>')
    return "".join(parts)


def escaped(text: str) -> str:
    """Text for SVG."""
    return text.replace("&", "&amp;").replace("<", "&lt;")


def main(arguments: Sequence[str] | None = None) -> int:
    """The command: 0 where a result was compared, 2 for one that cannot be read."""
    parser = argparse.ArgumentParser(prog="railcrack.benchmark", description="Benchmark of rolling-contact-fatigue cracks")
    commands = parser.add_subparsers(dest="command", required=True)
    scored = commands.add_parser("score", help="compare a result with the solution of its problem")
    scored.add_argument("result", type=Path, help="CSV file with the columns of the solution")
    scored.add_argument("--problem", help="number or name of the problem, if the file does not say it")
    scored.add_argument("--figure", type=Path, help="SVG file to write (default: the result with the ending .svg)")
    scored.add_argument("--table", type=Path, help="CSV file of the differences to write")
    listed = commands.add_parser("list", help="names of the problems")
    for command in (scored, listed):
        command.add_argument("--benchmark", type=Path, help="folder of the benchmark (default: found near by)")
    options = parser.parse_args(arguments)
    try:
        near = [options.result] if options.command == "score" else []
        folder = options.benchmark or find_folder(near)
        if options.command == "list":
            for name in problems(folder):
                print(f"{name}: {problem(folder, name).data['title']}")
            return 0
        the, found = read_result(options.result, folder, options.problem)
        rows = score(the, found)
        print(table(the, rows))
        drawn = options.figure or options.result.with_suffix(".svg")
        drawn.write_text(figure(the, found), encoding="utf-8")
        print(f"figure: {drawn}")
        if options.table:
            write_csv(options.table, the, rows)
    except (BenchmarkError, OSError) as fault:
        print(f"error: {fault}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
