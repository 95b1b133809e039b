"""Tables as arrays with the dimensions step, wheel, crack, tip and position."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import xarray


class Columns(Protocol):
    """A table, as far as it is needed here."""

    name: str
    units: dict[str, str]
    meanings: dict[str, str]

    @property
    def rows(self) -> int: ...

    @property
    def columns(self) -> list[str]: ...

    def __getitem__(self, column: str, /) -> NDArray[Any]: ...


# The dimensions of a table, if it has the columns.
_DIMENSIONS = {
    "sif": ("step", "wheel", "crack", "tip", "position"),
    "growth": ("step", "crack", "tip"),
    "faces": ("step", "wheel", "position", "point"),
    "residual": ("depth_mm",),
    "profile": ("depth_mm",),
    "passes": ("pass",),
    "wheels": ("wheel",),
    "summary": ("run",),
}
# Columns that are coordinates, with the dimensions that they have.
_COORDINATES = {
    "passage": ("step",),
    "xc_mm": ("step", "wheel", "position"),
    "xc_over_a": ("step", "wheel", "position"),
    "phi_deg": ("tip",),
    "load_cycles": ("step",),
    "mgt": ("step",),
    "crack": ("step", "point"),
    "segment": ("step", "point"),
    "s_mm": ("step", "point"),
    "z_mm": ("step", "point"),
}


def dataset(table: Columns) -> xarray.Dataset:
    """`table` by its dimensions; a row per `row` where it has none, or where they do not tell its
    rows apart."""
    import xarray

    def attributes(column: str) -> dict[str, str]:
        meaning, unit = table.meanings.get(column, ""), table.units.get(column, "")
        named = {"long_name": _short(meaning) or column, "description": meaning}
        return named | {"units": unit} if unit else named

    kept, keys = _keys(table)
    labels: dict[str, NDArray[Any]] = {}
    codes: dict[str, NDArray[np.intp]] = {}
    for name, values in keys.items():
        labels[name], codes[name] = np.unique(values, return_inverse=True)
    shape = tuple(len(values) for values in labels.values())
    flat = np.ravel_multi_index(tuple(codes.values()), shape) if keys and len(kept) else np.arange(len(kept))
    if not keys or len(np.unique(flat)) < len(flat):
        rows = {column: ("row", table[column], attributes(column)) for column in table.columns}
        return xarray.Dataset(rows, attrs={"table": table.name})

    dimensions = list(keys)
    variables: dict[str, Any] = {}
    coordinates: dict[str, Any] = {name: (name, values, attributes(name)) for name, values in labels.items()}
    for column in table.columns:
        if column in keys:
            continue
        values = _spread(table[column][kept], flat, shape)
        if column in _COORDINATES:
            along, values = _along(_COORDINATES[column], dimensions, values)
            whole = table[column].dtype.kind == "i" and np.isfinite(values).all()
            coordinates[column] = (along, values.astype(np.int64) if whole else values, attributes(column))
        else:
            variables[column] = (dimensions, values, attributes(column))
    return xarray.Dataset(variables, coordinates, attrs={"table": table.name})


def _keys(table: Columns) -> tuple[NDArray[np.intp], dict[str, NDArray[Any]]]:
    """The rows of the stabilised passages, and the labels of these rows in each dimension."""
    kept = np.arange(table.rows)
    if "passage" in table.columns and table.rows:
        last = np.zeros(int(table["step"].max()) + 1, np.int64)
        np.maximum.at(last, table["step"], table["passage"])
        kept = np.flatnonzero(table["passage"] == last[table["step"]])
    wanted = [name for name in _DIMENSIONS.get(table.name, ()) if name in table.columns or name == "point"]
    keys = {name: table[name][kept] for name in wanted if name != "point"}
    if "point" in wanted:
        keys["point"] = _places(list(keys.values()), len(kept))
    return kept, keys


def _places(groups: list[NDArray[Any]], rows: int) -> NDArray[np.int64]:
    """The place of each row within its group, from 1, in the order of the rows."""
    if not rows:
        return np.zeros(0, np.int64)
    _, group = np.unique(np.stack(groups, axis=1), axis=0, return_inverse=True)
    order = np.argsort(group.ravel(), kind="stable")
    sorted_groups = group.ravel()[order]
    starts = np.flatnonzero(np.r_[True, np.diff(sorted_groups) != 0])
    counts = np.diff(np.r_[starts, rows])
    places = np.empty(rows, np.int64)
    places[order] = np.arange(rows) - np.repeat(starts, counts) + 1
    return places


def _spread(values: NDArray[Any], flat: NDArray[np.intp], shape: tuple[int, ...]) -> NDArray[Any]:
    """`values` at their places; NaN or an empty text where there is no row."""
    size = int(np.prod(shape))
    if values.dtype.kind in "iu" and len(flat) == size:
        spread = np.empty(size, values.dtype)
    elif values.dtype.kind in "US":
        spread = np.full(size, "", values.dtype)
    else:
        spread = np.full(size, np.nan)
    spread[flat] = values
    return spread.reshape(shape)


def _along(wanted: tuple[str, ...], dimensions: list[str], values: NDArray[Any]) -> tuple[list[str], NDArray[Any]]:
    """`values` along the `wanted` dimensions, if they do not change along the others, missing ones
    aside."""
    axes = tuple(i for i, name in enumerate(dimensions) if name not in wanted)
    if values.size == 0 or not axes:
        return dimensions, values
    low = np.where(np.isfinite(values), values, np.inf).min(axis=axes, keepdims=True)
    if (np.isfinite(values) & (values != low)).any():
        return dimensions, values
    first = low.squeeze(axes)
    kept = np.where(np.isfinite(first), first, np.nan) if values.dtype.kind == "f" else first.astype(values.dtype)
    return [name for name in dimensions if name in wanted], kept


def _short(meaning: str) -> str:
    """The subject of a meaning, for axes: `K_II` of `K_II, MPa√m.`"""
    subject = re.split(r"[,;:.(]", meaning)[0].strip()
    return "" if subject.startswith("As in") else subject
