"""Draws docs/figures/scaling.svg from crates/railcrack/benches/results/scaling.csv. Needs matplotlib."""

import csv
import pathlib

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.fonttype"] = "none"
matplotlib.rcParams["svg.hashsalt"] = "railcrack"
import matplotlib.pyplot as plt
import matplotlib.ticker

root = pathlib.Path(__file__).resolve().parent.parent
with open(root / "crates/railcrack/benches/results/scaling.csv") as file:
    rows = list(csv.DictReader(line for line in file if not line.startswith("#")))


def column(study, name):
    return [float(row[name]) for row in rows if row["study"] == study]


panels = [
    ("unknowns", "unknowns", "unknowns"),
    ("cracks", "cracks", "number of cracks, together"),
    ("groups, dislocations", "cracks", "in groups, dislocations"),
    ("load steps", "contact_solves", "contact solutions of a step"),
]
figure, axes = plt.subplots(1, 4, figsize=(13.6, 3.6), constrained_layout=True)
for axis, (study, name, title) in zip(axes, panels):
    x = column(study, name)
    axis.loglog(x, column(study, "body_ms"), "o-", color="#0072b2", label="body")
    axis.loglog(x, column(study, "contact_ms"), "s-", color="#e69f00", label="contact")
    axis.set_xlabel(title)
    axis.set_ylabel("ms per growth step")
    memory = axis.twinx()
    memory.loglog(x, column(study, "peak_memory_mb"), "^:", color="#666666", label="peak memory")
    memory.set_ylabel("MB")
    memory.set_ylim(10, 2000)
    axis.grid(True, which="major", color="#e4e4e4")
    if study == "load steps":
        # They differ by a fifth: no decade to show.
        axis.set_xscale("linear")
        axis.set_yscale("linear")
        axis.set_ylim(0, None)
    else:
        round_ticks = [2e4, 6e4, 2e5]
        ticks = x if name == "cracks" else [v for v in round_ticks if min(x) <= v <= max(x)]
        axis.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
        axis.set_xticks(ticks, [f"{v:,.0f}".replace(",", "\u2009") for v in ticks])
lines = [line for part in (axis, memory) for line in part.get_lines()]
figure.legend(lines, [line.get_label() for line in lines], fontsize=8, loc="outside lower center", ncols=3)
figure.savefig(root / "docs/figures/scaling.svg", metadata={"Date": None, "Creator": None})
