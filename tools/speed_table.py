"""Processor time, wall time and memory of the jobs that docs/dev/speed.md lists, one after the other.

python3 tools/speed_table.py RAILCRACK prints the rows of its table; names of jobs behind the program choose some
of them. Nothing else should run.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import time

from head_check import root

CASES = root / "cases"
QUIET = ["--quiet"]
# The head check of the tutorial, and what differs in other jobs.
HEAD_CHECK = ["run", "head-check.toml", *QUIET]
STRIP = ["--set", "contact.lateral=strip"]
ONE_THREAD = ["--threads", "1"]

JOBS = {
    "reference case, 25 increments, X-FEM": ["run", CASES / "reference.toml", *QUIET],
    "the same with dislocations": ["run", CASES / "reference.toml", *QUIET, "--engine", "dislocation"],
    "nine cracks, X-FEM, one increment": [
        "run", CASES / "network-nine.toml", *QUIET, "--engine", "xfem", "--steps", "1",
    ],
    "a hundred cracks in groups, one increment": ["run", CASES / "head-check-field.toml", *QUIET, "--steps", "1"],
    "fifteen cracks under a mix of wheels, one increment": [
        "run", CASES / "head-checks-in-a-curve.toml", *QUIET, "--steps", "1",
    ],
    "one crack of it with its decision": [
        "run", CASES / "head-checks-in-a-curve.toml", *QUIET, "--set", "crack.count=1",
    ],
    "head check of the tutorial, whole life": HEAD_CHECK,
    "the same, first increment, one thread": [*HEAD_CHECK, "--steps", "1", *ONE_THREAD],
    "the same under a line contact, whole life": [*HEAD_CHECK, *STRIP],
    "straight ahead, whole life, one thread": [*HEAD_CHECK, *ONE_THREAD, "--set", "growth.direction=coplanar"],
    "the same under a line contact, one thread": [
        *HEAD_CHECK, *ONE_THREAD, "--set", "growth.direction=coplanar", *STRIP,
    ],
    "study of 100 of the head check": ["sweep", "study.toml", *QUIET],
    "the same under a line contact (100)": ["sweep", "study.toml", *QUIET, *STRIP],
    "plan of twelve for the head check of the tutorial": [
        "plan", "plan.toml", *QUIET, "--grinding", "0.1,0.2,0.3", "--interval", "10,20,30,40",
    ],
    "plan of twelve for one crack of the curve": [
        "plan", CASES / "head-checks-in-a-curve.toml", *QUIET, "--set", "crack.count=1",
    ],
    "head check in space, two increments": ["run", CASES / "head-check-space.toml", *QUIET, "--steps", "2"],
    "`validate --no-space`": ["validate", "--no-space", "--quiet"],
}


def prepare(place):
    """The cases of the jobs that are not shipped."""
    text = (root / "docs/tutorial.md").read_text().split("# head-check.toml\n")[1].split("```")[0]
    (place / "head-check.toml").write_text(text)
    study = text.replace("friction = 0.3 ", "friction = { uniform = [0.1, 0.4] } ")
    (place / "study.toml").write_text(study + "\n[study]\nsamples = 100\n")
    (place / "plan.toml").write_text(text + "\n[maintenance]\nwear_mm_per_mgt = 0.002\n")


def measured(command, place):
    """Processor and wall time (s) and the largest memory (MB) of a command."""
    begun = time.monotonic()
    child = subprocess.Popen(command, cwd=place, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    message = child.stderr.read().decode()
    _, status, usage = os.wait4(child.pid, 0)
    if os.waitstatus_to_exitcode(status) not in (0, 3):
        sys.exit(f"{command}: {message}")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - begun, usage.ru_maxrss / 1024.0


def digits(value):
    """Two digits."""
    return f"{value:.2g}" if value < 10 else f"{value:.0f}"


def main(program, names):
    program = pathlib.Path(program).resolve()
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        prepare(place)
        print("| job | processor time, s | wall time, s | memory, MB |\n|---|---|---|---|")
        for number, (name, arguments) in enumerate(JOBS.items()):
            if names and name not in names:
                continue
            command = [program, *map(str, arguments), "--out"]
            rounds = [measured([*command, f"{number}-0"], place)]
            while rounds[0][1] < 5.0 and len(rounds) < 3:
                rounds.append(measured([*command, f"{number}-{len(rounds)}"], place))
            processor, wall, memory = min(rounds)
            print(f"| {name} | {digits(processor)} | {digits(wall)} | {memory:.0f} |", flush=True)


main(sys.argv[1], sys.argv[2:])
