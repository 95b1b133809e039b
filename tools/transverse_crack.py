"""From a head check to the broken rail: what decides the turn, and how deep the rail breaks.

python3 tools/transverse_crack.py RAILCRACK computes the tables of verification/transverse-crack
with that program from cases/transverse.toml, with "space" behind it that of the curved front, from
cases/transverse-in-space.toml; without arguments, they are drawn as
docs/figures/transverse-crack.svg. Needs matplotlib for that.
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
tables = root / "verification/transverse-crack"

# Name, what is set, and the sections that are left out.
VARIANTS = [
    ("as in the case", {}, []),
    ("half-plane", {}, ["rail"]),
    ("wheel friction 0.2", {"contact.friction": "0.2"}, []),
    ("wheel friction 0.4", {"contact.friction": "0.4"}, []),
    ("face friction 0.3", {"crack.friction": "0.3"}, []),
    ("face friction 0.7", {"crack.friction": "0.7"}, []),
    ("turning length 0.2 mm", {"growth.turning_length_mm": "0.2"}, []),
    ("turning length 1 mm", {"growth.turning_length_mm": "1.0"}, []),
    ("straight ahead", {"growth.turning_length_mm": "inf"}, []),
    ("40 K below neutral", {"temperature.rail_c": "-15.0"}, []),
    ("20 K below neutral", {"temperature.rail_c": "5.0"}, []),
    ("10 K below neutral", {"temperature.rail_c": "15.0"}, []),
    ("no bending", {}, ["track"]),
    ("residual stress", {}, []),
    ("5 mm long", {"crack.length_mm": "5.0"}, []),
    ("5 mm long, 10 K below neutral", {"crack.length_mm": "5.0", "temperature.rail_c": "15.0"}, []),
    ("5 mm long, residual stress", {"crack.length_mm": "5.0"}, []),
    ("10 mm long", {"crack.length_mm": "10.0"}, []),
    ("10 mm long, residual stress", {"crack.length_mm": "10.0"}, []),
]
RESIDUAL = '\n[residual_stress]\nprofile = "residual-stress.csv"\n'
# Vertical cracks: depths (mm) and temperatures of the rail (degrees C).
DEPTHS = [5, 10, 15, 20, 25, 30]
TEMPERATURES = [5, -5, -15, -25]


def edited(text, values, without):
    """The text of the case with other values, and without some sections."""
    out, section = [], ""
    for line in text.splitlines():
        if line.startswith("["):
            section = line.strip("[] ")
        if section in without:
            continue
        key = f"{section}.{line.split('=')[0].strip()}"
        if key in values:
            line = f"{line.split('=')[0].rstrip()} = {values.pop(key)}"
        out.append(line)
    for key, value in values.items():
        at = out.index(f"[{key.split('.')[0]}]")
        out.insert(at + 1, f"{key.split('.')[1]} = {value}")
    return "\n".join(out) + "\n"


def run(program, folder, name, text):
    case = folder / f"{name}.toml"
    case.write_text(text)
    out = folder / name
    subprocess.run([program, "run", case, "--out", out, "--quiet"], check=True, stdout=subprocess.DEVNULL)
    rows = [line for line in (out / "growth.csv").read_text().splitlines() if not line.startswith("#")]
    return json.loads((out / "summary.json").read_text()), list(csv.DictReader(rows))


def compute(program):
    tables.mkdir(exist_ok=True)
    case = (root / "cases/transverse.toml").read_text()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        profile = (root / "cases/residual-stress.csv").read_text()
        (folder / "residual-stress.csv").write_text(profile)
        stages = [["variant", "turn_mgt", "turn_depth_mm", "turn_length_mm", "end_mgt", "end_depth_mm", "ki_mpa_sqrt_m", "stop"]]
        paths = [["variant", "x_mm", "depth_mm", "mgt", "ki_max_mpa_sqrt_m", "delta_kii_mpa_sqrt_m"]]
        for i, (name, values, without) in enumerate(VARIANTS):
            text = edited(case, dict(values), without)
            if name.endswith("residual stress"):
                text += RESIDUAL
            summary, rows = run(program, folder, f"v{i}", text)
            turned = summary["decision"].get("stages") or {}
            last = rows[-1]
            keys = ["mgt_to_turn", "turn_depth_mm", "turn_length_mm"]
            end = [last[key] for key in ["mgt", "depth_mm", "ki_max_mpa_sqrt_m"]]
            stop = last["stop"] or summary["stop"]
            stages.append([name] + [rounded(turned.get(key, "")) for key in keys] + [rounded(v) for v in end] + [stop])
            print(stages[-1], flush=True)
            columns = ["tip_x_mm", "depth_mm", "mgt", "ki_max_mpa_sqrt_m", "delta_kii_mpa_sqrt_m"]
            paths += [[name] + [rounded(row[key]) for key in columns] for row in rows]
        sizes = [["section", "depth_mm", "rail_c", "ki_max_mpa_sqrt_m", "delta_kii_mpa_sqrt_m"]]
        for section, without in (("60E1", []), ("half-plane", ["rail"])):
            for depth in DEPTHS:
                for rail in TEMPERATURES:
                    values = {"temperature.rail_c": f"{rail}.0", "crack.length_mm": f"{depth}.0"}
                    values |= {"crack.angle_deg": "90.0", "growth.steps": "0"}
                    text = edited(case, values, [*without, "fracture"])
                    _, rows = run(program, folder, f"{section}-{depth}-{rail}", text)
                    keys = ["ki_max_mpa_sqrt_m", "delta_kii_mpa_sqrt_m"]
                    sizes.append([section, depth, rail] + [rounded(rows[0][key]) for key in keys])
    for file, table in (("sizes.csv", sizes), ("stages.csv", stages), ("paths.csv", paths)):
        with open(tables / file, "w", newline="") as out:
            csv.writer(out, lineterminator="\n").writerows(table)


def compute_in_space(program):
    """The deepest point of a branch from folds of two widths, at every step."""
    case = (root / "cases/transverse-in-space.toml").read_text()
    columns = ["mgt", "depth_mm", "length_mm", "surface_half_length_mm", "ki_max_mpa_sqrt_m", "delta_kii_mpa_sqrt_m", "rate_mm_per_cycle"]
    table = [["fold_half_length_mm"] + columns]
    with tempfile.TemporaryDirectory() as temporary:
        for half in (8, 16):
            text = edited(case, {"crack.surface_half_length_mm": f"{half}.0"}, [])
            _, rows = run(program, pathlib.Path(temporary), f"half-{half}", text)
            table += deepest(rows, half, columns)
    with open(tables / "space.csv", "w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows(table)


def deepest(rows, half, columns):
    """Rows of the table: those at the deepest point of the front."""
    return [[half] + [rounded(row[key]) for key in columns] for row in rows if float(row["phi_deg"]) == 90.0]


def rounded(value):
    return f"{float(value):.5g}" if value != "" else ""


def draw():
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "railcrack", "font.size": 9, "svg.fonttype": "none"})
    import matplotlib.pyplot as plt

    rows = list(csv.DictReader(open(tables / "paths.csv")))
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
    for name in ["as in the case", "40 K below neutral", "20 K below neutral", "face friction 0.3", "no bending", "10 mm long", "10 mm long, residual stress"]:
        own = [row for row in rows if row["variant"] == name]
        left.plot([float(r["x_mm"]) for r in own], [float(r["depth_mm"]) for r in own], label=name)
    left.set(xlabel="x of the tip (mm)", ylabel="depth (mm)", ylim=(30, 0))
    left.legend(fontsize=7)
    for name in ["as in the case", "half-plane", "40 K below neutral", "10 mm long, residual stress"]:
        own = [row for row in rows if row["variant"] == name]
        right.plot([float(r["depth_mm"]) for r in own], [float(r["ki_max_mpa_sqrt_m"]) for r in own], label=name)
    right.axhline(29.0, color="grey", linestyle=":")
    right.set(xlabel="depth (mm)", ylabel="largest K_I (MPa√m)", xlim=(0, 31))
    right.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(root / "docs/figures/transverse-crack.svg", metadata={"Date": None})


if __name__ == "__main__":
    if len(sys.argv) == 1:
        draw()
    elif sys.argv[2:] == ["space"]:
        compute_in_space(sys.argv[1])
    else:
        compute(sys.argv[1])
