"""Straight edge cracks in a half-plane under a passing contact: problems 01, 02 and 03.

    python3 edge_crack.py 03 [NODES [STEPS]]

writes 03.csv, to be scored. It needs numpy and the folder of the problem, whose text it follows: distributed
dislocations by Galerkin's method, contact conditions at the nodes, small fixed steps of the wheel.
"""

import csv
import sys
import tomllib
from pathlib import Path

import numpy as np

PROBLEMS = Path(__file__).resolve().parents[2]


def hertz(x, y, centre, a, p0, friction):
    """Stress xx, yy, xy of the pressure p0 √(1 − ((x − centre)/a)²) with the shear friction × pressure."""
    z = (x - centre + 1j * y) / a

    def w(z):
        return -1.0 / (np.sqrt(z - 1) * np.sqrt(z + 1) + z)

    scale = 0.5 * (friction - 1j) * p0
    slope = scale * (z / (np.sqrt(z - 1) * np.sqrt(z + 1)) - 1.0)
    t = scale * w(z) - scale * w(np.conj(z)) + (z - np.conj(z)) * np.conj(slope)
    return 4.0 * np.real(scale * w(z)) - t.real, t.real, -t.imag


def resultant(z, z0, burgers, factor):
    """Force across the line from the mouth (z = 0) to z due to a dislocation at z0 in the half-plane
    below the real axis, without the part 2 factor burgers ln|z − z0|; burgers = bx + i by."""
    alpha = factor * burgers / 1j
    bar, m = np.conj(alpha), np.conj(z0)
    image = -(bar * (z0 - m) / (z - m) ** 2 + alpha / (z - m))
    u = -2.0 * alpha * np.log(np.abs(z - m)) + bar * (z0 - m) / (z - m) + (z - np.conj(z)) * np.conj(image)
    # Both points lie on one line through the origin, so that (z − z0)/conj(z − z0) is z/conj(z).
    return 1j * (u + bar * (z / np.conj(z) - 1.0))


class Crack:
    """A crack of `length` from the origin, at `angle` below +x, with n nodes. The jump is linear between
    them in g = √(distance from the tip). Vectors have the normal components first, then the shear
    components; forces are tractions times the hat functions of the nodes."""

    def __init__(self, length, angle, n, modulus, poisson):
        effective = modulus / (1.0 - poisson**2)
        self.along = np.exp(-1j * np.radians(angle))
        self.normal = 1j * self.along
        # Nodes are uniform in g at the tip and denser towards the mouth, where the flap is thin.
        g = np.sqrt(length) * np.cos(0.5 * np.pi * np.linspace(0.0, 1.0, n + 1))
        g[-1] = 0.0
        points, weights = np.polynomial.legendre.leggauss(8)
        q = (0.5 * (g[:-1] + g[1:])[:, None] + 0.5 * np.diff(g)[:, None] * points).ravel()
        self.z = (length - q**2) * self.along
        self.weight = (np.abs(np.diff(g))[:, None] * 0.5 * weights).ravel()
        mean = np.kron(np.eye(n), 0.5 * weights)

        def twice_log(sum_of):
            h = lambda x: np.where(x == 0.0, 0.0, 0.5 * x**2 * np.log(np.abs(x) + 1e-300) - 0.75 * x**2)
            x = sum_of(g[:, None], g[None, :])
            return -(np.diff(np.diff(h(x), axis=0), axis=1))

        width = np.abs(np.diff(g))
        # Means over two elements of ln|s − s'| = ln|g − g'| + ln(g + g').
        log = (twice_log(lambda x, y: x - y) - twice_log(lambda x, y: x + y)) / np.outer(width, width)
        slope = np.eye(n + 1)[1:] - np.eye(n + 1)[:-1]
        slope = slope[:, :n]
        self.stiffness = np.empty((2 * n, 2 * n))
        factor = effective / (8.0 * np.pi)
        for c, direction in enumerate((self.normal, self.along)):
            force = mean @ resultant(self.z[:, None], self.z[None, :], direction, factor) @ mean.T
            force = force + 2.0 * factor * direction * log
            for part, axis in enumerate((self.normal, self.along)):
                block = slope.T @ np.real(np.conj(axis) * force) @ slope
                self.stiffness[part * n : (part + 1) * n, c * n : (c + 1) * n] = block
        # Hat functions at the quadrature points, times ds = 2 g dg.
        share = 0.5 * (1.0 + points)
        element = np.repeat(np.arange(n), len(points))
        hats = np.zeros((n + 1, len(q)))
        hats[element, np.arange(len(q))] = 1.0 - np.tile(share, n)
        hats[element + 1, np.arange(len(q))] = np.tile(share, n)
        self.hats = hats[:n] * self.weight * 2.0 * q
        # At the tip the jump is 8 K/E' √(r/2π): MPa√m.
        self.scale = effective / 8.0 * np.sqrt(2.0 * np.pi) / g[n - 1] / np.sqrt(1000.0)

    def load(self, xx, yy, xy):
        """Forces at the nodes due to a stress at the points z."""
        return np.concatenate([self.hats @ t for t in self.on_faces(xx, yy, xy)])

    def on_faces(self, xx, yy, xy):
        """Normal and shear components in the frame of the crack."""
        n, t = self.normal, self.along
        tx, ty = xx * n.real + xy * n.imag, xy * n.real + yy * n.imag
        return tx * n.real + ty * n.imag, tx * t.real + ty * t.imag

    def sifs(self, jump):
        """K_I and K_II, MPa√m."""
        n = len(jump) // 2
        return self.scale * jump[n - 1], self.scale * jump[2 * n - 1]


class Faces:
    """Contact conditions at the nodes, kept from step to step."""

    OPEN, STICK, SLIP = 0, 1, 2

    def __init__(self, crack, friction):
        self.crack, self.friction = crack, friction
        n = len(crack.hats)
        self.status = np.full(n, self.STICK if friction > 0.0 else self.SLIP)
        self.sign = np.zeros(n)
        self.slip = np.zeros(n)

    def step(self, load):
        """K under the tractions of the uncracked body, by changing the status of nodes until all
        conditions hold."""
        stiffness, mu = self.crack.stiffness, self.friction
        n = len(self.status)
        scale = max(1e-6, np.abs(load).max())
        small, size = 1e-9 * scale, 1e-12
        for tries in range(1000):
            is_open, sticks = self.status == self.OPEN, self.status == self.STICK
            # Free are the opening of open nodes and the slip of all that do not stick.
            free = np.concatenate([is_open, ~sticks])
            jump = np.concatenate([np.zeros(n), np.where(sticks, self.slip, 0.0)])
            # Shear of a slipping node: |s12| = −μ s22, s12 = sign × μ × s22.
            lean = np.where(is_open | sticks, 0.0, self.sign * mu)
            rows, right = stiffness.copy(), -(load + stiffness @ jump)
            rows[n:] -= lean[:, None] * stiffness[:n]
            right[n:] -= lean * right[:n]
            jump[free] = np.linalg.solve(rows[np.ix_(free, free)], right[free])
            total = load + stiffness @ jump
            tn, tt, moved = total[:n], total[n:], jump[n:] - self.slip
            closes = is_open & (jump[:n] < -size)
            opens = ~is_open & (tn > small)
            slides = sticks & ~opens & (np.abs(tt) > -mu * tn + small)
            # Slip goes the way of the shear.
            halts = (self.status == self.SLIP) & ~opens & (moved * self.sign > size) & (mu > 0.0)
            changed = closes | opens | slides | halts
            if not changed.any():
                break
            if tries > 30:
                # Many changes at once may go round in circles.
                one = np.arange(n) == np.flatnonzero(changed)[-1]
                closes, opens, slides, halts = closes & one, opens & one, slides & one, halts & one
            # What closes while it slides goes on sliding; if not, it halts in the next try.
            self.status[closes] = self.SLIP
            self.sign[closes] = -np.sign(moved[closes])
            self.status[halts] = self.STICK
            self.status[opens] = self.OPEN
            self.status[slides] = self.SLIP
            self.sign[slides] = -np.sign(tt[slides])
        else:
            raise RuntimeError("no state found")
        self.slip = jump[n:].copy()
        return self.crack.sifs(jump)


def passage(part, n, steps):
    """K at the positions of the second passage."""
    elastic = part["elasticity"]
    (length, angle), = part["cracks"][0]["segments_mm_deg"]
    crack = Crack(length, angle, n, elastic["young_modulus_mpa"], elastic["poisson_ratio"])
    faces = Faces(crack, part.get("face_friction", 0.0))
    x, y = crack.z.real, crack.z.imag
    if "tension_mpa" in part:
        sigma = np.full(len(x), part["tension_mpa"])
        return [(0.0, *faces.step(crack.load(sigma, 0.0 * x, 0.0 * x)))]
    a, p0, mu = part["half_width_mm"], part["peak_pressure_mpa"], part["contact_friction"]
    start, end, count = part["positions_over_a"]

    def at(position):
        return faces.step(crack.load(*hertz(x, y, position * a, a, p0, mu)))

    far = 1.0 / np.linspace(1e-3, 1.0 / abs(start), 60)
    fine = np.linspace(start, end, (count - 1) * steps + 1)
    for again in range(2):
        for position in far[:-1]:
            at(-position)
        history = [(position, *at(position)) for position in fine]
        for position in far[::-1][1:]:
            at(position * end / abs(start))
    return history[::steps]


def main(number, n=60, steps=10):
    folder = next(PROBLEMS.glob(f"{number}-*"))
    with open(folder / "problem.toml", "rb") as file:
        problem = tomllib.load(file)
    with open(f"{number}.csv", "w", newline="") as file:
        file.write(f"# problem: {number}\n")
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["part", "xc_over_a", "ki_mpa_sqrt_m", "kii_mpa_sqrt_m"])
        for part in problem["part"]:
            whole = {"elasticity": problem["elasticity"], **problem.get("common", {}), **part}
            for position, ki, kii in passage(whole, int(n), int(steps)):
                out.writerow([part["name"], f"{position:.6g}", f"{ki:.6g}", f"{kii:.6g}"])
            print(part["name"])


if __name__ == "__main__":
    main(*sys.argv[1:])
