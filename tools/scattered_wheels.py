"""Rate of a head check under wheels that run scattered across the rail, in the plane and in space.

python3 tools/scattered_wheels.py RAILCRACK computes verification/plane-and-space/offsets.csv with that
program: the rate of step 0 at the deepest point under one wheel at each lateral offset. Without
arguments it prints the mean over normally distributed offsets relative to the centred wheel, for the
page that compares plane and space, and draws both with the rates over depth as
docs/figures/rate-and-scatter.svg. Needs matplotlib for that.
"""

import csv
import math
import pathlib
import sys
import tempfile

import head_check
from head_check import AXLE, hertz, root
from rate_over_depth import SINE, SPACE, depth_rate, run

table = root / "verification/plane-and-space/offsets.csv"

HALF_WIDTH = 6.0  # of the contact, along and across the rail
OFFSETS = [0.25 * k for k in range(11)]  # over the lateral half-width
DEPTHS = [2.0, 5.0]
WIDTHS = [2.0, 4.0, 6.0]  # surface length over the depth along the plane
SCATTERS = [0.25, 0.5, 1.0, 1.5]


def in_space(width, depth, wheels):
    cracks = head_check.crack(depth / SINE, 0.5, f"surface_half_length_mm = {0.5 * width * depth / SINE}\n")
    lines = ""
    for offset, share in wheels:
        inner = f"{hertz()}\nlateral_half_width_mm = {HALF_WIDTH}\nlateral_mm = {offset * HALF_WIDTH}\n"
        lines += f"[[wheel]]\nshare = {share}\naxle_load_t = {AXLE}\n[wheel.contact]\n{inner}"
    return SPACE.format(cracks=cracks, wheels=lines, growth="", more="")


def in_plane(depth, offset):
    """The strip of the ellipse at this offset: its peak pressure and half-width."""
    share = math.sqrt(1.0 - offset * offset)
    contact = hertz(pressure=1000.0 * share, half_width=HALF_WIDTH * share)
    return head_check.plane(contact, head_check.crack(depth / SINE, 0.5), "steps = 0", 24)


def compute(program):
    with tempfile.TemporaryDirectory() as folder, open(table, "w") as out:
        folder = pathlib.Path(folder)
        out.write("# Rate at the deepest point under one wheel, mm of depth per MGT; a ratio of 0 is the plane\n")
        out.write("surface_length_over_depth,depth_mm,offset_over_b,rate_mm_per_mgt\n")
        for depth in DEPTHS:
            for offset in OFFSETS:
                rate = 0.0
                if offset < 1.0:
                    rate = max(depth_rate(row) for row in run(program, in_plane(depth, offset), folder))
                out.write(f"0,{depth},{offset},{rate:.6g}\n")
                for width in WIDTHS:
                    rows = run(program, in_space(width, depth, [(offset, 1.0)]), folder)
                    out.write(f"{width},{depth},{offset},{depth_rate(rows[len(rows) // 2]):.6g}\n")
                    out.flush()
        # The same as one mix: five wheels of a Gauss-Hermite rule of unit standard deviation.
        nodes = [(0.0, 8 / 15), (1.3556261799742659, 0.2220759220056126), (2.8569700138728056, 0.011257411327720691)]
        mix = [(sign * node, share) for node, share in nodes for sign in ((1, -1) if node else (1,))]
        width, depth = WIDTHS[1], DEPTHS[0]
        rows = run(program, in_space(width, depth, mix), folder)
        print(f"mix of {len(mix)} wheels, {width}:1, {depth} mm:", depth_rate(rows[len(rows) // 2]))


def mean(rates, scatter):
    """The mean over a normal distribution of offsets (over b), the rates linear between the points; zero beyond them."""
    steps, reach = 4000, OFFSETS[-1]
    total = 0.0
    for k in range(steps):
        y = reach * (k + 0.5) / steps
        i = min(int(y / 0.25), len(rates) - 2)
        share = y / 0.25 - i
        weight = math.exp(-0.5 * (y / scatter) ** 2) / (scatter * math.sqrt(0.5 * math.pi))
        total += weight * reach / steps * (rates[i] + share * (rates[i + 1] - rates[i]))
    return total


def closed_form(scatter, exponent=3.33):
    """The mean of (1 − y²/b²)^(exponent/2)."""
    steps = 100000
    def of(y):
        return math.exp(-0.5 * (y / scatter) ** 2) * (1.0 - y * y) ** (0.5 * exponent)

    return sum(of((k + 0.5) / steps) for k in range(steps)) / steps / (scatter * math.sqrt(0.5 * math.pi))


def by_crack():
    """Rates at all offsets by depth and surface length over depth."""
    rates = {}
    for row in csv.DictReader(line for line in open(table) if not line.startswith("#")):
        key = (float(row["depth_mm"]), float(row["surface_length_over_depth"]))
        rates.setdefault(key, []).append(float(row["rate_mm_per_mgt"]))
    return rates


def show():
    rates = by_crack()
    print("closed form", *(f"{closed_form(scatter):.4f}" for scatter in SCATTERS))
    for (depth, width), own in rates.items():
        print(depth, width, f"{own[0]:.3f}", *(f"{mean(own, scatter) / own[0]:.3f}" for scatter in SCATTERS),
              "at offsets", *(f"{rate / own[0]:.3f}" for rate in own))


def draw():
    plot = head_check.plots()
    over_depth = {}
    for row in csv.DictReader(open(root / "verification/rate-over-depth/rates.csv")):
        rate = float(row["rate_mm_per_mgt"])
        if rate > 0.0:
            over_depth.setdefault(row["cause"], []).append((float(row["depth_mm"]), rate))
    figure, (left, right) = plot.subplots(1, 2, figsize=(10.5, 3.8), layout="constrained")
    causes = [("plane", "plane, line contact", "k--"), ("line contact, width 4:1", "space, line contact, 4:1", "k-"),
              ("ellipse, width 6:1", "space, ellipse, 6:1", "C0-"), ("ellipse, width 4:1", "4:1", "C1-"),
              ("ellipse, width 2:1", "2:1", "C2-")]
    for cause, label, look in causes:
        left.plot(*zip(*over_depth[cause]), look, marker="o", ms=3, lw=1, label=label)
    left.set(xscale="log", yscale="log", xlabel="depth, mm", ylabel="growth in depth, mm per MGT")
    left.legend(fontsize=7)
    scatters = [0.05 + 0.05 * k for k in range(30)]
    right.plot(scatters, [closed_form(scatter) for scatter in scatters], "k:", lw=1, label="∝ √(1 − y²/b²), exponent 3.33")
    names = {0.0: ("plane, strip of the ellipse", "k"), 6.0: ("space, 6:1", "C0"), 4.0: ("4:1", "C1"), 2.0: ("2:1", "C2")}
    for (depth, width), own in by_crack().items():
        name, colour = names[width]
        means = [mean(own, scatter) / own[0] for scatter in scatters]
        right.plot(scatters, means, "--" if depth < 3.0 else "-", color=colour, lw=1, label=f"{name}, {depth:g} mm")
    right.set(xlabel="standard deviation of the lateral offset over b", ylabel="mean rate over that of a centred wheel", ylim=(0, 1.1))
    right.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.savefig(root / "docs/figures/rate-and-scatter.svg", metadata={"Date": None})


if len(sys.argv) > 1:
    compute(str(pathlib.Path(sys.argv[1]).resolve()))
else:
    show()
    draw()
