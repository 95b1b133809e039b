"""The deformed surroundings of the cracks of a run, as a picture or in a window.

    field_picture.py RUN [--step N] [--at X] [--warp F] [--out PICTURE]

RUN is the folder of a run with fields. Of its files the one of step N (the last) whose wheel position is nearest to
x_c/a = X is shown, the displacement relative to its mean magnified F times; without these, the position at which the
cracks are most open. Needs pyvista.
"""

import argparse
import csv
import re
from pathlib import Path

import numpy
import pyvista


def places(run):
    """Wheel positions of a passage, x_c/a by number, and over how much of their points the cracks are open, by step."""
    everything = lambda name: csv.DictReader(line for line in (run / name).open() if not line.startswith("#"))
    # Fields are those of the first wheel of a mix.
    rows = lambda name: (row for row in everything(name) if row.get("wheel", "1") == "1")
    centre = {int(row["position"]): float(row["xc_over_a"]) for row in rows("sif.csv")}
    points, opened = {}, {}
    if (run / "faces.csv").is_file():
        for row in rows("faces.csv"):
            key = int(row["step"]), int(row["position"])
            points[key] = points.get(key, 0) + 1
            opened[key] = opened.get(key, 0) + (row["status"] == "open")
    return centre, {key: opened[key] / count for key, count in points.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", type=Path)
    parser.add_argument("--step", type=int)
    parser.add_argument("--at", type=float)
    parser.add_argument("--warp", type=float, default=100.0)
    parser.add_argument("--out", type=Path)
    asked = parser.parse_args()

    numbers = [re.fullmatch(r"step-(\d+)-position-(\d+)\.vtu", path.name) for path in (asked.run / "fields").iterdir()]
    files = sorted((int(found[1]), int(found[2])) for found in numbers if found)
    step = max(step for step, _ in files) if asked.step is None else asked.step
    centre, opened = places(asked.run)
    here = [position for other, position in files if other == step]
    if not here:
        parser.error(f"no fields of step {step}")
    if asked.at is None:
        position = max(here, key=lambda position: opened.get((step, position), 0.0))
    else:
        position = min(here, key=lambda position: abs(centre[position] - asked.at))
    share = opened.get((step, position))
    state = "" if share is None else f", {100 * share:.0f} % of the face points open"
    print(f"step {step}, x_c/a = {centre[position]:.2f}{state}")

    field = pyvista.read(asked.run / "fields" / f"step-{step:04}-position-{position:04}.vtu")
    moved = field["displacement_mm"]
    # A line load moves all of a half-plane: only differences mean something.
    field["relative_mm"] = moved - moved.mean(axis=0)
    xx, yy, zz, xy = field["stress_mpa"][:, :4].T
    field["von Mises stress (MPa)"] = numpy.sqrt(
        0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * xy**2)
    warped = field.warp_by_vector("relative_mm", factor=asked.warp)
    # The faces are the lines of the file.
    faces = warped.extract_cells(warped.celltypes == pyvista.CellType.LINE)
    bulk = warped.extract_cells(warped.celltypes != pyvista.CellType.LINE)

    plotter = pyvista.Plotter(off_screen=asked.out is not None, window_size=[1400, 800])
    plotter.set_background("white")
    # The tips are singular: the colours end where all but a fiftieth of the points lie.
    most = numpy.quantile(field["von Mises stress (MPa)"], 0.98)
    plotter.add_mesh(bulk, scalars="von Mises stress (MPa)", cmap="viridis_r", clim=[0, most], lighting=False,
                     scalar_bar_args={"color": "black", "n_labels": 3, "fmt": "%.0f", "title_font_size": 18, "label_font_size": 18,
                                      "position_x": 0.1, "position_y": 0.02, "width": 0.8, "height": 0.09})
    plotter.add_mesh(faces, color="black", line_width=2)
    title = f"Step {step}, x_c/a = {centre[position]:.2f}{state}; displacement magnified {asked.warp:g} times"
    plotter.add_text(title, font_size=12, color="black")
    plotter.view_xy()
    plotter.camera.zoom(1.5)
    plotter.show(screenshot=asked.out)


if __name__ == "__main__":
    main()
