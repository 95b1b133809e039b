"""Draws docs/figures/space-scaling.svg from crates/railcrack/benches/results/space.csv. Needs matplotlib."""

import csv
import pathlib

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.fonttype"] = "none"
matplotlib.rcParams["svg.hashsalt"] = "railcrack"
import matplotlib.pyplot as plt
import matplotlib.ticker

root = pathlib.Path(__file__).resolve().parent.parent
with open(root / "crates/railcrack/benches/results/space.csv") as file:
    rows = list(csv.DictReader(line for line in file if not line.startswith("#")))

figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
parts = [("body_s", "o-", "#0072b2", "body"), ("forces_s", "^-", "#009e73", "forces"), ("passage_s", "s-", "#e69f00", "passage")]
for axis, dip in zip(axes, ["30", "15"]):
    own = [row for row in rows if row["dip_deg"] == dip]
    x = [float(row["elements"]) for row in own]
    for name, look, colour, label in parts:
        axis.loglog(x, [float(row[name]) for row in own], look, color=colour, label=label)
    memory = axis.twinx()
    memory.loglog(x, [float(row["peak_memory_mb"]) for row in own], "d:", color="#666666", label="peak memory")
    memory.set_ylabel("MB")
    memory.set_ylim(2, 2000)
    axis.set_xlabel(f"elements, dip {dip}°")
    axis.set_ylabel("s")
    axis.set_ylim(0.005, 100)
    axis.set_xlim(20, 2500)
    axis.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    axis.set_xticks([24, 96, 216, 600, 2016], ["24", "96", "216", "600", "2016"])
    axis.grid(True, which="major", color="#e4e4e4")
lines = [line for part in (axis, memory) for line in part.get_lines()]
figure.legend(lines, [line.get_label() for line in lines], fontsize=8, loc="outside lower center", ncols=4)
figure.savefig(root / "docs/figures/space-scaling.svg", metadata={"Date": None, "Creator": None})
