"""Fields on meshes."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray


class FieldGrid:
    """A field on the mesh around the cracks: cracked elements cut along the faces; in space the
    faces of the crack and its front.

    points: shape (n, 3), x, y and z (0 in the plane) in mm.
    cells, cell_types: as in VTK (number of nodes, nodes; number of the cell type).
    point_data: `displacement_mm` (n, 3), `stress_mpa` (n, 6: xx, yy, zz, xy, yz, xz), `traction`
        (n, 3) on the faces; in space `jump_mm` (n, 3), `opening_mm`, `slip_mm`, `slip_z_mm`,
        tractions, `status` (0 open, 1 stick, 2 slip), and K along the front.
    cell_data: `face`: 1 on the + face, −1 on the − face, 0 in the bulk; none in space.
    """

    points: NDArray[np.float64]
    cells: NDArray[np.int64]
    cell_types: NDArray[np.uint8]
    point_data: dict[str, NDArray[np.float64]]
    cell_data: dict[str, NDArray[np.float64]]

    def __init__(self, arrays: dict[str, Any]) -> None:
        self.points = arrays["points"]
        self.cells = arrays["cells"]
        self.cell_types = arrays["cell_types"]
        self.point_data = arrays["point_data"]
        self.cell_data = arrays["cell_data"]

    def to_pyvista(self) -> Any:
        """A `pyvista.UnstructuredGrid`."""
        import pyvista

        grid = pyvista.UnstructuredGrid(self.cells, self.cell_types, self.points)
        for name, values in self.point_data.items():
            grid.point_data[name] = values
        for name, values in self.cell_data.items():
            grid.cell_data[name] = values
        return grid

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a VTK file, with pyvista."""
        self.to_pyvista().save(os.fspath(path))

    def __repr__(self) -> str:
        return f"<railcrack.FieldGrid: {len(self.points)} points, {len(self.cell_types)} cells>"
