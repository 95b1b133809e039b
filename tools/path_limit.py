"""Crack paths and lives over the increment, the turning length and the tolerance.

python3 tools/path_limit.py RAILCRACK [PART ...] computes the tables of verification/path with that
program, all parts or those named; without arguments, they are drawn as docs/figures/path-*.svg.
Needs matplotlib for that.
"""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
tables = root / "verification/path"

CASE = """
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = {wheel}

[passage]
from_over_a = {start}
to_over_a = {end}

{cracks}
[growth]
{growth}

{more}
[solver]
engine = "{engine}"
"""
CRACK = """[[crack]]
mouth_mm = {mouth}
length_mm = {length}
angle_deg = {angle}
friction = {faces}
"""
# The first case is that of the tables, the others are the reference case of the paper (Table 1).
HEAD_CHECK = dict(wheel=0.3, length=4.0, angle=30.0, faces=0.3, law={"paris_c": 2e-11}, until=5.5)
PAPER = dict(wheel=0.025, length=6.0, angle=15.0, faces=0.5, law={}, until=11.0)
CASES = {
    "head check": HEAD_CHECK,
    "Table 1": PAPER,
    "Table 1, wheel 0.1": {**PAPER, "wheel": 0.1},
    "Table 1, wheel 0.4": {**PAPER, "wheel": 0.4},
}
INCREMENTS = [0.16, 0.08, 0.04, 0.02, 0.01, 0.005, 0.0025]
LENGTHS = ["inf", "1", "0.5", "0.16", "0"]
CRITERIA = ["max-rate", "max-delta-ctd", "coplanar", "max-delta-k1", "max-k1", "mts", "max-rate-unclipped"]


class Raw(str):
    """A number as text."""


def toml(value):
    return f'"{value}"' if isinstance(value, str) and not isinstance(value, Raw) else str(value)


class Program:
    def __init__(self, path):
        self.path = path

    def rows(self, case, engine="dislocation", more="", files=(), sets=(), **growth):
        """The rows of growth.csv of `case`, by tip; `sets` are further keys, as for --set."""
        cracks = case.get("cracks") or [dict(mouth=0.0, **{k: case[k] for k in ("length", "angle", "faces")})]
        forward = case.get("along", True)
        keys = {"steps": 3000, "critical_length_mm": case["until"], **case["law"], **growth}
        text = CASE.format(
            wheel=case["wheel"] if forward else -case["wheel"],
            start=-6.0 if forward else 6.0,
            end=6.0 if forward else -6.0,
            cracks="".join(CRACK.format(**crack) for crack in cracks),
            growth="\n".join(f"{key} = {toml(value)}" for key, value in keys.items()),
            more=more,
            engine=engine,
        )
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "case.toml").write_text(text)
            for name, content in files:
                (folder / name).write_text(content)
            run = [self.path, "run", folder / "case.toml", "--out", folder / "run", "--quiet", "--force"]
            run += [word for key in sets for word in ("--set", key)]
            result = subprocess.run(run, capture_output=True, text=True)
            # 3, not converged: the path up to there counts, usually just below the surface.
            if result.returncode not in (0, 3):
                raise RuntimeError(f"{result.stderr}\n{text}")
            rows = read(folder / "run/growth.csv")
            summary = json.loads((folder / "run/summary.json").read_text())
            self.failure = (summary.get("decision") or {}).get("failure") or {}
        tips = {}
        for row in rows:
            tips.setdefault((row["crack"], row["tip"]), []).append(row)
        return tips

    def tip(self, case, **words):
        """The rows of the only tip of `case`."""
        return next(iter(self.rows(case, **words).values()))


def read(path):
    with open(path) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def number(row, name):
    return float(row[name]) if row[name] else math.nan


def at_length(rows, length):
    """Axles and tip (x, depth) where the crack is `length` long: 1/rate is linear in between, as in
    the trapezoidal rule of the program."""
    lengths = [number(row, "length_mm") for row in rows]
    k = next((k for k, own in enumerate(lengths) if own >= length - 1e-9), None)
    if k is None:
        return math.nan, math.nan, math.nan
    end = rows[k]
    if k == 0 or lengths[k] - length < 1e-9:
        return number(end, "load_cycles"), number(end, "tip_x_mm"), -number(end, "tip_y_mm")
    start = rows[k - 1]
    part = (length - lengths[k - 1]) / (lengths[k] - lengths[k - 1])
    slow = [1.0 / max(number(row, "rate_mm_per_cycle"), 1e-30) for row in (start, end)]
    share = part * (slow[0] + 0.5 * part * (slow[1] - slow[0])) / (0.5 * (slow[0] + slow[1]))

    def between(name, part):
        return number(start, name) + part * (number(end, name) - number(start, name))

    return between("load_cycles", share), between("tip_x_mm", part), -between("tip_y_mm", part)


class Table:
    def __init__(self, name, about, columns):
        tables.mkdir(parents=True, exist_ok=True)
        self.file = open(tables / f"{name}.csv", "w")
        print(f"# {about}\n{columns}", file=self.file, flush=True)

    def write(self, *cells):
        texts = [f"{cell:.7g}" if isinstance(cell, float) else str(cell) for cell in cells]
        print(",".join(f'"{text}"' if "," in text else text for text in texts), file=self.file, flush=True)


def increments(program):
    """Whole kinks and the default turning length over the increment."""
    about = "Axles and tip at 5.5 mm (head check) and 11 mm (Table 1), by increment as a fraction of the length"
    table = Table("increments", about, "case,turning,increment,axles,tip_x_mm,tip_depth_mm,tip_angle_deg")
    for name, case in CASES.items():
        for turning in ["kink", "smooth"]:
            for increment in INCREMENTS:
                rows = program.tip(case, turning=turning, increment=increment)
                axles, x, depth = at_length(rows, case["until"])
                last = rows[-2:]
                angle = math.degrees(
                    math.atan2(
                        number(last[0], "tip_y_mm") - number(last[1], "tip_y_mm"),
                        number(last[1], "tip_x_mm") - number(last[0], "tip_x_mm"),
                    )
                )
                table.write(name, turning, increment, axles, x, depth, angle)


def convergence(program):
    """Life over the increment for turning lengths, in both engines."""
    about = "The head check to 5.5 mm, by engine, turning length (mm) and increment"
    table = Table("convergence", about, "engine,turning_length_mm,increment,axles,tip_x_mm,tip_depth_mm")
    for engine, least in [("dislocation", 0.0025), ("xfem", 0.01)]:
        for length in ["inf", "0.5", "0.16", "0"]:
            for increment in INCREMENTS:
                if increment >= least:
                    rows = program.tip(HEAD_CHECK, engine=engine, turning_length_mm=Raw(length), increment=increment)
                    table.write(engine, length, increment, *at_length(rows, 5.5))


def tolerance(program):
    """Increments that choose themselves."""
    about = "Increments chosen for a tolerance; the true error is that against increments of 0.25 %"
    columns = "case,turning_length_mm,tolerance,steps,axles,tip_x_mm,tip_depth_mm,estimated,true"
    table = Table("tolerance", about, columns)
    for name in ["head check", "Table 1", "Table 1, wheel 0.1", "Table 1, wheel 0.4"]:
        case = CASES[name]
        for length in ["inf", "0.5", "0.16", "0"]:
            fine = program.tip(case, turning_length_mm=Raw(length), increment=0.0025)
            true = at_length(fine, case["until"])[0]
            for allowed in [0.05, 0.01, 0.001]:
                rows = program.tip(case, turning_length_mm=Raw(length), tolerance=allowed)
                axles, x, depth = at_length(rows, case["until"])
                estimated = number(rows[-1], "load_cycles_error") / axles
                table.write(name, length, allowed, len(rows) - 1, axles, x, depth, estimated, axles / true - 1.0)


def criteria(program):
    """The seven direction criteria, with whole kinks and with a turning length."""
    about = "The head check to 5.2 mm by direction criterion: whole kinks, and the default turning length"
    columns = "direction,turning,increment,first_kink_deg,axles,tip_x_mm,tip_depth_mm,stop"
    table = Table("criteria", about, columns)
    case = {**HEAD_CHECK, "until": 5.2}
    for direction in CRITERIA:
        for turning in ["kink", "smooth"]:
            for increment in [0.08, 0.04, 0.02, 0.01, 0.005]:
                rows = program.tip(case, turning=turning, direction=direction, increment=increment)
                kink = number(rows[0], "kink_angle_deg")
                table.write(direction, turning, increment, kink, *at_length(rows, 5.2), rows[-1]["stop"])


def depths(program):
    """The best kink of straight cracks by criterion and depth."""
    about = "Best kink (degrees) of a straight crack at 25 degrees, frictions 0.3, by direction criterion and depth of its tip"
    table = Table("first_kinks", about, "direction,depth_mm,kink_deg,rival_deg,rival_ratio")
    for direction in CRITERIA:
        for depth in [0.5, 1.0, 2.0, 3.0, 5.0]:
            case = {**HEAD_CHECK, "angle": 25.0, "length": depth / math.sin(math.radians(25.0)), "until": 100.0}
            row = program.tip(case, direction=direction, steps=0)[0]
            table.write(direction, depth, *(number(row, name) for name in ("kink_angle_deg", "rival_angle_deg", "rival_ratio")))


def paths(program):
    """Paths for turning lengths."""
    about = "Paths of the head check to 8 mm by turning length (mm); kink: whole kinks, with the increment"
    table = Table("paths", about, "turning,x_mm,depth_mm")
    case = {**HEAD_CHECK, "until": 8.0}
    for length in LENGTHS:
        rows = program.tip(case, turning_length_mm=Raw(length), increment=0.01)
        table.write(length, 0.0, 0.0)
        for row in rows:
            table.write(length, number(row, "tip_x_mm"), -number(row, "tip_y_mm"))
    for increment in [0.08, 0.02, 0.005]:
        rows = program.tip(case, turning="kink", increment=increment)
        table.write(f"kink {100 * increment:g} %", 0.0, 0.0)
        for row in rows:
            table.write(f"kink {100 * increment:g} %", number(row, "tip_x_mm"), -number(row, "tip_y_mm"))


def track(program):
    """Head checks from 0.5 mm depth: angles and depths for turning lengths."""
    about = "A crack at 25 degrees from a depth of 0.5 mm: angle at 2 and 3 mm, depth at which it passes 45 degrees, depth and angle of its first kink"
    table = Table("track", about, "wheel,faces,turning_length_mm,angle_at_2_deg,angle_at_3_deg,depth_of_45_mm,kink_depth_mm,kink_deg")
    for wheel, faces in [(0.3, 0.3), (0.4, 0.3), (0.3, 0.1), (0.2, 0.1), (0.3, 0.5)]:
        for length in ["0.2", "0.5", "1", "2", "inf"]:
            case = dict(wheel=wheel, length=0.5 / math.sin(math.radians(25.0)), angle=25.0, faces=faces, law={"paris_c": 2e-11, "arrest_rate_mm_per_cycle": 1e-30}, until=14.0)
            rows = program.tip(case, turning_length_mm=Raw(length))
            points = [(number(row, "tip_x_mm"), -number(row, "tip_y_mm")) for row in rows]
            angles = [(0.5 * (a[1] + b[1]), math.degrees(math.atan2(b[1] - a[1], b[0] - a[0]))) for a, b in zip(points, points[1:])]
            kinked = next((row for row in rows if row["jump"]), None)
            end = math.inf if kinked is None else -number(kinked, "tip_y_mm")

            def angle_at(depth):
                pair = next(((a, b) for a, b in zip(angles, angles[1:]) if a[0] <= depth <= b[0] and b[0] <= end), None)
                if pair is None:
                    return math.nan
                (d0, a0), (d1, a1) = pair
                return a0 + (a1 - a0) * (depth - d0) / (d1 - d0)

            steep = next((depth for depth, angle in angles if angle >= 45.0 and depth <= end), math.nan)
            kink = (math.nan, math.nan) if kinked is None else (end, number(kinked, "turn_deg"))
            table.write(wheel, faces, length, angle_at(2.0), angle_at(3.0), steep, *kink)


def kink_friction(program):
    """Friction between the faces of the virtual kinks."""
    about = "Friction of virtual kinks: the head check to 5.5 mm, by turning length (mm) or with whole kinks and their increment"
    table = Table("kink_friction", about, "kink_friction,turning,first_kink_deg,axles,tip_x_mm,tip_depth_mm")
    for friction in [0.0, 0.03, 0.1, 0.3]:
        for turning in ["inf", "0.5", "0.16", "kink 8 %", "kink 2 %", "kink 0.5 %"]:
            if turning.startswith("kink"):
                words = dict(turning="kink", increment=0.01 * float(turning.split()[1]))
            else:
                words = dict(turning_length_mm=Raw(turning), tolerance=0.001)
            rows = program.tip(HEAD_CHECK, kink_friction=friction, **words)
            table.write(friction, turning, number(rows[0], "kink_angle_deg"), *at_length(rows, 5.5))
    about = "Friction of virtual kinks: a crack at 25 degrees from a depth of 0.5 mm, depth and angle of its first kink"
    table = Table("kink_friction_track", about, "wheel,faces,kink_friction,turning_length_mm,angle_at_kink_deg,kink_depth_mm,kink_deg,axles_to_kink")
    for wheel, faces in [(0.3, 0.3), (0.4, 0.3), (0.3, 0.1), (0.2, 0.1), (0.3, 0.5)]:
        for friction in [0.0, 0.1, 0.3]:
            for length in ["0.16", "0.5", "2"]:
                law = {"paris_c": 2e-11, "arrest_rate_mm_per_cycle": 1e-30}
                start = 0.5 / math.sin(math.radians(25.0))
                case = dict(wheel=wheel, length=start, angle=25.0, faces=faces, law=law, until=16.0)
                rows = program.tip(case, kink_friction=friction, turning_length_mm=Raw(length))
                k = next((k for k, row in enumerate(rows) if row["jump"]), None)
                if k is None or k == 0:
                    table.write(wheel, faces, friction, length, math.nan, math.nan, math.nan, math.nan)
                    continue
                a, b = rows[k - 1], rows[k]
                dx, dy = (number(b, name) - number(a, name) for name in ("tip_x_mm", "tip_y_mm"))
                angle = math.degrees(math.atan2(-dy, dx))
                table.write(wheel, faces, friction, length, angle, -number(b, "tip_y_mm"), number(b, "turn_deg"), number(b, "load_cycles"))


def fracture(program):
    """Criteria of fracture."""
    about = "A rail with K_Ic = 29 MPa sqrt(m): fracture by criterion and pop_in_mm; pop-ins until then, their step and axles"
    table = Table("fracture", about, "wheel,faces,angle_deg,length_mm,criterion,pop_in_mm,stop,stop_length_mm,axles,pop_ins,axles_at_pop_ins")
    cracks = [(0.4, 0.1, 20.0, 4.4), (0.4, 0.05, 20.0, 4.4), (0.4, 0.1, 30.0, 6.0)]
    for wheel, faces, angle, length in cracks:
        for criterion, pop_in in [("k1", ""), ("arrest", 1.0), ("arrest", 2.0), ("arrest", 4.0)]:
            more = f'[fracture]\ntoughness_mpa_sqrt_m = 29.0\ncriterion = "{criterion}"\n'
            more += f"pop_in_mm = {pop_in}\n" if pop_in else ""
            case = dict(wheel=wheel, length=length, angle=angle, faces=faces, law={"paris_c": 2e-11}, until=8.4)
            rows = program.tip(case, more=more)
            pops = [f"{number(row, 'load_cycles'):.6g}" for row in rows if row["jump"] == "pop-in"]
            end = rows[-1]
            cells = (end["stop"], number(end, "length_mm"), number(end, "load_cycles"), len(pops), "; ".join(pops))
            table.write(wheel, faces, angle, length, criterion, pop_in, *cells)


def states(program):
    """Best kinks of straight cracks over frictions and depths."""
    about = "Best kink of a straight crack at 25 degrees by max-rate, by wheel-rail and crack-face friction and depth"
    table = Table("states", about, "wheel,faces,depth_mm,kink_deg,rival_deg,rival_ratio,delta_ki,delta_kii")
    names = ("kink_angle_deg", "rival_angle_deg", "rival_ratio", "delta_ki_mpa_sqrt_m", "delta_kii_mpa_sqrt_m")
    for wheel in [0.1, 0.2, 0.3, 0.4]:
        for faces in [0.1, 0.3, 0.5]:
            for depth in [0.5, 1.0, 2.0, 3.0, 5.0]:
                length = depth / math.sin(math.radians(25.0))
                case = dict(wheel=wheel, length=length, angle=25.0, faces=faces, law={}, until=100.0)
                row = program.tip(case, steps=0)[0]
                table.write(wheel, faces, depth, *(number(row, name) for name in names))


def removal(program):
    """Traffic with wear and grinding, over the increment."""
    about = "The head check with axles of 20 t, MGT to 5 mm, by increment or tolerance: wear and grinding"
    table = Table("removal", about, "maintenance,control,value,mgt,tip_x_mm,tip_depth_mm,stop")
    plans = {
        "none": "",
        "wear 0.005 mm/MGT": "[maintenance]\nwear_mm_per_mgt = 0.005\n",
        "0.1 mm every 20 MGT": "[maintenance]\ngrinding_mm = 0.1\ngrinding_interval_mgt = 20.0\n",
        "0.2 mm every 20 MGT": "[maintenance]\ngrinding_mm = 0.2\ngrinding_interval_mgt = 20.0\n",
    }
    case = {**HEAD_CHECK, "until": 5.0, "law": {"paris_c": 2e-11, "arrest_rate_mm_per_cycle": 1e-12}}
    for name, plan in plans.items():
        controls = [("increment", value) for value in INCREMENTS[:6]] + [("tolerance", value) for value in (0.05, 0.01, 0.001)]
        for control, value in controls:
            rows = program.tip(case, more="[traffic]\naxle_load_t = 20.0\n" + plan, **{control: value})
            end = rows[-1]
            cells = (number(end, "mgt"), number(end, "tip_x_mm"), -number(end, "tip_y_mm"), end["stop"])
            table.write(name, control, value, *cells)


# The curves of the paper with paths: differences from its Table 1.
CURVES = {
    "reference": {},
    **{f"wheel{wheel:+g}": {"wheel": wheel} for wheel in (0.1, 0.4, -0.025, -0.1, -0.4)},
    **{f"faces-{faces:g}": {"faces": faces} for faces in (0.1, 0.2, 0.8)},
    **{f"angle-{angle:g}": {"angle": angle} for angle in (30.0, 45.0, 60.0, 75.0)},
    "stress": {"stress": True},
}
STRESS = '[residual_stress]\nprofile = "fig21.csv"\n'
# Lengths of the paper's paths at their ends, mm: after 25 and 15 increments of 4 %, and after three.
SINGLE, PAIR, THREE = (6.0 * 1.04**n for n in (25, 15, 3))
ONE = 6.0 * 0.04


PAIRED = [dict(mouth=0.0, length=6.0, angle=15.0, faces=0.5), dict(mouth=-1.0, length=6.0, angle=165.0, faces=0.5)]


class Shape:
    """A path in the words of the paper (validation/paper/src/path_shape.rs), with lengths instead
    of numbers of increments."""

    def __init__(self, rows, angle):
        self.rows = rows
        points = []
        for row in rows:
            point = (number(row, "tip_x_mm"), -number(row, "tip_y_mm"))
            if not points or math.dist(point, points[-1]) > 1e-9:
                points.append(point)
        first = (math.cos(math.radians(angle)), math.sin(math.radians(angle)))
        self.side, self.grown, self.after, self.along = None, math.inf, math.nan, 0.0
        self.depth = points[-1][1]
        self.moved = len(points) > 1
        length = 0.0
        for a, b in zip(points, points[1:]):
            way = (b[0] - a[0], b[1] - a[1])
            turn = math.degrees(math.atan2(first[0] * way[1] - first[1] * way[0], first[0] * way[0] + first[1] * way[1]))
            if abs(turn) > 20.0:
                self.side = "down" if turn * first[0] > 0.0 else "up"
                self.grown = length
                end = points[-1]
                self.after = math.degrees(math.atan2(end[1] - a[1], abs(end[0] - a[0])))
                self.along = end[0] - a[0]
                break
            length += math.hypot(*way)
        keq = "delta_keq_mpa_sqrt_m"
        self.keq = (number(rows[0], keq), number(rows[-1], keq))

    def coplanar(self):
        return self.side is None and self.moved

    def parallel(self):
        return abs(self.after) <= 10.0

    def words(self):
        return "co-planar" if self.side is None else f"{self.side} at {self.grown:.2f} mm"


def not_later(shapes):
    grown = [shape.grown for shape in shapes]
    later = any(b > a + ONE for a, b in zip(grown, grown[1:]))
    return grown[-1] < grown[0] - ONE and not later


def statements(travel, s):
    """The statements of the paper on paths, by the rules of docs/paper.md; `s` has the shapes."""
    way = 1.0 if travel == "along" else -1.0
    braking = [s[name] for name in ("reference", "wheel+0.1", "wheel+0.4")]
    driving = [s[name] for name in ("wheel-0.025", "wheel-0.1", "wheel-0.4")]
    faces = [s[name] for name in ("faces-0.1", "faces-0.2", "reference", "faces-0.8")]
    angles = [s[name] for name in ("reference", "angle-30", "angle-45", "angle-60", "angle-75")]
    down = [shape.after for shape in angles if shape.side == "down"]
    stress, reference, single = s["stress"], s["reference"], s["wheel+0.1"]
    slow = [at_length(shape.rows, 7.0)[0] for shape in (stress, reference)]
    enough = THREE - 6.0 - 1e-6
    yield "5.1-earlier-braking", not_later(braking), braking
    yield "5.1-earlier-driving", not_later(driving), driving
    yield "5.1-sides-caption", braking[2].side == "up" and driving[2].side == "down", [braking[2], driving[2]]
    yield "5.1-sides-conclusion", braking[2].side == "down" and driving[2].side == "up", [braking[2], driving[2]]
    yield "5.2-coplanar-first", all(shape.grown >= enough for shape in faces), faces
    depths = [shape.depth for shape in faces]
    yield "5.2-paths-differ", max(depths) - min(depths) >= 1.0, faces
    yield "5.2-earlier", not_later(faces), faces
    yield "5.2-sides", faces[0].side == "up" and faces[3].side == "down", [faces[0], faces[3]]
    yield "5.3-down", all(shape.side == "down" for shape in angles[:4]), angles[:4]
    yield "5.3-coplanar-75", angles[4].coplanar(), angles[4:]
    yield "6-same-direction", len(down) >= 2 and max(down) - min(down) <= 15.0, angles
    yield "5.4-rate", stress.keq[0] < reference.keq[0] and slow[0] > slow[1], [stress, reference]
    yield "5.4-longer-coplanar", stress.grown > reference.grown + ONE, [stress, reference]
    yield "5.4-up", stress.side == "up" and reference.side == "down", [stress, reference]
    if "pair 1" in s:
        pair = [s["pair 1"], s["pair 2"]]
        yield "5.5.1-parallel", pair[0].parallel(), pair
        yield "5.5.1-coplanar", pair[1].coplanar(), pair
        yield "5.5.1-slower", pair[0].keq[1] < pair[0].keq[0], pair
        yield "5.5.1-deeper", pair[1].depth > pair[0].depth, pair
    yield "5.5.2-single-down", single.grown >= enough and single.side == "down", [single]


def branches(program):
    """Where paths of the paper leave the line of the initial crack."""
    about = "Growth (mm) until a path of whole kinks leaves its line by 20 degrees, cracks along the travel"
    table = Table("branches", about, "curve,increment,side,growth_mm,stop,stop_length_mm")
    for name in ["reference", "wheel+0.1", "wheel-0.4"]:
        for increment in INCREMENTS:
            rows = program.tip({**PAPER, "until": SINGLE, **CURVES[name]}, turning="kink", increment=increment)
            shape = Shape(rows, 15.0)
            end = rows[-1]
            table.write(name, increment, shape.side or "none", shape.grown, end["stop"], number(end, "length_mm"))


def winter(program):
    """The rail of cases/winter-rail.toml."""
    about = "cases/winter-rail.toml: traffic until fracture by control of the increments and by criterion"
    table = Table("winter_rail", about, "control,value,criterion,pop_in_mm,mgt,length_mm,tip_depth_mm,stop")
    text = (root / "cases/winter-rail.toml").read_text()
    text = "\n".join(line for line in text.splitlines() if not line.startswith(("steps", "increment")))
    runs = [("increment", value, "arrest", 2.0) for value in INCREMENTS[:5]]
    runs += [("tolerance", value, "arrest", 2.0) for value in (0.05, 0.01, 0.001)]
    runs += [("tolerance", 0.01, "arrest", 1.0), ("tolerance", 0.01, "arrest", 4.0), ("tolerance", 0.01, "k1", "")]
    for control, value, criterion, pop_in in runs:
        with tempfile.TemporaryDirectory() as folder:
            case, out = pathlib.Path(folder) / "case.toml", pathlib.Path(folder) / "run"
            case.write_text(text)
            command = [program.path, "run", case, "--out", out, "--quiet", "--set", f"growth.{control}={value}"]
            command += ["--set", "growth.steps=3000", "--set", f"fracture.criterion={criterion}"]
            command += ["--set", f"fracture.pop_in_mm={pop_in}"] if pop_in else []
            subprocess.run(command, check=True, capture_output=True)
            end = read(out / "growth.csv")[-1]
        cells = (number(end, "mgt"), number(end, "length_mm"), -number(end, "tip_y_mm"), end["stop"])
        table.write(control, value, criterion, pop_in, *cells)


def paper(program, travels=("along", "against"), sizes=None):
    """The statements of the paper on paths, over the increment."""
    about = "Statements of docs/paper.md on paths in the half-plane, by increment of whole kinks; l: turning length 0.5 mm"
    table = Table("statements", about, "travel,increment,statement,holds,paths")
    stress = [("fig21.csv", (root / "validation/paper/cases/fig21.csv").read_text())]
    for travel in travels:
        for size in sizes or [*INCREMENTS[:-1], "l"]:
            words = {"tolerance": 0.01} if size == "l" else {"turning": "kink", "increment": size}
            shapes = {}
            for name, changes in CURVES.items():
                case = {**PAPER, "until": SINGLE, "along": travel == "along", **changes}
                more = dict(more=STRESS, files=stress) if case.get("stress") else {}
                shapes[name] = Shape(program.tip(case, **more, **words), case["angle"])
            if size == "l" or size >= 0.01:
                case = {**PAPER, "along": travel == "along", "cracks": PAIRED, "until": PAIR}
                for (crack, _), rows in program.rows(case, **words).items():
                    shapes[f"pair {crack}"] = Shape(rows, PAIRED[int(crack) - 1]["angle"])
            for statement, holds, on in statements(travel, shapes):
                table.write(travel, size, statement, "yes" if holds else "no", "; ".join(shape.words() for shape in on))


# What is halved or doubled, one at a time: settings and the engine that they belong to.
FINE = ["passage.positions=961", "passage.step_tolerance=1e-4"]
REFINED = {
    "defaults": ("dislocation", []),
    "positions 241 to 481": ("dislocation", ["passage.positions=481"]),
    "step_tolerance 0.002 to 0.001": ("dislocation", ["passage.step_tolerance=1e-3"]),
    "passage_tolerance 0.001 to 0.0005": ("dislocation", ["passage.passage_tolerance=5e-4"]),
    "interface_elements 28 to 56": ("dislocation", ["mesh.interface_elements=56"]),
    "tolerance 0.01 to 0.005": ("dislocation", ["growth.tolerance=0.005"]),
    "tolerance 0.01 to 0.001": ("dislocation", ["growth.tolerance=0.001"]),
    "increment 0.02": ("dislocation", ["growth.increment=0.02"]),
    "increment 0.01": ("dislocation", ["growth.increment=0.01"]),
    "xfem": ("xfem", []),
    "xfem, half the elements": ("xfem", ["mesh.element_size_mm={size:.6g}"]),
}
# A head check of 4 mm at 30 degrees, ground by 0.2 mm every 20 million gross tonnes.
GROUND = """[traffic]
axle_load_t = 20.0
[maintenance]
wear_mm_per_mgt = 0.002
grinding_mm = 0.2
grinding_interval_mgt = 20.0
[inspection]
detectable_depth_mm = 2.1
critical_depth_mm = 3.0
"""


def halving(program):
    """Every numerical parameter against the life."""
    about = "Life with refined numerical parameters; change: of the life against the defaults of the engine, estimated: by the program"
    table = Table("halving", about, "case,refined,steps,life,unit,change,estimated")
    ground = {**HEAD_CHECK, "until": 100.0, "law": {"paris_c": 2e-11, "arrest_rate_mm_per_cycle": 1e-12, "stop_after_cycles": 1.2e7}}
    for name, case, more in [("head check", HEAD_CHECK, ""), ("Table 1", PAPER, ""), ("grinding", ground, GROUND)]:
        base = {}
        for refined, (engine, sets) in REFINED.items():
            if engine == "xfem" and more:
                continue
            # By default the 75th part of a kinked crack; here half of that of the first one.
            sets = [key.format(size=case["length"] / 150.0) for key in sets]
            rows = program.tip(case, engine=engine, more=more, sets=sets)
            life, estimated = number(rows[-1], "load_cycles"), number(rows[-1], "load_cycles_error")
            unit = "axles"
            if more:
                life, estimated, unit = program.failure["mgt"], program.failure["mgt_error"], "MGT"
            first = base.setdefault(engine, life)
            table.write(name, refined, len(rows) - 1, life, unit, life / first - 1.0, estimated / life)


def orders(program):
    """Order of the life and of the tip in the increment, with fine passages."""
    about = "The head check to 5.5 mm with 961 positions and a step_tolerance of 1e-4, by turning length (mm) and increment"
    table = Table("orders", about, "turning_length_mm,increment,axles,tip_x_mm,tip_depth_mm")
    for length in ["inf", "0.5", "0.16", "0"]:
        for increment in INCREMENTS:
            rows = program.tip(HEAD_CHECK, turning_length_mm=Raw(length), increment=increment, sets=FINE)
            table.write(length, increment, *at_length(rows, 5.5))


PARTS = dict(
    increments=increments,
    convergence=convergence,
    halving=halving,
    orders=orders,
    tolerance=tolerance,
    criteria=criteria,
    first_kinks=depths,
    paths=paths,
    track=track,
    states=states,
    removal=removal,
    kink_friction=kink_friction,
    fracture=fracture,
    winter_rail=winter,
    statements=paper,
    branches=branches,
)


def draw():
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.fonttype"] = "none"
    matplotlib.rcParams["svg.hashsalt"] = "railcrack"
    import matplotlib.pyplot as plt
    import matplotlib.ticker

    def save(figure, name):
        figure.savefig(root / f"docs/figures/{name}.svg", metadata={"Date": None, "Creator": None})

    rows = read(tables / "increments.csv")
    figure, axes = plt.subplots(1, 2, figsize=(9, 4.2), constrained_layout=True)
    looks = dict(zip(CASES, [("#0072b2", "o"), ("#d55e00", "s"), ("#009e73", "^"), ("#cc79a7", "D")]))
    for name, (colour, mark) in looks.items():
        own = {turning: [r for r in rows if r["case"] == name and r["turning"] == turning] for turning in ("kink", "smooth")}
        unit = number(own["smooth"][-1], "axles")
        for turning, dash in [("kink", "--"), ("smooth", "-")]:
            x = [100.0 * number(r, "increment") for r in own[turning]]
            fill = dict(markerfacecolor="white") if turning == "kink" else {}
            look = dict(color=colour, marker=mark, linestyle=dash, markersize=5, **fill)
            label = f"{name}, {'whole kinks' if turning == 'kink' else 'ℓ = 0.5 mm'}"
            axes[0].plot(x, [number(r, "tip_depth_mm") for r in own[turning]], label=label, **look)
            axes[1].plot(x, [number(r, "axles") / unit for r in own[turning]], **look)
    for axis in axes:
        axis.set_xscale("log")
        axis.invert_xaxis()
        axis.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
        axis.set_xticks([100.0 * value for value in INCREMENTS], [f"{100.0 * value:g}" for value in INCREMENTS])
        axis.set_xlabel("increment, % of the length")
        axis.grid(True, which="major", color="#e4e4e4")
    axes[0].set_ylabel("depth of the tip, mm")
    axes[1].set_ylabel("life over that with ℓ = 0.5 mm at 0.25 %")
    axes[1].set_yscale("log")
    axes[1].yaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    axes[1].set_yticks([0.5, 1, 2, 5, 10, 20], ["0.5", "1", "2", "5", "10", "20"])
    figure.legend(fontsize=8, loc="outside lower center", ncols=2)
    save(figure, "path-increments")

    rows = read(tables / "paths.csv")
    figure, axis = plt.subplots(figsize=(7, 4.4), constrained_layout=True)
    colours = dict(zip(LENGTHS, ["#000000", "#56b4e9", "#0072b2", "#009e73", "#d55e00"]))
    for turning in dict.fromkeys(r["turning"] for r in rows):
        own = [r for r in rows if r["turning"] == turning]
        points = [number(r, "x_mm") for r in own], [number(r, "depth_mm") for r in own]
        if turning in colours:
            words = {"inf": "ℓ = ∞, straight ahead", "0": "ℓ = 0, limit path"}.get(turning, f"ℓ = {turning} mm")
            axis.plot(*points, color=colours[turning], label=words)
        else:
            axis.plot(*points, color="#888888", linewidth=1.0, linestyle="--")
            axis.annotate(turning, (points[0][-1], points[1][-1]), fontsize=7, color="#555555", textcoords="offset points", xytext=(3, -6))
    axis.set_xlabel("x, mm")
    axis.set_ylabel("depth, mm")
    axis.set_aspect("equal")
    axis.set_xlim(2.4, 7.8)
    axis.set_ylim(6.2, 1.2)
    axis.grid(True, color="#e4e4e4")
    axis.legend(fontsize=8, loc="upper right")
    save(figure, "path-turning")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        for part in sys.argv[2:] or PARTS:
            PARTS[part](Program(sys.argv[1]))
    else:
        draw()
