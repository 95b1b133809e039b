"""A part of problem 03 by CalculiX: mesh and input file, run, K from the jumps.

    python3 crack.py [PART]      writes crack.inp, runs `ccx crack` and writes 03.csv, to be scored

Needs numpy and CalculiX (Debian: calculix-ccx). Quadratic plane-strain elements on a parallelogram
whose columns lie along the crack, penalty contact with friction from face to face, and on the outer sides
the tractions of the uncracked half-plane, so that the crack alone sees the size of the mesh.
"""

import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "numpy"))
from edge_crack import hertz  # noqa: E402

SIZE = 60.0  # mm from the mouth to the sides and to the bottom
PENALTY, STICK = 1e6, 1e5  # MPa/mm


def graded(start, end, first, ratio):
    """Points from start to end, each step longer by `ratio` than the one before."""
    steps = [first]
    while sum(steps) < abs(end - start):
        steps.append(steps[-1] * ratio)
    return start + (end - start) * np.concatenate([[0.0], np.cumsum(steps)]) / sum(steps)


def twice(points):
    """The points with the middles between them."""
    return np.sort(np.concatenate([points, 0.5 * (points[1:] + points[:-1])]))


def mesh(length, angle):
    """Nodes (x, y), elements of eight nodes, and the columns of both faces (mouth to tip)."""
    depth = length * np.sin(np.radians(angle))
    half = graded(0.0, SIZE, 0.1, 1.7)
    across = twice(np.concatenate([-half[:0:-1], half]))
    up = graded(depth, 0.5 * depth, 0.03, 1.6)
    top = graded(0.0, 0.5 * depth, 0.15, 1.5)
    down = twice(np.concatenate([top[:-1], up[::-1], graded(depth, SIZE, 0.03, 1.7)[1:]]))
    crack = len(across) // 2
    tip = int(np.argmin(np.abs(down - depth)))
    number, nodes = {}, []

    def node(i, j, side):
        # Above the tip the column of the crack is there twice.
        key = (i, j, side if i == crack and j < tip else 0)
        if key not in number:
            number[key] = len(nodes) + 1
            nodes.append((across[i] + down[j] / np.tan(np.radians(angle)), -down[j]))
        return number[key]

    elements, sides = [], {"left": [], "right": []}
    for i in range(0, len(across) - 2, 2):
        for j in range(0, len(down) - 2, 2):
            side = 1 if i >= crack else -1
            at = lambda a, b: node(i + a, j + b, side)
            # Counter-clockwise: bottom left, bottom right, top right, top left, then the middles.
            elements.append([at(0, 2), at(2, 2), at(2, 0), at(0, 0), at(1, 2), at(2, 1), at(1, 0), at(0, 1)])
            if j < tip and i == crack:
                sides["right"].append((len(elements), "S4"))
            if j < tip and i + 2 == crack:
                sides["left"].append((len(elements), "S2"))
    faces = [[number[crack, j, side] for j in range(tip)] for side in (1, -1)]
    last_i, last_j = len(across) - 1, len(down) - 1
    border = [[node(i, 0, -1 if i <= crack else 1) for i in range(crack + 1)], [node(i, 0, 1) for i in range(crack, last_i + 1)]]
    border += [[node(i, last_j, 0) for i in range(last_i + 1)][::-1]]
    border += [[node(0, j, -1) for j in range(last_j + 1)][::-1], [node(last_i, j, 1) for j in range(last_j + 1)]]
    return np.array(nodes), elements, sides, faces, down[:tip] / np.sin(np.radians(angle)), border


def border_forces(nodes, border, stress):
    """Forces of the tractions of `stress(x, y)` at the nodes of the border, by Simpson's three nodes and Gauss points."""
    points, weights = np.polynomial.legendre.leggauss(40)
    shape = np.stack([0.5 * points * (points - 1), 1 - points**2, 0.5 * points * (points + 1)])
    forces = np.zeros((len(nodes), 2))
    for line in border:
        for k in range(0, len(line) - 2, 2):
            ends = [n - 1 for n in line[k : k + 3]]
            xy = shape.T @ nodes[ends]
            along = 0.5 * (nodes[ends[2]] - nodes[ends[0]])
            # Lines run from left to right above, and so on: the outer normal is on their left.
            normal = np.array([-along[1], along[0]])
            xx, yy, s = stress(*xy.T)
            t = np.stack([xx * normal[0] + s * normal[1], s * normal[0] + yy * normal[1]])
            forces[ends] += (shape * weights) @ t.T
    return forces


def surface(x, y, xc, a, p0, friction):
    """Stress of the half-plane, with exactly the tractions of the contact on the surface."""
    xx, yy, xy = hertz(x, np.minimum(y, -1e-9), xc, a, p0, friction)
    p = p0 * np.sqrt(np.maximum(0.0, 1.0 - ((x - xc) / a) ** 2))
    on = y > -1e-9
    return xx, np.where(on, -p, yy), np.where(on, friction * p, xy)


def deck(part, positions):
    """The input file of CalculiX: one step, in which time counts the positions."""
    (length, angle), = part["cracks"][0]["segments_mm_deg"]
    nodes, elements, sides, faces, s, border = mesh(length, angle)
    elastic, a = part["elasticity"], part["half_width_mm"]
    forces = [np.zeros((len(nodes), 2))]
    for position in positions:
        load = lambda x, y: surface(x, y, position * a, a, part["peak_pressure_mpa"], part["contact_friction"])
        forces.append(border_forces(nodes, border, load))
    forces = np.array(forces)
    out = ["*NODE,NSET=ALL"] + [f"{i},{x:.9g},{y:.9g}" for i, (x, y) in enumerate(nodes, 1)]
    out += ["*ELEMENT,TYPE=CPE8,ELSET=RAIL"] + [",".join(map(str, [i, *e])) for i, e in enumerate(elements, 1)]
    out += ["*NSET,NSET=FACES"] + [str(n) for face in faces for n in face]
    out += ["*MATERIAL,NAME=STEEL", "*ELASTIC", f"{elastic['young_modulus_mpa']},{elastic['poisson_ratio']}"]
    out += ["*SOLID SECTION,ELSET=RAIL,MATERIAL=STEEL", "1."]
    for name, rows in sides.items():
        out += [f"*SURFACE,NAME={name.upper()},TYPE=ELEMENT"] + [f"{e},{f}" for e, f in rows]
    out += ["*CONTACT PAIR,INTERACTION=FRICTION,TYPE=SURFACE TO SURFACE", "LEFT,RIGHT"]
    out += ["*SURFACE INTERACTION,NAME=FRICTION", "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR", f"{PENALTY}"]
    out += ["*FRICTION", f"{part['face_friction']},{STICK}"]
    corner, other = border[2][-1], border[2][0]
    out += ["*BOUNDARY", f"{corner},1,2", f"{other},2,2"]
    loaded = [(n, d) for n in range(len(nodes)) for d in (0, 1) if np.abs(forces[:, n, d]).max() > 0.0]
    for n, d in loaded:
        out.append(f"*AMPLITUDE,NAME=A{n + 1}_{d + 1}")
        pairs = [f"{t},{f:.7g}" for t, f in enumerate(forces[:, n, d])]
        out += [",".join(pairs[k : k + 4]) for k in range(0, len(pairs), 4)]
    count = len(positions)
    out += [f"*STEP,INC={20 * count},NLGEOM=NO", "*STATIC", f"1.,{count},1e-3,1."]
    for n, d in loaded:
        out += [f"*CLOAD,AMPLITUDE=A{n + 1}_{d + 1}", f"{n + 1},{d + 1},1."]
    out += ["*NODE PRINT,NSET=FACES", "U", "*END STEP"]
    (HERE / "crack.inp").write_text("\n".join(out) + "\n")
    return faces, s, length, angle


def read(faces, s, length, angle, elastic):
    """K over time by the jumps near the tip: jump = 8 K/E' √(r/2π) (1 + c r), fitted."""
    along = np.exp(-1j * np.radians(angle))
    scale = elastic["young_modulus_mpa"] / (1 - elastic["poisson_ratio"] ** 2) / 8.0 * np.sqrt(2.0 * np.pi) / np.sqrt(1000.0)
    r = length - np.array(s)
    near = (r > 0.08) & (r < 0.8)
    results, moved, time = [], {}, None

    def finish():
        jump = np.array([moved[p] - moved[m] for p, m in zip(*faces)])
        parts = jump * np.conj(along)
        k = []
        for component in (parts.imag, parts.real):
            k.append(scale * np.polyfit(r[near], component[near] / np.sqrt(r[near]), 1)[1])
        results.append((time, *k))

    for line in (HERE / "crack.dat").read_text().splitlines():
        words = line.split()
        if "displacements" in line:
            if moved:
                finish()
            moved, time = {}, float(words[-1])
        elif len(words) == 4:
            moved[int(words[0])] = float(words[1]) + 1j * float(words[2])
    finish()
    return results


def main(name="45deg-faces0.3-contact+0.3"):
    with open(next(HERE.parents[1].glob("03-*")) / "problem.toml", "rb") as file:
        problem = tomllib.load(file)
    part = next(p for p in problem["part"] if p["name"] == name)
    part = {"elasticity": problem["elasticity"], **problem["common"], **part}
    # From afar in long steps, then in steps of 0.1 a over the crack.
    positions = np.concatenate([[-6.0, -4.0, -3.0, -2.5, -2.0, -1.75], np.arange(-1.5, 3.0 + 1e-9, 0.1)])
    crack = deck(part, positions)
    subprocess.run(["ccx", "crack"], cwd=HERE, check=True, stdout=open(HERE / "crack.log", "w"))
    lines = ["# problem: 03", "# CalculiX, see README.md", "part,xc_over_a,ki_mpa_sqrt_m,kii_mpa_sqrt_m"]
    for time, ki, kii in read(*crack, part["elasticity"]):
        if abs(time - round(time)) < 1e-6:
            lines.append(f"{name},{positions[round(time) - 1]:.4g},{ki:.5g},{kii:.5g}")
    (HERE / "03.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
