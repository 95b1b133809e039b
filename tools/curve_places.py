"""Three lateral places of a head check in a curve against the centred line contact.

python3 tools/curve_places.py [RAILCRACK] [FOLDER]

Runs cases/curve-500.toml with the crack at three lateral places, and the same crack under a centred
Hertz contact in full sliding of the mean wheels of the table (mix of the two axle loads, their mean
normal force, the head's radius of 80 mm and a concave wheel profile of 150 mm). Writes
docs/figures/curve-500.svg, depth over traffic, and prints the table of docs/dev/curve-500.md.
RAILCRACK is the program (railcrack), FOLDER takes the runs (target/curve-500).
"""

import csv
import json
import math
import pathlib
import subprocess
import sys

PLACES = [16.0, 20.0, 24.0]
# Shear over pressure: the mean of the wheels that meet the crack at 20 mm, and usual assumptions.
SHEARS = [-0.027, -0.1, -0.3]
DEPTHS = [2.0, 4.0]

LINE = """
title = "Centred line contact"

[[wheel]]
name = "22.5 t"
share = 0.583
axle_load_t = 22.5
contact = {{ kind = "hertz", wheel_load_kn = 122.2, wheel_radius_mm = 460.0, rail_head_radius_mm = 80.0, wheel_profile_radius_mm = -150.0, friction = {shear} }}

[[wheel]]
name = "17 t"
share = 0.417
axle_load_t = 17.0
contact = {{ kind = "hertz", wheel_load_kn = 91.2, wheel_radius_mm = 460.0, rail_head_radius_mm = 80.0, wheel_profile_radius_mm = -150.0, friction = {shear} }}

[passage]
from_over_a = -3.0
to_over_a = 3.0
positions = 61

[[crack]]
mouth_mm = 0.0
length_mm = 2.366
angle_deg = 25.0
friction = 0.3

[growth]
steps = 20
increment = 0.08
direction = "coplanar"

[solver]
engine = "dislocation"
"""

root = pathlib.Path(__file__).resolve().parent.parent


def course(folder):
    """Depth (mm) over traffic (MGT) of a run."""
    lines = [line for line in (folder / "growth.csv").open() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    return [(float(row["mgt"]), float(row["depth_mm"])) for row in rows]


def reached(points, depth):
    """Traffic at which a depth is reached; none if it is not."""
    for (m0, d0), (m1, d1) in zip(points, points[1:]):
        if d0 <= depth <= d1 and d1 > d0:
            return m0 + (m1 - m0) * (depth - d0) / (d1 - d0)
    return None


def svg(curves):
    """Depth over traffic, both on a logarithmic scale of traffic."""
    width, height, left, bottom, top = 760, 430, 60, 60, 20
    low, high = 0.01, 100.0
    deepest = 5.0

    def x(mgt):
        share = (math.log10(max(mgt, low)) - math.log10(low)) / (math.log10(high) - math.log10(low))
        return left + share * (width - left - 200)

    def y(depth):
        return height - bottom - depth / deepest * (height - bottom - top)

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" font-family="sans-serif" font-size="12" role="img" '
        f'aria-label="Depth over traffic at three lateral places and under centred line contacts">',
        f'<rect width="{width}" height="{height}" fill="#ffffff"/>',
    ]
    for power in range(-2, 3):
        at = x(10.0**power)
        parts.append(f'<line x1="{at:.1f}" y1="{y(0):.1f}" x2="{at:.1f}" y2="{top}" stroke="#dddddd"/>')
        parts.append(f'<text x="{at:.1f}" y="{y(0) + 16:.1f}" text-anchor="middle">{10.0**power:g}</text>')
    for depth in range(0, 6):
        parts.append(
            f'<line x1="{left}" y1="{y(depth):.1f}" x2="{x(high):.1f}" y2="{y(depth):.1f}" stroke="#dddddd"/>'
        )
        parts.append(f'<text x="{left - 8}" y="{y(depth) + 4:.1f}" text-anchor="end">{depth}</text>')
    parts.append(
        f'<text x="{0.5 * (left + x(high)):.1f}" y="{height - 18}" text-anchor="middle">traffic, million gross tonnes</text>'
    )
    middle = 0.5 * (y(0) + top)
    parts.append(
        f'<text x="18" y="{middle:.1f}" text-anchor="middle" transform="rotate(-90 18 {middle:.1f})">depth of the crack, mm</text>'
    )
    for i, (name, points, colour, dash) in enumerate(curves):
        shown = " ".join(f"{x(m):.1f},{y(d):.1f}" for m, d in points if m >= low)
        style = ' stroke-dasharray="6 4"' if dash else ""
        parts.append(f'<polyline points="{shown}" fill="none" stroke="{colour}" stroke-width="2"{style}/>')
        at = top + 14 + 20 * i
        parts.append(
            f'<line x1="{x(high) + 12:.1f}" y1="{at}" x2="{x(high) + 36:.1f}" y2="{at}" stroke="{colour}" stroke-width="2"{style}/>'
        )
        parts.append(f'<text x="{x(high) + 42:.1f}" y="{at + 4}">{name}</text>')
    parts.append("</svg>")
    return "\n".join(parts) + "\n"


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "railcrack"
    folder = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else root / "target/curve-500"
    folder.mkdir(parents=True, exist_ok=True)
    runs = []
    for place in PLACES:
        out = folder / f"place-{place:g}"
        command = [program, "run", str(root / "cases/curve-500.toml"), "--out", str(out), "--force", "--quiet"]
        subprocess.run([*command, "--set", f"crack.lateral_mm={place}"], check=True, stdout=subprocess.DEVNULL)
        runs.append((f"table, {place:g} mm", out))
    for shear in SHEARS:
        case = folder / f"line{shear:g}.toml"
        case.write_text(LINE.format(shear=shear))
        out = folder / f"line{shear:g}"
        command = [program, "run", str(case), "--out", str(out), "--force", "--quiet"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        runs.append((f"line contact, {shear:g}", out))
    colours = ["#1b6ca8", "#12406b", "#6fb1e0", "#b5541c", "#d98032", "#e8b27d"]
    curves = []
    print("| contact | rate at 1 mm depth, mm per MGT | MGT from 1 to 2 mm | MGT from 1 to 4 mm |")
    print("|---|---|---|---|")
    for (name, out), colour in zip(runs, colours):
        points = course(out)
        curves.append((name, points, colour, name.startswith("line")))
        rows = json.loads((out / "summary.json").read_text())["decision"]["rows"]
        ends = [reached(points, depth) for depth in DEPTHS]
        shown = ["" if end is None else f"{end:.2g}" for end in ends]
        print(f"| {name} | {rows[0]['depth_mm_per_mgt']:.2g} | {' | '.join(shown)} |")
    (root / "docs/figures/curve-500.svg").write_text(svg(curves))


if __name__ == "__main__":
    main()
