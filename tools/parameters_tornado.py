"""Effect of each input on the life of a head check: one input at a time, low and high.

python3 tools/parameters_tornado.py RAILCRACK computes verification/parameters/lives.csv with that
program; without arguments it draws docs/figures/parameters-tornado.svg, which needs matplotlib.
"""

import csv
import pathlib
import sys
import tempfile

from head_check import RESIDUAL, crack, grown, hertz, plane, plots, root

table = root / "verification/parameters/lives.csv"

GROWTH = 'direction = "coplanar"\nsteps = 60\nincrement = 0.06'
INSPECTION = "[inspection]\ndetectable_depth_mm = 1.0\ncritical_depth_mm = 5.0\n"
CONTACT = hertz() + "\nlateral_half_width_mm = 6.0"
CASE = plane(CONTACT, crack(2.366, 0.3, "surface_half_length_mm = 4.732\n"), GROWTH, 20, INSPECTION)
SMOOTH = ['growth.direction="max-rate"', "growth.steps=120"]

# Input: settings, or text behind the case, of the low and of the high value.
INPUTS = {
    "friction between the faces 0.1, 0.5": (["crack[1].friction=0.1"], ["crack[1].friction=0.5"]),
    "friction under the wheel 0.1, 0.3": (["contact.friction=0.1"], ["contact.friction=0.3"]),
    "peak pressure 800, 1200 MPa": (["contact.peak_pressure_mpa=800.0"], ["contact.peak_pressure_mpa=1200.0"]),
    "half-width of the contact 5, 7 mm": (["contact.half_width_mm=5.0"], ["contact.half_width_mm=7.0"]),
    "coefficient C, one sd of 0.3 in ln": (["growth.paris_c=1.4816e-9"], ["growth.paris_c=2.6997e-9"]),
    "coefficient C, limit of the standard": ([], ["growth.steel=R260"]),
    "exponent 3.18, 4 about 10 MPa sqrt(m)": (["growth.paris_c=2.825e-9", "growth.paris_m=3.18"],
                                              ["growth.paris_c=4.276e-10", "growth.paris_m=4.0"]),
    "threshold 0, 6 MPa sqrt(m)": ([], ["growth.law=paris-threshold", "growth.threshold_mpa_sqrt_m=6.0"]),
    "angle 22, 28 degrees": (["crack[1].angle_deg=22.0", "crack[1].length_mm=2.669"],
                             ["crack[1].angle_deg=28.0", "crack[1].length_mm=2.130"]),
    "partial slip (Q/P the same)": ([], ['contact.kind="carter"', "contact.friction=0.4", "contact.traction=0.5"]),
    "residual stress -100, +100 MPa to 2 mm": ("low", "high"),
    "five cracks, 4 mm apart": ([], ["crack[1].count=5", "crack[1].spacing_mm=4.0"]),
    "wear 0, 0.02 mm/MGT": ([], ["maintenance.wear_mm_per_mgt=0.02"]),
    "axle load 15, 22 t (counting alone)": (["traffic.axle_load_t=15.0"], ["traffic.axle_load_t=22.0"]),
    "path: turning length 2, 0.5 mm": (SMOOTH + ["growth.turning_length_mm=2.0"], SMOOTH + ["growth.turning_length_mm=0.5"]),
    "increment 0.06, 0.03": ([], ["growth.increment=0.03", "growth.steps=120"]),
}


def life(program, folder, settings):
    at, text = 0.0, CASE
    if isinstance(settings, str):
        at = -100.0 if settings == "low" else 100.0
        text, settings = text + RESIDUAL, []
    rows = grown(program, text, folder, (at, -0.2 * at), settings)
    if rows is None:
        return None
    deepest = {}
    for row in rows:
        step = int(row["step"])
        if step not in deepest or float(row["depth_mm"]) > deepest[step][0]:
            deepest[step] = (float(row["depth_mm"]), float(row["mgt"]))
    points = [deepest[step] for step in sorted(deepest)]
    for (a, x), (b, y) in zip(points, points[1:]):
        if a < 5.0 <= b:
            return x + (5.0 - a) / (b - a) * (y - x)
    return None


def compute(program):
    with tempfile.TemporaryDirectory() as folder, open(table, "w") as out:
        folder = pathlib.Path(folder)
        base = life(program, folder, [])
        print("# million gross tonnes from 1 to 5 mm of depth; empty: the crack does not get there", file=out)
        print("input,low,high,base", file=out, flush=True)
        for name, (low, high) in INPUTS.items():
            lives = [base if not settings else life(program, folder, settings) for settings in (low, high)]
            cells = ["" if value is None else f"{value:.4g}" for value in [*lives, base]]
            print(f'"{name}",' + ",".join(cells), file=out, flush=True)
            print(name, cells, flush=True)


def draw():
    plot = plots()
    rows = list(csv.DictReader(line for line in open(table) if not line.startswith("#")))
    ends = [(row["input"], [float(row[end]) if row[end] else None for end in ("low", "high")], float(row["base"]))
            for row in rows]
    width = lambda row: max((max(x / row[2], row[2] / x) for x in row[1] if x), default=1.0)
    ends.sort(key=width)
    figure, axes = plot.subplots(figsize=(8, 5))
    for i, (_, lives, base) in enumerate(ends):
        for value, colour in zip(lives, ["#0072b2", "#e69f00"]):
            if value:
                axes.barh(i, value / base - 1.0, left=1.0, color=colour, height=0.6)
    axes.set_xscale("log")
    axes.axvline(1.0, color="0.3", lw=0.8)
    axes.set_yticks(range(len(ends)), [name for name, _, _ in ends], fontsize=8)
    axes.set_xlabel("life over that of the start (blue: first value, orange: second)", fontsize=8)
    figure.tight_layout()
    figure.savefig(root / "docs/figures/parameters-tornado.svg", metadata={"Date": None})


if len(sys.argv) > 1:
    compute(str(pathlib.Path(sys.argv[1]).resolve()))
else:
    draw()
