"""The problems of benchmark/ computed by the engines of railcrack and scored.

    tools/benchmark_check.py RAILCRACK [PROBLEM ...]           compare with benchmark/differences.csv
    tools/benchmark_check.py RAILCRACK --write [PROBLEM ...]   write that table
    tools/benchmark_check.py RAILCRACK --fine [PROBLEM ...]    the differences by fine elements and load steps
    tools/benchmark_check.py RAILCRACK --solve PROBLEM ...     write solution.csv by fine elements
    tools/benchmark_check.py --case PROBLEM PART [ENGINE]      print the case file of a part

Every case file is made from problem.toml, so that what is computed is what is published. A difference is the largest
over all positions, in per cent of the peak, and has a bound; ends with 1 where one is exceeded. Problems are
named by their numbers.
"""

import csv
import importlib.util
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "benchmark"
TABLE = FOLDER / "differences.csv"

spec = importlib.util.spec_from_file_location("scorer", ROOT / "python/railcrack/benchmark.py")
scorer = importlib.util.module_from_spec(spec)
sys.modules["scorer"] = scorer
spec.loader.exec_module(scorer)

# Per cent of the peak: what is promised of the engines of the plane, what space reaches with its default cells, and the error of the plastic state.
PLANE, SPACE, STATE = 1.0, 2.0, 3.0
QUIET = '[output]\nfaces = "none"\nfields = false\nplots = false\nreport = false\n'
# Discretisation: the default one for the check, and a finer one for solutions.
MESH = {
    "usual": {},
    "fine": {
        "dislocation": "interface_elements = 112\n",
        "xfem": "element_size_mm = 0.05\n",
        "space": "space_cells = 8\nspace_rings = 8\n",
    },
}


def engines(part):
    """Engines that can take a part, each with its bound."""
    of_body = {
        "half-plane": {"dislocation": PLANE, "xfem": PLANE},
        "block": {"xfem": PLANE},
        "half-space": {"space": SPACE},
        "plastic half-plane": {"shakedown": STATE},
        "sites": {"calibrate": PLANE},
    }
    return of_body[part["body"]]


# ---- A case from the data of a problem. ----


def crack_of(crack, friction):
    """A section [[crack]]."""
    lines = ["[[crack]]", f"friction = {friction}"]
    if "segments_mm_deg" in crack:
        points = [[crack["mouth_x_mm"], 0.0]]
        for length, angle in crack["segments_mm_deg"]:
            (x, y), turn = points[-1], math.radians(angle)
            points.append([x + length * math.cos(turn), y - length * math.sin(turn)])
        if len(points) == 2:
            length, angle = crack["segments_mm_deg"][0]
            lines += [f"mouth_mm = {crack['mouth_x_mm']}", f"length_mm = {length}", f"angle_deg = {angle}"]
        else:
            lines.append(f"points_mm = {points}")
        return lines
    half, along = crack["semi_axis_dip_mm"], crack["semi_axis_strike_mm"]
    dip = math.radians(crack["dip_deg"])
    lines += [f"surface_half_length_mm = {along}", f"strike_deg = {crack.get('strike_deg', 0.0)}"]
    if "centre_depth_mm" in crack:
        ends = [[s * half * math.cos(dip), -crack["centre_depth_mm"] - s * half * math.sin(dip)] for s in (-1, 1)]
        lines.append(f"points_mm = {ends}")
    else:
        lines += ["mouth_mm = 0.0", f"length_mm = {half}", f"angle_deg = {crack['dip_deg']}"]
    return lines


def case_of(the, part, engine, mesh="usual"):
    """The case file of a part, and the files that it names, with a mesh of `MESH`."""
    files = {}
    elastic = the.data["elasticity"]
    lines = [f"title = \"{the.name}, {part['name']}\"", "[rail]"]
    lines += [f"young_modulus_mpa = {elastic['young_modulus_mpa']}", f"poisson_ratio = {elastic['poisson_ratio']}"]
    if part["body"] == "block":
        lines += ['boundary = "block"', f"width_mm = {part['block_width_mm']}", f"depth_mm = {part['block_depth_mm']}"]
        lines += [f"bottom = \"{part['block_bottom']}\"", f"sides = \"{part['block_sides']}\""]
    if any("centre_depth_mm" in crack for crack in part.get("cracks", [])):
        lines += ["width_mm = 10000.0", "depth_mm = 4000.0"]
    tension = part.get("tension_mpa")
    stress = part.get("stress_xx_mpa_by_depth_mm", [[0.0, tension], [5000.0, tension]] if tension else None)
    wheel = part.get("peak_pressure_mpa", 0.001)
    lines += ["[contact]", f"peak_pressure_mpa = {wheel}", f"half_width_mm = {part.get('half_width_mm', 1.0)}"]
    lines.append(f"friction = {part.get('contact_friction', 0.0)}")
    if "lateral_half_width_mm" in part:
        lines.append(f"lateral_half_width_mm = {part['lateral_half_width_mm']}")
    elif engine == "space":
        lines.append("lateral_half_width_mm = 1.0")
    if part.get("contact_shear") == "carter":
        lines += ['kind = "carter"', f"traction = {part['traction_ratio']}"]
    if part.get("wheel_follows_cracks"):
        lines += ["coupled = true", f"coupled_within_over_a = {part['coupled_within_over_a']}"]
    if stress:
        lines += ["[residual_stress]", 'profile = "stress.csv"']
        files["stress.csv"] = "depth_mm,sxx_mpa\n" + "".join(f"{d},{s}\n" for d, s in stress)
    if "positions_over_a" in part:
        start, end, count = part["positions_over_a"]
        a = part["half_width_mm"]
        mouths = [crack["mouth_x_mm"] / a for crack in part["cracks"]]
        lines += ["[passage]", f"from_over_a = {start - min(mouths)}", f"to_over_a = {end - max(mouths)}"]
        lines += [f"positions = {count}", "max_passages = 20"]
        if mesh == "fine":
            lines += ["step_tolerance = 2e-4", "passage_tolerance = 1e-5"]
    else:
        lines += ["[passage]", "from_over_a = 10.0", "to_over_a = 11.0", "positions = 2"]
    for crack in part.get("cracks", [{"mouth_x_mm": 0.0, "segments_mm_deg": [[6.0, 15.0]]}]):
        lines += crack_of(crack, part.get("face_friction", 0.0))
    fluid = part.get("fluid", "none")
    if fluid != "none":
        lines += ["[fluid]", f'model = "{fluid}"']
        if fluid == "mouth":
            lines += [f"pressure_cap_mpa = {part['pressure_cap_mpa']}", f"profile = \"{part['pressure_profile']}\""]
        else:
            leak = "true" if part["leak"] else "false"
            lines += [f"bulk_modulus_mpa = {part['bulk_modulus_mpa']}", f"leak = {leak}"]
    lines.append("[growth]")
    if "growth_c" in part:
        lines += [f"paris_c = {part['growth_c']}", f"paris_m = {part['growth_m']}"]
        lines += [f"mode_2_weight = {part['mode_2_weight']}", f"turning_length_mm = {part['turning_length_mm']}"]
        lines += [f"critical_length_mm = {part['final_length_mm'] + 0.1}", "steps = 1000"]
        lines += ["increment = 0.005"] if mesh == "fine" else []
    else:
        lines.append("steps = 0")
    if part["body"] == "plastic half-plane":
        lines += ["[shakedown]", f"yield_stress_mpa = {part['yield_stress_mpa']}"]
        lines.append(f"hardening_modulus_mpa = {part['hardening_modulus_mpa']}")
    if engine in ("dislocation", "xfem", "space"):
        lines += ["[solver]", f'engine = "{engine}"', "[mesh]"]
    if engine == "space" and mesh == "usual" and "positions_over_a" in part:
        # A shallow crack under a wheel needs more than the default cells.
        lines += ["space_cells = 6", "space_rings = 6"]
    return "\n".join(lines) + "\n" + MESH[mesh].get(engine, "") + QUIET, files


# ---- A result of railcrack in the columns of a problem. ----


def rows_of(path):
    """Rows of a table of railcrack."""
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def computed(railcrack, the, part, engine, folder, mesh="usual"):
    """Rows of a part in the columns of the problem."""
    if engine == "calibrate":
        return calibrated(railcrack, the, part, folder)
    text, files = case_of(the, part, engine, mesh)
    folder.mkdir(parents=True)
    for name, content in files.items():
        (folder / name).write_text(content)
    (folder / "case.toml").write_text(text)
    command = "shakedown" if engine == "shakedown" else "run"
    line = [railcrack, command, str(folder / "case.toml"), "--out", str(folder / "out"), "--quiet"]
    subprocess.run(line, check=True, stdout=subprocess.DEVNULL)
    if engine == "shakedown":
        return from_profile(rows_of(folder / "out/profile.csv"), the, part)
    if "growth_c" in part:
        return from_growth(rows_of(folder / "out/growth.csv"), the, part)
    return from_sif(rows_of(folder / "out/sif.csv"), the, part)


def from_sif(rows, the, part):
    """K of the stabilised passage, at the front points of the solution where there is a front."""
    last = max(int(row["passage"]) for row in rows)
    rows = [row for row in rows if int(row["passage"]) == last]
    result = []
    if "phi_deg" not in rows[0]:
        if "positions_over_a" not in part:
            rows = [{**rows[0], "xc_over_a": "0"}]
        return [{"part": part["name"], **row} for row in rows]
    # The points of a front, at each position of the wheel a trigonometric polynomial through them.
    by_position = {}
    for row in rows:
        by_position.setdefault(row["position"], []).append(row)
    if "positions_over_a" not in part:
        by_position = {"1": by_position["1"]}
    columns = [name for name in the.values if name in rows[0]]
    angles = part.get("phi_deg") or [x for x, _ in the.solution[(part["name"],), columns[0]]]
    for front in by_position.values():
        points = sorted((float(row["phi_deg"]), row) for row in front)
        for angle in angles:
            values = {name: str(along_front([(p, float(row[name])) for p, row in points], angle)) for name in columns}
            result.append({"part": part["name"], "phi_deg": f"{angle:g}", "xc_over_a": front[0]["xc_over_a"], **values})
    return result


def along_front(points, angle):
    """A value between the points of a front, by Lagrange's polynomial through the four nearest."""
    near = sorted(points, key=lambda point: abs(point[0] - angle))[:4]
    total = 0.0
    for i, (x, y) in enumerate(near):
        weight = 1.0
        for j, (other, _) in enumerate(near):
            if i != j:
                weight *= (angle - other) / (x - other)
        total += weight * y
    return total


def from_growth(rows, the, part):
    """Cycles and place of the tip over the length."""
    names = {"load_cycles": "load_cycles", "tip_x_mm": "tip_x_mm", "tip_depth_mm": "tip_y_mm"}
    start, end, count = part["lengths_mm"]
    lengths = [start + (end - start) * i / (count - 1) for i in range(count)]
    table = [(float(row["length_mm"]), row) for row in rows]
    result = []
    for length in lengths:
        row = {"part": part["name"], "length_mm": f"{length:.6g}"}
        for name, column in names.items():
            sign = -1.0 if column == "tip_y_mm" else 1.0
            row[name] = repr(sign * along_front([(x, float(r[column])) for x, r in table], length))
        result.append(row)
    return result


def from_profile(rows, the, part):
    """Residual stress over depth."""
    return [{"part": part["name"], **row} for row in rows]


def calibrated(railcrack, the, part, folder):
    """Mean and standard deviation by `railcrack calibrate`: its sites have the readings of the problem, as sizes on the path of
    a run."""
    folder.mkdir(parents=True)
    text = (
        "[contact]\npeak_pressure_mpa = 1000.0\nhalf_width_mm = 6.0\nfriction = 0.3\n[[crack]]\nmouth_mm = 0.0\n"
        "length_mm = 4.0\nangle_deg = 30.0\nfriction = 0.3\n[growth]\nsteps = 40\nincrement = 0.01\nturning_length_mm = inf\n"
        '[traffic]\naxle_load_t = 20.0\n[solver]\nengine = "dislocation"\n[calibration]\n'
        f"prior_log_mean = {part['prior_mean']}\nprior_log_std = {part['prior_sd']}\n"
        f"discrepancy_log_std = {part['site_sd']}\n" + QUIET
    )
    case = folder / "case.toml"
    case.write_text(text)
    subprocess.run([railcrack, "run", case, "--out", folder / "run", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    path = [(float(row["mgt"]), float(row["depth_mm"])) for row in rows_of(folder / "run/growth.csv")]
    line = [railcrack, "calibrate", case, "--out", folder / "out", "--quiet"]
    for site, readings in enumerate(part["sites"]):
        rows = ["mgt,depth_mm,std_mm"]
        for i, (y, sigma) in enumerate(readings):
            # Readings lie well within the path, at points that the run has computed.
            j = 15 + 4 * i
            (before, shallower), (mgt, depth), (after, deeper) = path[j - 1 : j + 2]
            slope = math.log(after / before) / (deeper - shallower)
            rows.append(f"{mgt * math.exp(-y)!r},{depth!r},{sigma / slope!r}")
        table = folder / f"site-{site}.csv"
        table.write_text("\n".join(rows) + "\n")
        line += ["--measured", table]
    subprocess.run(line, check=True, stdout=subprocess.DEVNULL)
    fit = json.loads((folder / "out/calibration.json").read_text())
    return [{"part": part["name"], **{name: repr(value) for name, value in posterior(fit).items()}}]


def posterior(fit):
    """Numbers of the posterior that `railcrack calibrate` writes; it widens that of a new site for the small number of sites."""
    return {"mean": fit["log_mean"], "sd": fit["log_std"]}


# ---- The check. ----


def differences(railcrack, numbers, scratch, mesh="usual"):
    """Rows of the table for the problems of the given numbers, all by default."""
    rows = []
    for name in scorer.problems(FOLDER):
        if numbers and name.split("-")[0] not in numbers:
            continue
        the = scorer.problem(FOLDER, name)
        for part in (the.part(p["name"]) for p in the.data["part"]):
            for engine, bound in engines(part).items():
                found = computed(railcrack, the, part, engine, scratch / f"{name}-{part['name']}-{engine}", mesh)
                curves = scorer.curves(found, the.groups, the.along, the.values, name, (part["name"], "1"))
                worst = {}
                for row in scorer.score(the, curves):
                    if row.missing:
                        raise SystemExit(f"{name} {part['name']} {engine}: {row.missing} positions are missing")
                    worst[row.column] = max(worst.get(row.column, 0.0), row.by_position)
                for column, difference in worst.items():
                    if column != scorer.RELEASE:
                        rows.append([name, part["name"], engine, column, f"{difference:.3f}", f"{bound:g}"])
                print(name, part["name"], engine, " ".join(f"{c} {d:.3f} %" for c, d in worst.items()), flush=True)
    return rows


def check(railcrack, numbers, write, scratch):
    """Compares with the table, or writes it."""
    rows = differences(railcrack, numbers, scratch)
    old = {tuple(row[:4]): row for row in csv.reader(open(TABLE, encoding="utf-8"))} if TABLE.exists() else {}
    head = ["problem", "part", "engine", "quantity", "difference_pct", "bound_pct"]
    # A bound that the table has stays, so that one can be set there by hand.
    for row in rows:
        row[5] = old.get(tuple(row[:4]), row)[5]
    if write:
        kept = [row for row in old.values() if row != head and numbers and row[0].split("-")[0] not in numbers]
        with open(TABLE, "w", newline="", encoding="utf-8") as file:
            order = scorer.problems(FOLDER)
            csv.writer(file, lineterminator="\n").writerows([head, *sorted(kept + rows, key=lambda row: order.index(row[0]))])
    failed = 0
    for row in rows:
        if float(row[4]) > float(row[5]):
            failed += 1
            print(f"failed: {' '.join(row[:4])}: {row[4]} % of the peak, at most {row[5]} %")
        elif not write and tuple(row[:4]) not in old:
            failed += 1
            print(f"failed: {' '.join(row[:4])} is not in {TABLE.name}: --write")
    print(f"{len(rows) - failed} passed, {failed} failed")
    return 1 if failed else 0


def solve(railcrack, numbers, scratch):
    """Writes the solutions of problems that have no other source, by the first engine of each part."""
    for number in numbers:
        name = next(n for n in scorer.problems(FOLDER) if n.startswith(number))
        with open(FOLDER / name / "problem.toml", "rb") as file:
            data = scorer.tomllib.load(file)
        the = scorer.Problem(name, FOLDER / name, data, {})
        header = [*the.groups, *([the.along] if the.along else []), *the.values]
        lines = [",".join(header)]
        for part in (the.part(p["name"]) for p in data["part"]):
            engine = next(iter(engines(part)))
            rows = computed(railcrack, the, part, engine, scratch / f"{name}-{part['name']}-fine", "fine")
            for row in rows:
                lines.append(",".join(shortened(row.get(column, "1")) for column in header))
            print(name, part["name"], engine, len(rows), "rows")
        (FOLDER / name / "solution.csv").write_text("\n".join(lines) + "\n")


def shortened(text):
    """A number to six digits, or a name."""
    try:
        value = float(text)
    except ValueError:
        return text
    return f"{value:.6g}" if abs(value) > 5e-7 else "0"


def main(arguments):
    if arguments[:1] == ["--case"]:
        the = scorer.problem(FOLDER, arguments[1])
        part = the.part(arguments[2])
        text, files = case_of(the, part, arguments[3] if len(arguments) > 3 else next(iter(engines(part))))
        print(text, *(f"# {name}\n{content}" for name, content in files.items()), sep="\n")
        return 0
    railcrack = str(pathlib.Path(arguments[0]).resolve())
    options = [a for a in arguments[1:] if a.startswith("--")]
    numbers = [a for a in arguments[1:] if not a.startswith("--")]
    with tempfile.TemporaryDirectory() as scratch:
        if "--fine" in options:
            differences(railcrack, numbers, pathlib.Path(scratch), "fine")
            return 0
        if "--solve" in options:
            solve(railcrack, numbers, pathlib.Path(scratch))
            return 0
        return check(railcrack, numbers, "--write" in options, pathlib.Path(scratch))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
