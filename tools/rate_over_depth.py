"""Growth rate over depth, one cause at a time and together, against the rates measured in track.

python3 tools/rate_over_depth.py RAILCRACK [CAUSE ...] computes verification/rate-over-depth/rates.csv
with that program: all causes, or those named, of which depths that the table has are kept. Without
arguments it draws docs/figures/rate-over-depth.svg and rate-to-20-mm.svg, which needs matplotlib.

The crack is straight at 25 degrees: every depth is the initial crack of a run of its own, so that a
cause acts on the rate and not on the way to that depth. Only "turning" grows a crack; a crack "that has
turned" is a polyline, at 25 degrees to 5 mm of depth and at 60 degrees below.
"""

import csv
import math
import pathlib
import sys
import tempfile

import head_check
from head_check import ANGLE, AXLE, RESIDUAL, hertz, root

table = root / "verification/rate-over-depth/rates.csv"

DEPTHS = [0.5, 0.8, 1.3, 2.0, 3.0, 5.0, 7.0, 9.0, 12.0]
TO_20_MM = [*DEPTHS, 16.0, 20.0]
IN_SPACE = [0.5, 0.8, 2.0, 5.0, 9.0, 12.0]
SINE = math.sin(math.radians(ANGLE))

# Net of small falls, and forward only: mm per MGT between two depths (validation/track).
MEASURED = [(0.3, 0.8, 0.0495, 0.0928), (0.8, 1.3, 0.0148, 0.1197), (1.3, 1.8, 0.0682, 0.1518),
            (1.8, 2.3, 0.0707, 0.1636), (5, 8, 0.236, 0.324), (8, 10, 0.3, 0.661), (10, 14, 0.529, 0.851)]

SPACE = """
[passage]
from_over_a = -5.0
to_over_a = 7.0
positions = 61
step_tolerance = 0.01
{cracks}
{wheels}
[growth]
steps = 0
{growth}
[mesh]
space_cells = 3
space_rings = 3
[solver]
engine = "space"
[output]
faces = "none"
plots = false
report = false
{more}
"""


def carter(ratio, friction=0.4):
    return f'kind = "carter"\npeak_pressure_mpa = 1000.0\nhalf_width_mm = 6.0\nfriction = {friction}\ntraction = {ratio}'


def crack(depth, faces=0.5, more=""):
    return head_check.crack(depth / SINE, faces, more)


def straight(depth, contact=None, growth="steps = 0", more="", faces=0.5, crack_more=""):
    return head_check.plane(contact or hertz(), crack(depth, faces, crack_more), growth, 24, more)


def plane(growth="", middle=0, depths=DEPTHS, **given):
    return lambda depth: straight(depth, growth=f"steps = 0\n{growth}", **given), depths, middle


# Where a crack has turned, and its angle below: head checks turn down at 3 to 6 mm of depth.
TURN, STEEP = 5.0, 60.0
TURNED = "that has turned"

# The load of the ellipse is that of a wheel of an axle of 18 t within 15 %.
TRACK = '[track]\nwheel_load_kn = 88.0\nsection = "60E1"\naxles_mm = [0.0, 2500.0]\n'
COLD = "[temperature]\nrail_c = -5.0\nneutral_c = 25.0\n"
SECTION = '[rail]\nsection = "60E1"\n'


def turned(depth, faces, ratio):
    """The [[crack]] that has turned, `ratio` times as long on the surface as along itself."""
    steep = math.radians(STEEP)
    at = TURN / math.tan(math.radians(ANGLE))
    points = [[0.0, 0.0], [at, -TURN], [at + (depth - TURN) / math.tan(steep), -depth]]
    half = 0.5 * ratio * (TURN / SINE + (depth - TURN) / math.sin(steep))
    return f"[[crack]]\npoints_mm = {points}\nfriction = {faces}\nsurface_half_length_mm = {half}\n"


def ellipse_in_plane(contact=None, faces=0.5, more="", turns=False, ratio=4.0, lateral_half_width=6.0):
    patch = f"{contact or hertz()}\nlateral_half_width_mm = {lateral_half_width}"

    def text(depth):
        if turns and depth > TURN:
            own = turned(depth, faces, ratio)
        else:
            own = crack(depth, faces, f"surface_half_length_mm = {0.5 * ratio * depth / SINE}\n")
        return head_check.plane(patch, own, "steps = 0", 24, more)
    depths = [depth for depth in TO_20_MM if depth >= TURN] if turns else TO_20_MM
    return text, depths, 0


def space(ratio, lateral_half_width=6.0, offsets=((0.0, 1.0),), faces=0.5, growth="", contact=None, more="", cells=3):
    """A semi-ellipse whose length on the surface is `ratio` times its depth along its plane."""
    def text(depth):
        half = 0.5 * ratio * depth / SINE
        cracks = crack(depth, faces, f"surface_half_length_mm = {half}\n")
        wheels = ""
        for z, share in offsets:
            inner = (contact or hertz()) + f"\nlateral_half_width_mm = {lateral_half_width}\nlateral_mm = {z}\n"
            wheels += f"[[wheel]]\nshare = {share}\naxle_load_t = {AXLE}\n[wheel.contact]\n{inner}"
        text = SPACE.format(cracks=cracks, wheels=wheels, growth=growth, more=more)
        return text.replace("space_cells = 3", f"space_cells = {cells}").replace("space_rings = 3", f"space_rings = {cells}")
    return text, IN_SPACE, 0


def scattered(std):
    """Three wheels with the mean and the standard deviation of a normal distribution (Gauss-Hermite)."""
    far = math.sqrt(3.0) * std
    return ((-far, 1 / 6), (0.0, 2 / 3), (far, 1 / 6))


CAUSES = {
    "plane": plane(depths=TO_20_MM),
    "plane, faces 0.3": plane(faces=0.3),
    "plane, faces 0.7": plane(faces=0.7),
    "plane, wheel 0.3": plane(contact=hertz(0.3)),
    "plane, pressure 1500": plane(contact=hertz(0.2, 1500.0)),
    "partial slip": plane(contact=carter(0.5)),
    "coupled wheel": plane(contact=hertz() + "\ncoupled = true"),
    "five neighbours at 4 mm": plane(crack_more="count = 5\nspacing_mm = 4.0\n", middle=2),
    "threshold 6": plane(growth='law = "paris-threshold"\nthreshold_mpa_sqrt_m = 6.0'),
    "threshold of mode II 10": plane(growth='law = "paris-threshold"\nthreshold_mpa_sqrt_m = 6.0\nthreshold_2_mpa_sqrt_m = 10.0'),
    "exponent 2": plane(growth="paris_c = 4.28e-8\nparis_m = 2.0"),
    "exponent 4": plane(growth="paris_c = 4.28e-10\nparis_m = 4.0"),
    "ratio of mode I (Walker)": plane(growth='law = "walker"'),
    "compression 100 MPa to 2 mm": plane(more=RESIDUAL),
    "plane, together: faces 0.7, partial slip, neighbours":
        plane(contact=carter(0.5), faces=0.7, crack_more="count = 5\nspacing_mm = 4.0\n", middle=2),
    "plane, together: faces 0.7, wheel 0.3": plane(contact=hertz(0.3), faces=0.7),
    "plane, ellipse": ellipse_in_plane(),
    "plane, ellipse, faces 0.3": ellipse_in_plane(faces=0.3),
    "plane, ellipse, wheel 0.3": ellipse_in_plane(contact=hertz(0.3)),
    f"plane, ellipse, {TURNED}": ellipse_in_plane(turns=True),
    f"plane, ellipse, {TURNED}, bending": ellipse_in_plane(turns=True, more=TRACK),
    f"plane, ellipse, {TURNED}, bending, cold": ellipse_in_plane(turns=True, more=TRACK + COLD),
    f"plane, ellipse, {TURNED}, bending, cold, section": ellipse_in_plane(turns=True, more=TRACK + COLD + SECTION),
    f"plane, ellipse, {TURNED}, bending, cold, section, faces 0.3":
        ellipse_in_plane(turns=True, faces=0.3, more=TRACK + COLD + SECTION),
    "plane, ellipse, bending, cold, section": ellipse_in_plane(more=TRACK + COLD + SECTION),
    "line contact, width 4:1": space(4.0, lateral_half_width=120.0),
    "ellipse, width 6:1": space(6.0),
    "ellipse, width 4:1": space(4.0),
    "ellipse, width 2:1": space(2.0),
    "ellipse, width 4:1, 6 cells": space(4.0, cells=6),
    "ellipse, width 4:1, wheels within 5 mm": space(4.0, offsets=scattered(5.0)),
    "ellipse, width 4:1, faces 0.3": space(4.0, faces=0.3),
    "ellipse, width 4:1, faces 0.7": space(4.0, faces=0.7),
    "ellipse, width 4:1, wheel 0.3": space(4.0, contact=hertz(0.3)),
    "together: 2:1, wheels within 5 mm, wheel 0.3": space(2.0, offsets=scattered(5.0), contact=hertz(0.3)),
    "together: 2:1, wheels within 5 mm, wheel 0.3, faces 0.7":
        space(2.0, offsets=scattered(5.0), contact=hertz(0.3), faces=0.7),
}
# Growth along a path instead of straight: steps at which the depth passes those of the table.
WEAR = {"wear 0.02": 0.02}
TURNING = {"turning length 0.5 mm": "turning_length_mm = 0.5", "turning length 2 mm": "turning_length_mm = 2.0"}


def run(program, text, folder):
    # Compression below the running surface, tension under it.
    found = head_check.grown(program, text, folder, (-100.0, 20.0))
    if not found:
        raise RuntimeError("the run was refused")
    return found


def sine_at(cause, depth):
    return math.sin(math.radians(STEEP)) if TURNED in cause and depth > TURN else SINE


def depth_rate(row, sine=SINE):
    """mm of depth per million gross tonnes."""
    return 1e6 / AXLE * float(row["rate_mm_per_cycle"]) * sine


def of_cause(program, cause, folder, known):
    text, depths, middle = CAUSES[cause]
    for depth in depths:
        if depth in known:
            yield depth, known[depth]
            continue
        found = run(program, text(depth), folder)
        if "phi_deg" in found[0]:
            row = found[len(found) // 2]  # the deepest point of the front is the middle one
        elif middle:
            row = next(row for row in found if int(row["crack"]) == middle + 1)
        else:
            row = min(found, key=lambda row: float(row["tip_y_mm"]))
        yield depth, depth_rate(row, sine_at(cause, depth))


def of_wear(program, wear, folder):
    """The depth below a surface that wears by `wear` mm per million gross tonnes, over one increment."""
    for depth in DEPTHS:
        text = straight(depth, more=f"[maintenance]\nwear_mm_per_mgt = {wear}",
                        growth='steps = 1\ndirection = "coplanar"\nincrement = 0.01\ncritical_length_mm = 60.0')
        found = run(program, text, folder)
        (before, after), passed = (float(row["depth_mm"]) for row in found[:2]), float(found[1]["mgt"])
        yield depth, (after - before) / passed


def of_turning(program, setting, folder):
    text = straight(0.5, growth=f"steps = 150\n{setting}\ntolerance = 0.03\ncritical_length_mm = 30.0")
    points = [(float(row["depth_mm"]), float(row["mgt"])) for row in run(program, text, folder)]
    for depth in DEPTHS:
        for (from_depth, from_mgt), (to_depth, to_mgt) in zip(points, points[1:]):
            if from_depth <= depth < to_depth and to_mgt > from_mgt:
                yield depth, (to_depth - from_depth) / (to_mgt - from_mgt)
                break


def compute(program, named):
    known = {}
    if table.exists():
        for row in csv.DictReader(open(table)):
            known.setdefault(row["cause"], []).append((float(row["depth_mm"]), float(row["rate_mm_per_mgt"])))
    for cause in [*CAUSES, *WEAR, *TURNING]:
        if named and cause not in named or not named and cause in known:
            continue
        of_old = dict(known.get(cause, []))
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            if cause in TURNING:
                of = of_turning(program, TURNING[cause], folder)
            elif cause in WEAR:
                of = of_wear(program, WEAR[cause], folder)
            else:
                of = of_cause(program, cause, folder, of_old)
            try:
                known[cause] = list(of)
            except Exception as error:
                print(cause, "failed:", error, file=sys.stderr)
                continue
        print(cause, known[cause], flush=True)
        with open(table, "w") as out:
            out.write("cause,depth_mm,rate_mm_per_mgt\n")
            for name in [*CAUSES, *WEAR, *TURNING]:
                for depth, rate in known.get(name, []):
                    out.write(f'"{name}",{depth},{rate:.4g}\n')


def draw():
    shown = ["plane", "plane, faces 0.3", "plane, wheel 0.3", "ellipse, width 6:1", "ellipse, width 2:1",
             "ellipse, width 4:1, wheels within 5 mm", "together: 2:1, wheels within 5 mm, wheel 0.3",
             "together: 2:1, wheels within 5 mm, wheel 0.3, faces 0.7"]
    picture("rate-over-depth", {name: name for name in shown})
    steps = f"plane, ellipse, {TURNED}"
    picture("rate-to-20-mm", {
        "plane": "line contact",
        "plane, ellipse": "ellipse",
        steps: "and the crack has turned to 60° at 5 mm",
        f"{steps}, bending": "and the rail bends",
        f"{steps}, bending, cold": "and is 30 K colder than neutral",
        f"{steps}, bending, cold, section": "and has a section",
        "plane, ellipse, bending, cold, section": "the same, but straight at 25°",
        "ellipse, width 4:1, 6 cells": "in space: ellipse, 4:1, 6 cells",
    })


def picture(name, shown):
    """The causes `shown`, with their labels, over the measured rates."""
    plot = head_check.plots()
    known = {}
    for row in csv.DictReader(open(table)):
        known.setdefault(row["cause"], []).append((float(row["depth_mm"]), float(row["rate_mm_per_mgt"])))
    figure, axes = plot.subplots(figsize=(8, 5))
    for low, high, net, forward in MEASURED:
        axes.fill_between([low, high], net, forward, color="0.75", lw=0)
    axes.fill_between([], [], color="0.75", label="measured, net to forward only")
    for cause, label in shown.items():
        points = [point for point in known.get(cause, []) if point[1] > 0]
        look = "x:" if label.startswith("in space") else "o-"
        axes.plot([x for x, _ in points], [y for _, y in points], look, ms=3, lw=1, label=label)
    axes.set(xscale="log", yscale="log", xlabel="depth, mm", ylabel="growth in depth, mm per MGT")
    axes.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(root / f"docs/figures/{name}.svg", metadata={"Date": None})


if __name__ != "__main__":
    pass  # the cases alone, for scattered_wheels.py
elif len(sys.argv) > 1:
    compute(str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2:])
else:
    draw()
