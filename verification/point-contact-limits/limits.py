"""First yield and shakedown limits under a Hertz ellipse in full sliding, without railcrack.

    python3 limits.py [FRICTION ...]       writes limits.csv

Needs numpy and scipy. The stress is the integral of the point forces of Boussinesq and Cerruti (Johnson 1985,
3.19 and 3.76; Poisson's ratio 0.3) over the ellipse, the limit the smallest ball around the path of the deviator
of a streamline (Melan's theorem, kinematic hardening). Lengths are over a, along the rail, stresses over p0.
"""

import functools
import sys

import numpy as np
from scipy.optimize import minimize, minimize_scalar

POISSON = 0.3
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(48)
ANGLES, ANGLE_WEIGHTS = np.polynomial.legendre.leggauss(120)
SHALLOW = (1e-3, 2.5e-4)  # depths from which the surface is extrapolated, in √depth


def point_forces(x, y, z, friction):
    """xx, yy, zz, xy, yz, xz of a unit force into the half-space z > 0 and `friction` along x, at the origin."""
    r, m = np.sqrt(x * x + y * y + z * z), 1 - 2 * POISSON
    s = r + z
    a, b, c = (2 * r + z) / (r**3 * s * s), 1 / (r**3 * s * s) + 2 / (r * r * s**3), 1 / (r * s * s)
    normal = [
        -3 * x * x * z / r**5 + m * (z / r**3 - 1 / (r * s) + x * x * a),
        -3 * y * y * z / r**5 + m * (z / r**3 - 1 / (r * s) + y * y * a),
        -3 * z**3 / r**5,
        -3 * x * y * z / r**5 + m * x * y * a,
        -3 * y * z * z / r**5,
        -3 * x * z * z / r**5,
    ]
    shear = [
        -3 * x**3 / r**5 + m * (x / r**3 - 3 * x * c + x**3 * b),
        -3 * x * y * y / r**5 + m * (x / r**3 - x * c + x * y * y * b),
        -3 * x * z * z / r**5,
        -3 * x * x * y / r**5 + m * (-y * c + x * x * y * b),
        -3 * x * y * z / r**5,
        -3 * x * x * z / r**5,
    ]
    return (np.array(normal) + friction * np.array(shear)) / (2 * np.pi)


def stress(x, y, z, b, friction):
    """The stress at a depth z > 0, in polar coordinates about the place above it."""
    inside = x * x + (y / b) ** 2 < 1 - 1e-12
    if inside:
        angle = 2 * np.pi * (np.arange(240) + 0.5) / 240
        weight = np.full(240, 2 * np.pi / 240)
        u, du = 1 - (0.5 * (1 - POINTS)) ** 2, 0.5 * (1 - POINTS) * WEIGHTS
    else:
        # Between the tangents, in the plane in which the ellipse is a circle.
        half, middle = np.arcsin(min(1.0, 1 / np.hypot(x, y / b))), np.arctan2(-y / b, -x)
        t = middle + half * np.sin(0.5 * np.pi * ANGLES)
        angle = np.arctan2(b * np.sin(t), np.cos(t))
        weight = ANGLE_WEIGHTS * half * 0.5 * np.pi * np.cos(0.5 * np.pi * ANGLES)
        weight = weight * b / (np.cos(t) ** 2 + (b * np.sin(t)) ** 2)
        u, du = 0.5 + 0.5 * np.sin(0.5 * np.pi * POINTS), 0.25 * np.pi * np.cos(0.5 * np.pi * POINTS) * WEIGHTS
    cos, sin = np.cos(angle), np.sin(angle)
    p, q, r = cos**2 + (sin / b) ** 2, x * cos + y * sin / b**2, x * x + (y / b) ** 2 - 1
    root = np.sqrt(np.maximum(q * q - p * r, 0))
    near = np.arcsinh((0 * q if inside else (-q - root) / p) / z)
    far = np.arcsinh((-q + root) / p / z)
    u = near[:, None] + (far - near)[:, None] * u
    rho = z * np.sinh(u)
    area = rho * z * np.cosh(u) * (far - near)[:, None] * du * weight[:, None]
    at = [rho * cos[:, None], rho * sin[:, None]]
    pressure = np.sqrt(np.maximum(0, 1 - (x + at[0]) ** 2 - ((y + at[1]) / b) ** 2))
    return (point_forces(-at[0], -at[1], np.full_like(rho, z), friction) * pressure * area).sum((1, 2))


def surface_of_circle(x, friction):
    """The stress at a place of the surface on the axis y = 0, under a circle (Johnson 1985, 3.43 and 3.91)."""
    m, root = 1 - 2 * POISSON, np.sqrt(1 - x * x)
    ring = m / 3 * (1 - root**3) / (x * x) if abs(x) > 1e-6 else m / 2
    along = -np.pi / 8 * (4 + POISSON) * friction * x
    across = -np.pi / 8 * 3 * POISSON * friction * x
    return np.array([ring - root + along, -ring - 2 * POISSON * root + across, -root, 0, 0, -friction * root])


def deviator(t):
    """Five coordinates with the norm of the tensor; the last one is that of xz."""
    xx, yy, zz, xy, yz, xz = t
    two = np.sqrt(2.0)
    return np.array([(xx - yy) / two, (xx + yy - 2 * zz) / np.sqrt(6.0), two * xy, two * yz, two * xz])


def radius(path, free=5):
    """The smallest ball around a path, its centre within the first `free` coordinates."""
    full = lambda v: np.append(v[:-1], np.zeros(5 - free))
    room = lambda v: v[-1] - ((path - full(v)) ** 2).sum(1)
    slope = lambda v: np.hstack([2 * (path - full(v))[:, :free], np.ones((len(path), 1))])
    centre = path.mean(0) * (np.arange(5) < free)
    for k in range(2, 400):
        farthest = path[((path - centre) ** 2).sum(1).argmax()]
        centre = centre + (farthest - centre) / k * (np.arange(5) < free)
    start = np.append(centre[:free], ((path - centre) ** 2).sum(1).max())
    gradient = np.append(np.zeros(free), 1.0)
    best = minimize(
        lambda v: v[-1], start, jac=lambda v: gradient, method="SLSQP",
        constraints={"type": "ineq", "fun": room, "jac": slope}, options={"maxiter": 300, "ftol": 1e-14},
    )  # fmt: skip
    return np.sqrt(((path - full(best.x)) ** 2).sum(1).max())


WITHIN = np.sin(0.5 * np.pi * np.linspace(-1, 1, 61))
BESIDE = np.concatenate([s * (1 + 0.02 * 1.35 ** np.arange(16)) for s in (1, -1)])


def bounds(path):
    """p0/k at first yield, at the limit, and at the limit without a residual xz, of the unloaded state too."""
    path = np.array([*(deviator(t) for t in path), np.zeros(5)])
    return np.sqrt(2) / np.array([np.sqrt((path**2).sum(1).max()), radius(path), radius(path, 4)])


@functools.cache
def at_depth(z, b, friction):
    return bounds([stress(x, 0.0, z, b, friction) for x in np.concatenate([WITHIN, BESIDE])])


def at_surface(b, friction):
    if b == 1.0:
        inside = [surface_of_circle(x, friction) for x in WITHIN]
        return bounds(inside + [stress(x, 0.0, SHALLOW[0], b, friction) for x in BESIDE])
    deeper, shallower = (at_depth(z, b, friction) for z in SHALLOW)
    return 2 * shallower - deeper


def main(frictions):
    rows = ["b_over_a,friction,first_yield,first_yield_depth_over_a,shakedown,shakedown_depth_over_a,surface_without_residual_xz"]
    for b in (2.0 / 3.0, 1.0, 2.0):
        for friction in frictions:
            surface = at_surface(b, friction)
            row = [f"{b:.4f}", f"{friction:g}"]
            for k in (0, 1):
                below = minimize_scalar(
                    lambda z: at_depth(z, b, friction)[k], bounds=(0.2, 0.8), method="bounded", options={"xatol": 0.01}
                )
                value, depth = min((surface[k], 0.0), (below.fun, below.x))
                row += [f"{value:.4f}", f"{depth:.3f}"]
            rows.append(",".join([*row, f"{surface[2]:.4f}"]))
            print(rows[-1], flush=True)
    with open("limits.csv", "w") as file:
        file.write("# p0/k under Hertz ellipses in full sliding, Poisson's ratio 0.3: README.md\n" + "\n".join(rows) + "\n")


if __name__ == "__main__":
    main([float(f) for f in sys.argv[1:]] or [0.0, 0.1, 0.2, 0.3, 0.4])
