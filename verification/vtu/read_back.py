"""Reads grids with meshio and prints what they hold as JSON: python3 read_back.py FILE ...

Real numbers are printed as the 64 bits that hold them, so that no decimal stands between writer and reader.
"""

import json
import sys

import meshio
import numpy as np


def bits(values):
    return np.ascontiguousarray(values, dtype=np.float64).view(np.uint64).tolist()


def content(path):
    mesh = meshio.read(path)
    return {
        "points": bits(mesh.points),
        "cells": [{"type": block.type, "nodes": block.data.tolist()} for block in mesh.cells],
        "point_data": {name: bits(values) for name, values in mesh.point_data.items()},
        "cell_data": {name: [bits(values) for values in blocks] for name, blocks in mesh.cell_data.items()},
    }


print(json.dumps([content(path) for path in sys.argv[1:]]))
