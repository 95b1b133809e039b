"""Lives of a decision over one input at a time: where more load, cold or friction lengthens them.

python3 tools/monotone_scans.py RAILCRACK computes verification/monotone/lives.csv with that program;
without arguments it prints the numbers of docs/dev/monotone.md.
"""

import csv
import pathlib
import sys

from head_check import root, summary

table = root / "verification/monotone/lives.csv"

CASE = """
[contact]
wheel_load_kn = 98.1
wheel_radius_mm = 460.0
wheel_profile_radius_mm = -450.0
rail_head_radius_mm = 300.0
friction = 0.2
[track]
section = "60E1"
[temperature]
rail_c = -7.0
neutral_c = 23.0
[[crack]]
mouth_mm = 0.0
length_mm = 4.732
surface_half_length_mm = 9.464
angle_deg = 25.0
friction = 0.4
[growth]
steps = 80
[inspection]
detectable_depth_mm = 1.0
critical_depth_mm = 6.0
[traffic]
axle_load_t = 20.0
[solver]
engine = "dislocation"
[output]
plots = false
report = false
faces = "none"
sif = "none"
"""


def axle_load(tonnes):
    return {"traffic.axle_load_t": tonnes, "contact.wheel_load_kn": round(0.5 * 9.81 * tonnes, 3)}


def length(mm):
    return {"crack[1].length_mm": mm, "crack[1].surface_half_length_mm": 2.0 * mm}


# Quantity, its values with their settings, and whether the life should fall (-1) or rise (1) with it.
SCANS = {
    "axle load, t": (-1, {t: axle_load(float(t)) for t in [14, 16, 18, 20, 22, 24, 26, 28]}),
    "below neutral temperature, K": (-1, {k: {"temperature.neutral_c": k - 7.0} for k in [0, 10, 20, 30, 40, 50]}),
    "length at the start, mm": (-1, {mm: length(mm) for mm in [3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 7.0]}),
    "friction between the faces": (1, {mu: {"crack[1].friction": mu} for mu in [0.1, 0.2, 0.3, 0.35, 0.4, 0.45, 0.5]}),
    "friction under the wheel": (0, {mu: {"contact.friction": mu} for mu in [0.05, 0.1, 0.15, 0.2, 0.25, 0.3]}),
    "coefficient C, times": (-1, {f: {"growth.paris_c": 2e-9 * f} for f in [0.5, 1.0, 2.0]}),
}


def lives(program, settings):
    """Lives (MGT) straight ahead, as computed and along the limit path, the shortest of all, the interval, the verdict."""
    decision = summary(program, CASE, [f"{key}={value}" for key, value in settings.items()])["decision"]
    paths = decision.get("paths") or {}
    values = [paths.get(name) for name in ["straight", "nominal", "limit"]]
    known = [life for life in values if life is not None]
    shortest = min(known) if known else None
    inspection = decision.get("inspection") or {}
    cells = [*values, shortest, inspection.get("interval_mgt")]
    return ["" if value is None else f"{value:.4g}" for value in cells] + [decision["verdict"]["level"]]


def compute(program):
    table.parent.mkdir(parents=True, exist_ok=True)
    with open(table, "w") as out:
        print("# million gross tonnes to a depth of 6 mm; empty: not within the run", file=out)
        print("quantity,value,straight,nominal,limit,shortest,interval,verdict", file=out, flush=True)
        for quantity, (_, values) in SCANS.items():
            for value, settings in values.items():
                print(f'"{quantity}",{value},' + ",".join(lives(program, settings)), file=out, flush=True)
    show()


def show():
    with open(table) as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    print("| varied | values | shortest life, MGT | against the order |\n|---|---|---|---|")
    for quantity, (sign, _) in SCANS.items():
        own = [row for row in rows if row["quantity"] == quantity]
        lives = [float(row["shortest"]) if row["shortest"] else float("inf") for row in own]
        if quantity.startswith("axle load"):
            axles = ", ".join(f"{life / float(row['value']):.3g}" for life, row in zip(lives, own))
            print(f"| the same, million axles | | {axles} | |")
        against = [f"{row['value']}: × {b / a:.2f}" for a, b, row in zip(lives, lives[1:], own[1:]) if sign and sign * (b - a) < 0]
        print(f"| {quantity} | {', '.join(row['value'] for row in own)} | {', '.join(f'{life:.3g}' for life in lives)} | {', '.join(against)} |")


if len(sys.argv) > 1:
    compute(str(pathlib.Path(sys.argv[1]).resolve()))
else:
    show()
