"""Life of a head check in the plane and in space over its aspect and that of the contact.

python3 tools/plane_and_space.py RAILCRACK computes verification/plane-and-space/lives.csv with that
program; without it, the csv is drawn as docs/figures/plane-and-space.svg. Needs matplotlib for that.
"""

import csv
import math
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
table = root / "verification/plane-and-space/lives.csv"

LENGTH, END = 4.0, 6.0
ASPECTS = [0.5, 1.0, 2.0]
CONTACTS = [0.5, 1.0, 2.0, 8.0]
CASE = """
[contact]
peak_pressure_mpa = 1000.0
half_width_mm = 6.0
{wheel}
friction = 0.1

[[crack]]
mouth_mm = 0.0
length_mm = {length}
{width}
angle_deg = 30.0
friction = 0.3

[growth]
steps = 20
increment = 0.1
critical_length_mm = {end}
direction = "coplanar"

[mesh]
{mesh}

[solver]
engine = "{engine}"
"""


def run(program, folder, **words):
    case = pathlib.Path(folder) / "case.toml"
    case.write_text(CASE.format(length=LENGTH, end=END, **words))
    out = pathlib.Path(folder) / "run"
    subprocess.run([program, "run", case, "--out", out, "--quiet", "--force"], check=True, capture_output=True)
    with open(out / "growth.csv") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    steps = {}
    for row in rows:
        steps.setdefault(int(row["step"]), []).append(row)
    # The deepest point of the front is the middle one; the plane has one tip.
    deepest = [rows[len(rows) // 2] for rows in steps.values()]
    first = deepest[0]
    lengths = [float(row["length_mm"]) for row in deepest]
    cycles = [float(row["load_cycles"]) for row in deepest]
    k = next((k for k, length in enumerate(lengths) if length >= END), None)
    if k is None:
        return first, math.nan
    share = math.log(END / lengths[k - 1]) / math.log(lengths[k] / lengths[k - 1])
    return first, cycles[k - 1] + share * (cycles[k] - cycles[k - 1])


def compute(program):
    table.parent.mkdir(parents=True, exist_ok=True)
    with open(table, "w") as file, tempfile.TemporaryDirectory() as folder:

        def write(engine, cells, aspect, contact, first, life):
            k = [float(first[f"delta_{name}_mpa_sqrt_m"]) for name in ("ki", "kii", "keq")]
            numbers = ",".join(f"{value:.4f}" for value in k)
            print(f"{engine},{cells},{aspect},{contact},{numbers},{life:.0f}", file=file, flush=True)

        print("# A head check of 4 mm at 30 degrees: ranges at its deepest point, axles until it has 6 mm", file=file)
        print("engine,cells,c_over_l,b_over_a,delta_ki,delta_kii,delta_keq,axles", file=file)
        plane = dict(engine="dislocation", wheel="", width="", mesh="")
        write("dislocation", "", "", "", *run(program, folder, **plane))
        finer = [(1.0, 0.5, 6), (1.0, 1.0, 6), (1.0, 8.0, 6), (2.0, 1.0, 6), (0.5, 1.0, 6)]
        grid = [(aspect, contact, 4) for aspect in ASPECTS for contact in CONTACTS] + finer
        for aspect, contact, cells in grid:
            case = dict(
                engine="space",
                wheel=f"lateral_half_width_mm = {6.0 * contact}",
                width=f"surface_half_length_mm = {LENGTH * aspect}",
                mesh=f"space_cells = {cells}\nspace_rings = {cells}",
            )
            write("space", cells, aspect, contact, *run(program, folder, **case))


def draw():
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.fonttype"] = "none"
    matplotlib.rcParams["svg.hashsalt"] = "railcrack"
    import matplotlib.pyplot as plt
    import matplotlib.ticker

    with open(table) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    plane = next(row for row in rows if row["engine"] == "dislocation")
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
    panels = [("delta_keq", 1.0, "ΔK_eq at the deepest point, MPa√m"), ("axles", 1e-3, "thousand axles from 4 to 6 mm")]
    styles = [("#0072b2", "o-"), ("#e69f00", "s-"), ("#009e73", "^-")]
    for axis, (name, unit, title) in zip(axes, panels):
        for aspect, (colour, look) in zip(ASPECTS, styles):
            own = [r for r in rows if r["cells"] == "4" and float(r["c_over_l"]) == aspect]
            x = [float(r["b_over_a"]) for r in own]
            axis.plot(x, [unit * float(r[name]) for r in own], look, color=colour, label=f"space, c/l = {aspect:g}")
        finer = [r for r in rows if r["cells"] == "6"]
        x = [float(r["b_over_a"]) for r in finer]
        if finer:
            axis.plot(x, [unit * float(r[name]) for r in finer], "x", color="#444444", label="space, 6 cells")
        axis.axhline(unit * float(plane[name]), color="#666666", linestyle=":", label="plane, line contact")
        axis.set_xscale("log")
        axis.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
        axis.set_xticks(CONTACTS, [f"{value:g}" for value in CONTACTS])
        axis.set_xlabel("b/a of the contact")
        axis.set_ylabel(title)
        axis.set_ylim(0, None)
        axis.grid(True, which="major", color="#e4e4e4")
    lines = axes[0].get_lines()
    figure.legend(lines, [line.get_label() for line in lines], fontsize=8, loc="outside lower center", ncols=5)
    figure.savefig(root / "docs/figures/plane-and-space.svg", metadata={"Date": None, "Creator": None})


if len(sys.argv) > 1:
    compute(sys.argv[1])
else:
    draw()
