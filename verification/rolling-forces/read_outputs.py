"""Writes outputs.csv and coarse.csv from the outputs that are published with CONTACT.

    python3 read_outputs.py CONTACT     (a checkout of https://github.com/eve70a/CONTACT)
"""

import math
import re
import sys
from pathlib import Path

COLUMNS = "a_mm,b_mm,normal_n,friction,creepage_x,creepage_y,spin_per_mm,fx_n,fy_n,mz_n_mm"
HERE = Path(__file__).parent


def numbers(line):
    return [float(word) for word in line.split()]


def case(text):
    """Creepages and forces of one case of an output file."""
    kinematic = re.search(r"CHI +DQ +VELOC +CKSI +CETA +CPHI\s*\n(.*)", text)
    forces = re.search(r"FN +FX +FY +MZ.*\n(.*)", text)
    return numbers(kinematic[1])[3:6] + numbers(forces[1])[1:4]


def cases(file, last):
    for text in re.split(r"\n(?= *Case +\d+)", file.read_text(encoding="latin-1")):
        number = re.match(r"\s*Case +(\d+)", text)
        if number and int(number[1]) <= last:
            yield case(text)


def outputs(contact):
    """Ellipses of 1276 to 1384 elements, and one of 363."""
    curve = cases(contact / "examples/tractcurv.ref_out", 30)
    spin = cases(contact / "examples/fastsim.ref_out", 1)
    approach = [next(cases(contact / "testbank/contact_nonhz.ref_out", 1))]
    for patch, found in (
        ((6.304, 12.61, 106700, 0.33), curve),
        ((8, 4, 82000, 0.3), spin),
        ((4.25, 7, 42080, 0.3), approach),
    ):
        for numbers_of_case in found:
            yield *patch, *numbers_of_case


def coarse(contact):
    """A part of the table of src/test_table.f90, of 41 elements each."""
    lines = (contact / "testbank/test_table_mx11.ref_fx").read_text().strip().split("\n")
    normal, friction, axes = 82000.0, 0.3, zip((0.2, 0.5, 1.0, 2.0, 5.0), (4.0, 6.0, 9.0, 12.0, 20.0))
    angles = [angle * math.pi / 6 for angle in (-3, -2, -1, 0, 1, 2, 3)]
    sizes = (0, .1, .2, .3, .4, .5, .7, .9, 1.1, 1.4, 1.7, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9, 10, 12)
    results = iter(lines[5:])
    for (ratio, a), head in zip(axes, lines[:5]):
        radius, c = map(float, re.findall(r"(?:rho|cp)= +([\d.]+)", head))
        for spin in (0.0, 0.5, 1.0, 2.0):
            for angle in angles:
                for size in sizes:
                    fx, fy, mz = map(float, re.findall(r"[xyz]= *([-\d.]+)", next(results)))
                    spin_alone = size == 0 and spin > 0 and angle == 0
                    if not spin_alone and size not in (0.3, 0.7, 1.4, 2.5, 5, 10):
                        continue
                    creep = size * friction * c / radius
                    yield (
                        a, a / ratio, normal, friction, creep * math.cos(angle), creep * math.sin(angle),
                        spin * friction / radius, *(force * friction * normal for force in (fx, fy, mz * c)),
                    )


def write(name, rows):
    lines = [",".join(f"{value:.5g}" for value in row) for row in rows]
    (HERE / name).write_text("\n".join([COLUMNS, *lines]) + "\n")
    print(len(lines), name)


if __name__ == "__main__":
    contact = Path(sys.argv[1])
    write("outputs.csv", outputs(contact))
    write("coarse.csv", coarse(contact))
