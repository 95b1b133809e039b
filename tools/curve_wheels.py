"""A table of 1000 wheels on the outer rail of a curve of 500 m: cases/curve-500.csv.

python3 tools/curve_wheels.py [SEED]

The wheels are synthetic, not measured. Their ranges follow from the kinematics of a bogie in a
curve (Wickens, Fundamentals of Rail Vehicle Dynamics, 2003, chapters 2 and 6):

* longitudinal creepage: up to e/R = 0.75 m/500 m = 1.5e-3, the difference of the paths of the two
  wheels, less what the difference of their rolling radii makes up for;
* lateral creepage: the angle of attack, at most the wheelbase over the radius, 2.5 m/500 m = 5e-3,
  of a leading wheelset; nearly none of a trailing one;
* spin: sin(contact angle)/rolling radius, as on a cone, with the angle from the arcs of the head.

Head 60E1 of EN 13674-1: arcs of 300, 80 and 13 mm. Wheels are worn: their profile is concave where
the head is curved. Axle loads of 22.5 and 17 t, load transfer to the outer rail and dynamic part
together 1.1 with a standard deviation of 0.12. Friction 0.15 to 0.45: damp to dry rail (Lewis and
Olofsson, Wear 257, 2004, 721-729, where head contacts have 0.5 to 1.5 GPa and contacts at the gauge
corner up to 2.7 GPa). y_rail_mm is measured along the running surface towards the gauge corner.
"""

import math
import pathlib
import random
import sys

WHEELS = 1000
RADIUS = 500e3
WHEEL_RADIUS = 460.0
CURVE_M = 300.0

# Ends of the arcs of the head along the running surface, mm, and their radii.
ARCS = [(10.3, 300.0), (26.0, 80.0), (45.0, 13.0)]
# Radii of the concave wheel profile over each arc, least and most; none where it is straight.
PROFILES = [None, (110.0, 200.0), (17.0, 22.0)]

root = pathlib.Path(__file__).resolve().parent.parent


def arc(y):
    """Index of the arc at y."""
    return next(i for i, (end, _) in enumerate(ARCS) if abs(y) <= end)


def angle(y):
    """Contact angle at y, rad."""
    turned, begin = 0.0, 0.0
    for end, radius in ARCS:
        turned += max(0.0, min(abs(y), end) - begin) / radius
        begin = end
    return math.copysign(turned, y)


def wheel(number, rng):
    leading = number % 2 == 1
    axle = 22.5 if rng.random() < 0.6 else 17.0
    normal = 0.5 * 9.81 * axle * max(0.6, rng.gauss(1.1, 0.12))
    y = rng.gauss(17.0, 4.0) if leading else rng.gauss(4.0, 5.0)
    y = max(-20.0, min(32.0, y))
    profile = PROFILES[arc(y)]
    across = -rng.uniform(*profile) if profile else None
    along = rng.gauss(-3e-4, 5e-4) if leading else rng.gauss(5e-4, 4e-4)
    attack = rng.gauss(3e-3, 8e-4) if leading else rng.gauss(2e-4, 5e-4)
    spin = math.sin(angle(y)) / WHEEL_RADIUS + math.cos(angle(y)) / RADIUS
    return [
        number,
        round(rng.uniform(0.0, CURVE_M), 1),
        1,
        axle,
        round(normal, 2),
        round(y, 2),
        round(math.degrees(angle(y)), 2),
        f"{along:.3e}",
        f"{attack:.3e}",
        f"{spin:.3e}",
        round(rng.uniform(0.15, 0.45), 3),
        ARCS[arc(y)][1],
        WHEEL_RADIUS,
        "" if across is None else round(across, 1),
    ]


def main():
    seed = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    rng = random.Random(seed)
    header = (
        "wheel,place_m,patch,axle_load_t,normal_kn,y_rail_mm,angle_deg,creepage_x,creepage_y,"
        "spin_per_mm,mu,rail_radius_mm,wheel_radius_mm,wheel_profile_radius_mm"
    )
    lines = [f"# synthetic wheels on the outer rail of a curve of 500 m, seed {seed}", header]
    for number in range(1, WHEELS + 1):
        lines.append(",".join(str(value) for value in wheel(number, rng)))
    (root / "cases/curve-500.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
