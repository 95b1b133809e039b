"""Lives of head checks in a rail as new and in the rail that their own wheel has rolled.

python3 tools/rolled_lives.py RAILCRACK computes verification/rolled-lives/lives.csv with that program;
without arguments it draws docs/figures/rolled-lives.svg, which needs matplotlib.
"""

import csv
import pathlib
import sys

from head_check import plots, root, summary

table = root / "verification/rolled-lives/lives.csv"

CASE = """
[contact]
wheel_load_kn = 110.0
wheel_radius_mm = 460.0
wheel_profile_radius_mm = {profile}
rail_head_radius_mm = 300.0
friction = 0.3
[[crack]]
mouth_mm = 0.0
length_mm = {length}
surface_half_length_mm = {twice}
angle_deg = 25.0
friction = 0.3
[growth]
direction = "{direction}"
steps = 60
critical_length_mm = {critical}
[shakedown]
yield_stress_mpa = 500.0
hardening_modulus_mpa = 20e3
{plastic}
[solver]
engine = "dislocation"
[output]
plots = false
report = false
faces = "none"
sif = "none"
"""

# Profile radius of the wheel, mm: worn to 892 MPa, and 1030 MPa.
WHEELS = {"worn wheel": -450.0, "half worn wheel": -900.0}
LENGTHS = {"shallow": 2.0, "deep": 10.0}
PATHS = {"straight": "coplanar", "free": "max-rate"}


def life(program, text):
    """Million axles until the crack is half as long again, and its depth then (mm)."""
    found = summary(program, text)
    reached = found["stop"] == "critical-length"
    return 1e-6 * found["load_cycles"] if reached else None, -found["tips"][0]["y_mm"], found["stop"]


def compute(program):
    table.parent.mkdir(parents=True, exist_ok=True)
    with open(table, "w") as out:
        print("# million axles until the crack is half as long again, and the depth of its tip then", file=out)
        print("wheel,crack,path,new,new_depth_mm,new_end,rolled,rolled_depth_mm,rolled_end", file=out, flush=True)
        for wheel, profile in WHEELS.items():
            for crack, length in LENGTHS.items():
                for path, direction in PATHS.items():
                    cells = []
                    for plastic in ["", "[plastic_stress]"]:
                        text = CASE.format(profile=profile, length=length, twice=2.0 * length, critical=1.5 * length,
                                           direction=direction, plastic=plastic)
                        axles, depth, stop = life(program, text)
                        cells += ["" if axles is None else f"{axles:.4g}", f"{depth:.3f}", stop]
                    print(f"{wheel},{crack},{path}," + ",".join(cells), file=out, flush=True)


def draw():
    plot = plots()
    rows = list(csv.DictReader(line for line in open(table) if not line.startswith("#")))
    figure, axes = plot.subplots(figsize=(6.0, 3.4))
    for at, row in enumerate(rows):
        for state, marker, color in [("new", "o", "tab:gray"), ("rolled", "s", "tab:red")]:
            if row[state]:
                axes.plot(float(row[state]), at, marker, color=color, label=state if at == 0 else None)
        if row["new"] and row["rolled"]:
            axes.plot([float(row["new"]), float(row["rolled"])], [at, at], color="tab:gray", lw=1, zorder=0)
    axes.set_xscale("log")
    ticks = [0.04, 0.06, 0.1, 0.2, 0.3]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_yticks(range(len(rows)), [f"{row['wheel']}, {row['crack']}, {row['path']}" for row in rows])
    axes.invert_yaxis()
    axes.set_xlabel("million axles until half as long again")
    axes.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(root / "docs/figures/rolled-lives.svg", metadata={"Date": None, "Creator": None})


if len(sys.argv) > 1:
    compute(str(pathlib.Path(sys.argv[1]).resolve()))
else:
    draw()
