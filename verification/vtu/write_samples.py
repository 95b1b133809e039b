"""Writes the files in `samples` with VTK and meshio: python3 write_samples.py [FOLDER]

Needs vtk and meshio. Every file holds the grid of `grid()`; the tests of the reader know its numbers.
"""

import sys
from pathlib import Path

import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk


def grid():
    """Points, cells (VTK type, points) and data: a triangle, a quad, and quadratic cells of 6, 8 and 9 nodes."""
    square = [(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5), (0.5, 0.5)]
    points = [(x + 1.25 * i, y - 1.0) for i in range(5) for x, y in square]
    at = lambda i, nodes: [9 * i + node for node in nodes]
    cells = [
        (5, at(0, [0, 1, 2])),
        (9, at(1, [0, 1, 2, 3])),
        (22, at(2, [0, 1, 2, 4, 5, 8])),
        (23, at(3, range(8))),
        (28, at(4, range(9))),
    ]
    x, y = np.array(points).T
    zero = np.zeros_like(x)
    displacement = np.stack([0.5 * x, -0.25 * y, zero], axis=1)
    stress = np.stack([x, y, zero + 2.0, x * y, zero, zero], axis=1)
    return np.stack([x, y, zero], axis=1), cells, displacement, stress, np.arange(5) * 10.0


def with_vtk(path, set_up):
    points, cells, displacement, stress, material = grid()
    out = vtk.vtkUnstructuredGrid()
    at = vtk.vtkPoints()
    at.SetDataTypeToDouble()
    for point in points:
        at.InsertNextPoint(point)
    out.SetPoints(at)
    for kind, nodes in cells:
        out.InsertNextCell(kind, len(nodes), nodes)
    for name, values in [("displacement_mm", displacement), ("stress_mpa", stress)]:
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        out.GetPointData().AddArray(array)
    array = numpy_to_vtk(material.astype(np.int32), deep=True)
    array.SetName("material")
    out.GetCellData().AddArray(array)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(out)
    writer.SetFileName(str(path))
    set_up(writer)
    assert writer.Write() == 1


def with_meshio(path, **options):
    points, cells, displacement, stress, material = grid()
    names = {5: "triangle", 9: "quad", 22: "triangle6", 23: "quad8", 28: "quad9"}
    mesh = meshio.Mesh(
        points,
        [(names[kind], np.array([nodes])) for kind, nodes in cells],
        point_data={"displacement_mm": displacement, "stress_mpa": stress},
        cell_data={"material": [np.array([value]) for value in material]},
    )
    meshio.write(path, mesh, file_format="vtu", **options)


def ascii(writer):
    writer.SetDataModeToAscii()


def appended_raw(writer):
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToNone()


def appended_base64_big_endian(writer):
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOn()
    writer.SetCompressorTypeToNone()
    writer.SetByteOrderToBigEndian()


def inline_64_bit_headers(writer):
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToNone()
    writer.SetHeaderTypeToUInt64()


def zlib_inline(writer):
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToZLib()
    # Small blocks, so that there are several, the last one not full.
    writer.SetBlockSize(512)


def zlib_appended_raw(writer):
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToZLib()


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent / "samples")
    set_ups = [ascii, appended_raw, appended_base64_big_endian, inline_64_bit_headers, zlib_inline, zlib_appended_raw]
    for set_up in set_ups:
        with_vtk(folder / f"vtk_{set_up.__name__}.vtu", set_up)
    with_meshio(folder / "meshio_ascii.vtu", binary=False)
    with_meshio(folder / "meshio_inline.vtu", compression=None)
    with_meshio(folder / "meshio_zlib.vtu")


if __name__ == "__main__":
    main()
