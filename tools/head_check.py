"""The head check that rate_over_depth.py and parameters_tornado.py vary: its case, its run, the table of its growth."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent

ANGLE = 25.0
AXLE = 18.0

# Residual stress of a running surface over the stress below it: balanced, of the kind that is measured.
PROFILE = "depth_mm,sxx_mpa\n0,{0}\n2,{0}\n8,{1}\n20,{1}\n60,0\n"
RESIDUAL = "[residual_stress]\nprofile = \"residual.csv\"\n"


def hertz(friction=0.2, pressure=1000.0, half_width=6.0):
    return f"peak_pressure_mpa = {pressure}\nhalf_width_mm = {half_width}\nfriction = {friction}"


def crack(length, faces, more=""):
    return f"[[crack]]\nmouth_mm = 0.0\nlength_mm = {length}\nangle_deg = {ANGLE}\nfriction = {faces}\n{more}"


def plane(contact, cracks, growth, elements, more=""):
    """A case in the plane, with the lines of [contact], [[crack]] and [growth], and further sections."""
    return f"""
[contact]
{contact}
[passage]
positions = 121
{cracks}
[growth]
{growth}
[mesh]
interface_elements = {elements}
[solver]
engine = "dislocation"
[traffic]
axle_load_t = {AXLE}
[output]
faces = "none"
plots = false
report = false
{more}
"""


def grown(program, text, folder, residual, settings=()):
    """The rows of growth.csv of a case whose profile of residual stress is `residual` (MPa, MPa); none of a refused one."""
    (folder / "case.toml").write_text(text)
    (folder / "residual.csv").write_text(PROFILE.format(*residual))
    line = [program, "run", "case.toml", "--out", "out", "--force", "--quiet"]
    for setting in settings:
        line += ["--set", setting]
    done = subprocess.run(line, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        print(*settings, done.stderr, file=sys.stderr)
        return None
    with open(folder / "out/growth.csv") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def summary(program, text, settings=()):
    """summary.json of the case `text`, which runs in a folder of its own; ends the program where there is none."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "case.toml").write_text(text)
        line = [program, "run", "case.toml", "--out", "out", "--quiet"]
        for setting in settings:
            line += ["--set", setting]
        done = subprocess.run(line, cwd=folder, capture_output=True, text=True)
        found = folder / "out/summary.json"
        return json.loads(found.read_text()) if found.exists() else sys.exit(done.stderr)


def plots():
    """matplotlib.pyplot without a display, whose SVG is the same for the same numbers."""
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "railcrack"
    import matplotlib.pyplot
    return matplotlib.pyplot
