"""Profiles of rail and wheel from their definitions: cases/profiles/uic60.csv and s1002.csv.

python3 tools/standard_profiles.py

* Rail UIC 60 (60E1, EN 13674-1) at an inclination of 1:40 towards the gauge side (negative y): arcs
  of 300, 80 and 13 mm that follow one another with common tangents, up to the sides at 1:20. The
  arcs meet 10.475 and 26 mm from the middle of the head: with these places it is the rail of the
  Manchester contact benchmark to 4 micrometres between y = -36 and 22 mm (Shackleton and Iwnicki,
  Vehicle System Dynamics 46, 2008, 129-149).
* Wheel S1002 (EN 13715): its polynomials and the arc of 13 mm between tread and flange, from the
  field side (y = 60 mm) to y = -38.4 mm, where the flange begins.

z_mm is measured downwards, y_mm towards the field side. The origin of the rail is its highest point,
that of the wheel its tread 70 mm from the back of the flange.
"""

import math
import pathlib

ARCS = [(10.475, 300.0), (26.0, 80.0)]
CORNER = 13.0
INCLINATION = math.atan(1 / 40)
SIDE = math.atan(20.0)
STEP = 0.25

root = pathlib.Path(__file__).resolve().parent.parent


def rail_point(angle):
    """The point of the upright rail where the tangent has this angle, y >= 0 and z downwards."""
    centre_y, centre_z, radius = 0.0, ARCS[0][1], ARCS[0][1]
    for (end, radius), following in zip(ARCS, [ARCS[1][1], CORNER]):
        last = math.asin((end - centre_y) / radius)
        if angle <= last:
            break
        away = radius - following
        centre_y += away * math.sin(last)
        centre_z -= away * math.cos(last)
        radius = following
    return centre_y + radius * math.sin(angle), centre_z - radius * math.cos(angle)


def rail():
    # Angles whose points are a step apart on each arc.
    ends = [0.0]
    centre = 0.0
    for (end, radius), following in zip(ARCS, [ARCS[1][1], CORNER]):
        ends.append(math.asin((end - centre) / radius))
        centre += (radius - following) * math.sin(ends[-1])
    ends.append(SIDE)
    angles = []
    for begin, end, radius in zip(ends, ends[1:], [300.0, 80.0, CORNER]):
        count = math.ceil((end - begin) * radius / STEP)
        angles += [begin + (end - begin) * i / count for i in range(count)]
    angles.append(SIDE)
    half = [rail_point(angle) for angle in angles]
    whole = [(-y, z) for y, z in reversed(half[1:])] + half
    top_y, top_z = rail_point(INCLINATION)
    cos, sin = math.cos(INCLINATION), math.sin(INCLINATION)
    turned = lambda y, z: (cos * (y - top_y) + sin * (z - top_z), -sin * (y - top_y) + cos * (z - top_z))
    return [turned(y, z) for y, z in whole]


def wheel_height(y):
    """z downwards of the S1002 profile, y towards the field side, mm (EN 13715)."""
    if y >= 32.15796:
        return 1.364323640 - 0.066666667 * y
    if y >= -26.0:
        terms = [
            0.0,
            -3.358537058e-2,
            1.565681624e-3,
            -2.810427944e-5,
            5.844240864e-8,
            -1.562379023e-8,
            5.309217349e-15,
            -5.957839843e-12,
            2.646656573e-13,
        ]
    elif y >= -35.0:
        terms = [
            -4.320221063e3,
            -1.038384026e3,
            -1.065501873e2,
            -6.051367875,
            -2.054332446e-1,
            -4.169739389e-3,
            -4.687195829e-5,
            -2.252755540e-7,
        ]
    else:
        return 16.446 - math.sqrt(13.0**2 - (y + 26.210665) ** 2)
    return sum(term * y**power for power, term in enumerate(terms))


def wheel():
    count = int((60.0 + 38.4) / STEP)
    places = [-38.4 + (60.0 + 38.4) * i / count for i in range(count + 1)]
    return [(y, wheel_height(y)) for y in places]


def write(name, title, points):
    lines = [f"# {title}", "y_mm,z_mm"] + [f"{y:.5f},{z:.5f}" for y, z in points]
    (root / "cases/profiles" / name).write_text("\n".join(lines) + "\n")


def main():
    write("uic60.csv", "Rail UIC 60, inclined 1:40; z downwards, gauge side at negative y", rail())
    write("s1002.csv", "Wheel S1002 (EN 13715); z downwards, flange at negative y", wheel())


if __name__ == "__main__":
    main()
