"""Delta K_eq of cracks in the plane under an ellipse over that in space.

python3 tools/patch_in_plane.py RAILCRACK computes verification/patch-in-plane/ratios.csv with that
program: all in the plane, in space those that the table lacks. Without arguments it prints the medians and the worst of
each group, and the table of docs/dev/patch-in-plane.md.

A case of one varied quantity differs by it from a head check at 25 degrees, 4:1 long, with 0.3
between its faces, under a circle of 1000 MPa, a = 6 mm and friction 0.2.
"""

import csv
import math
import pathlib
import statistics
import sys
import tempfile

import head_check
from head_check import root

table = root / "verification/patch-in-plane/ratios.csv"

BASE = {"depth_mm": 5.0, "angle_deg": 25.0, "faces": 0.3, "wheel": 0.2, "b_over_a": 1.0, "width": 4.0, "offset_over_b": 0.0}
HALF_WIDTH = 6.0
CELLS = 8

CASE = """
[contact]
peak_pressure_mpa = 1000.0
half_width_mm = {a}
lateral_half_width_mm = {b}
lateral_mm = {offset}
friction = {wheel}
[passage]
from_over_a = -6.0
to_over_a = 7.0
positions = {positions}
step_tolerance = 0.01
[[crack]]
mouth_mm = 0.0
length_mm = {length}
surface_half_length_mm = {half}
angle_deg = {angle_deg}
friction = {faces}
[growth]
steps = 0
[mesh]
{mesh}
[solver]
engine = "{engine}"
[output]
faces = "none"
plots = false
report = false
"""

DEPTHS = [0.8, 2.0, 5.0, 9.0, 12.0]


def group(name, *cases):
    return [(name, {**BASE, **case}) for case in cases]


CASES = [
    *group("depth, faces 0.3", *({"depth_mm": d} for d in DEPTHS)),
    *group("depth, faces 0.5", *({"depth_mm": d, "faces": 0.5} for d in DEPTHS)),
    *group("depth, faces 0.1", *({"depth_mm": d, "faces": 0.1} for d in [0.8, 2.0, 9.0, 12.0])),
    *group("angle", *({"angle_deg": angle, "depth_mm": d} for angle in [15.0, 40.0, 60.0] for d in [2.0, 5.0])),
    *group("b/a", *({"b_over_a": b, "depth_mm": d} for b in [0.5, 2.0] for d in [2.0, 5.0, 9.0])),
    *group("faces", *({"faces": mu, "depth_mm": d} for mu in [0.0, 0.7] for d in [2.0, 5.0])),
    *group("width 2:1", *({"width": 2.0, "depth_mm": d} for d in [2.0, 5.0, 9.0])),
    *group("width 6:1", *({"width": 6.0, "depth_mm": d} for d in [2.0, 5.0, 9.0])),
    *group("offset b/4", *({"offset_over_b": 0.25, "depth_mm": d} for d in [2.0, 5.0, 9.0])),
    *group("offset b/2", *({"offset_over_b": 0.5, "depth_mm": d} for d in [2.0, 5.0, 9.0])),
    *group("offset b and more", *({"offset_over_b": y} for y in [1.0, 2.0, 3.0])),
]


def text(of, engine):
    length = of["depth_mm"] / math.sin(math.radians(of["angle_deg"]))
    b = HALF_WIDTH * of["b_over_a"]
    in_space = engine == "space"
    mesh = f"space_cells = {CELLS}\nspace_rings = {CELLS}" if in_space else "interface_elements = 24"
    return CASE.format(a=HALF_WIDTH, b=b, offset=b * of["offset_over_b"], length=length, half=0.5 * of["width"] * length,
                       positions=66 if in_space else 131, mesh=mesh, engine=engine, **of)


def delta_k(program, of, engine):
    """Delta K_eq (MPa sqrt(m)) of the deepest point, the middle one of a front."""
    with tempfile.TemporaryDirectory() as folder:
        rows = head_check.grown(program, text(of, engine), pathlib.Path(folder), (-100.0, 20.0))
    return float(rows[len(rows) // 2]["delta_keq_mpa_sqrt_m"])


def read():
    if not table.exists():
        return []
    with open(table) as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def compute(program):
    names = [*BASE, "plane", "space"]
    key = lambda of: tuple(float(of[name]) for name in BASE)
    known = {(row["group"], key(row)): row for row in read()}
    table.parent.mkdir(parents=True, exist_ok=True)
    for number, (name, of) in enumerate(CASES):
        row = known.setdefault((name, key(of)), {"group": name, **of})
        for column, engine in [("plane", "dislocation"), ("space", "space")]:
            if column == "plane" or column not in row:
                row[column] = f"{delta_k(program, of, engine):.4g}"
        with open(table, "w") as out:
            print(f"# Delta K_eq (MPa sqrt(m)) at the deepest point, in space with {CELLS} cells", file=out)
            print(",".join(["group", *names]), file=out)
            for name, of in CASES:
                row = known.get((name, key(of)), {})
                if "space" in row:
                    print(",".join([f'"{name}"', *(str(row[k]) for k in names)]), file=out)
    show()


def show():
    groups = {}
    for row in read():
        groups.setdefault(row["group"], []).append((float(row["plane"]) / float(row["space"]), row))
    print("| varied | cases | median | least | most |\n|---|---|---|---|---|")
    for name, all in groups.items():
        ratios = [ratio for ratio, _ in all]
        print(f"| {name} | {len(all)} | {statistics.median(ratios):.2f} | {min(ratios):.2f} | {max(ratios):.2f} |")
    centred = [ratio for all in groups.values() for ratio, row in all if float(row["offset_over_b"]) == 0.0]
    off = sorted(abs(ratio - 1.0) for ratio in centred)
    if off:
        print(f"{len(off)} under a centred wheel: median {100 * statistics.median(off):.1f} %, worst {100 * off[-1]:.0f} %")
    for name, all in groups.items():
        print(name, " ".join(f"{row['depth_mm']}/{row['angle_deg']}/{row['faces']}: {ratio:.3f} of {row['space']}" for ratio, row in all))


if len(sys.argv) > 1:
    compute(str(pathlib.Path(sys.argv[1]).resolve()))
else:
    show()
