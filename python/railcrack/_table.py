"""Tables of results."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _arrow, _html, _labelled, _text
from ._units import unit_of

if TYPE_CHECKING:
    import pandas
    import polars
    import xarray

def under(rows: Table, wheel: int = 1) -> Table:
    """Of the rows of a mix those of one wheel; all rows of a single wheel."""
    return rows.where(wheel=wheel) if "wheel" in rows else rows


class Table(Mapping[str, NDArray[Any]]):
    """A table of results: columns by name, each a NumPy array with one entry per row.

    `table["ki_mpa_sqrt_m"]` and `table.ki_mpa_sqrt_m` are the same array, without a copy. Numbers
    that count are int64, others float64 with NaN for missing values; words (`status`, `stop`) are
    arrays of str, empty for missing values. Columns, units and signs are those of the CSV file of
    the same name (docs/file-formats.md); `units` and `meanings` list them by column.

    A table is a mapping from names to columns whose `len` is its rows; it prints its numbers,
    converts (`to_pandas`, `to_polars`, `to_xarray`), and is an Arrow stream
    (`__arrow_c_stream__`), so that pyarrow, polars, duckdb or nanoarrow can read it directly.
    """

    name: str
    """`sif`, `growth`, `faces`, `residual`, …"""
    units: dict[str, str]
    """Unit of each column, as pint reads it: `MPa m^(1/2)`, `mm/cycle`; empty without a unit."""
    meanings: dict[str, str]
    """Meaning of each column."""

    def __init__(self, name: str, columns: Mapping[str, tuple[Any, list[str] | None, str]]) -> None:
        self.name = name
        self._columns = {key: (values, words) for key, (values, words, _) in columns.items()}
        self._texts: dict[str, NDArray[Any]] = {}
        self.units = {key: unit_of(key) for key in columns}
        self.meanings = {key: meaning for key, (_, _, meaning) in columns.items()}

    @property
    def rows(self) -> int:
        """Number of rows."""
        return max((len(values) for values, _ in self._columns.values()), default=0)

    @property
    def columns(self) -> list[str]:
        """Names of the columns, from left to right."""
        return list(self._columns)

    def __getitem__(self, column: str) -> NDArray[Any]:
        if column not in self._columns:
            raise KeyError(_text.unknown(column, self._columns, f"the table {self.name} has no column"))
        values, words = self._columns[column]
        if words is None and isinstance(values, np.ndarray):
            return values
        if column not in self._texts:
            texts = np.array([*words, ""])[values] if words is not None else np.array(values, dtype=str)
            self._texts[column] = texts
        return self._texts[column]

    def __getattr__(self, column: str) -> NDArray[Any]:
        if not column.startswith("_") and column in self.__dict__.get("_columns", {}):
            return self[column]
        columns = self.__dict__.get("_columns", {})
        raise AttributeError(_text.unknown(column, columns, f"the table {self.__dict__.get('name')} has no column"))

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._columns]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return self.rows

    def __contains__(self, column: object) -> bool:
        return column in self._columns

    def __eq__(self, other: object) -> bool:
        return self is other

    __hash__ = object.__hash__

    def where(self, **values: Any) -> Table:
        """Rows in which the named columns have the given values: `sif.where(step=0, crack=1)`."""
        chosen = np.ones(self.rows, bool)
        for column, value in values.items():
            chosen &= self[column] == value
        return self._rows(chosen)

    def _rows(self, chosen: NDArray[Any]) -> Table:
        def of(values: Any) -> Any:
            if isinstance(values, np.ndarray):
                return values[chosen]
            return [values[i] for i in np.flatnonzero(chosen)]

        parts = {
            key: (of(values), words, self.meanings[key]) for key, (values, words) in self._columns.items()
        }
        return Table(self.name, parts)

    def to_pandas(self) -> pandas.DataFrame:
        """A `pandas.DataFrame` that shares memory; words are categories. `attrs["units"]` has the
        units."""
        import pandas

        def column(values: Any, words: list[str] | None) -> Any:
            return values if words is None else pandas.Categorical.from_codes(values, categories=words)

        columns = {key: column(*entry) for key, entry in self._columns.items()}
        frame = pandas.DataFrame(columns, copy=False)
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_polars(self) -> polars.DataFrame:
        """A `polars.DataFrame`."""
        import polars

        frame = polars.DataFrame(self)
        return frame if isinstance(frame, polars.DataFrame) else polars.DataFrame(frame)

    def to_xarray(self) -> xarray.Dataset:
        """An `xarray.Dataset` with the dimensions `step`, `wheel` (of a mix), `crack`, `tip` and
        `position`, of the faces `point`, as far as the table has them; in space the tips are the
        points of the front, with the coordinate `phi_deg`, their angle. Each variable has
        `long_name`, `description`, and `units` if it has a unit. Missing rows are NaN.

        Of the passages of a step the dataset has the last one, which is the stabilised one;
        `table.where(passage=1).to_xarray()` has another. A table without such columns has the
        dimension `row`.
        """
        return _labelled.dataset(self)

    def __arrow_c_stream__(self, requested_schema: object = None) -> Any:
        """The table as a capsule with an Arrow stream; numbers are not copied."""
        return _arrow.stream(self._columns)

    def __reduce__(self) -> tuple[Any, ...]:
        columns = {key: (*entry, self.meanings[key]) for key, entry in self._columns.items()}
        return Table, (self.name, columns)

    def __repr__(self) -> str:
        return f"<railcrack.Table {self.name}: {self.rows} rows of {len(self._columns)} columns>"

    def __str__(self) -> str:
        return _text.table(self.name, self.rows, self, self.units)

    def _repr_html_(self) -> str:
        return _html.table(self.name, self.rows, self, self.meanings)
