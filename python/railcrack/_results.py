"""Results of a run: tables, histories, fields, report."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _railcrack
from ._decision import InspectionInterval, Life, Verdict, inspection_of, life_of, verdict_of
from ._errors import BadInput, FolderError
from ._grid import FieldGrid
from ._html import facts
from ._table import Table, under


class RunResults:
    """Results of a run; `railcrack.Run` adds the case.

    The tables are those of the run folder, with the same columns (docs/file-formats.md).
    """

    def __init__(self, core: _railcrack.Run, *, in_memory: bool, folder: Path | None = None) -> None:
        self._core = core
        self._is_in_memory = in_memory
        self._folder = folder
        self._keeps: object = None

    @cached_property
    def sif(self) -> Table:
        """K of every tip at every wheel position: columns of `sif.csv`."""
        return self._table("sif")

    @cached_property
    def growth(self) -> Table:
        """Every tip at every step: columns of `growth.csv`."""
        return self._table("growth")

    @cached_property
    def faces(self) -> Table:
        """The crack faces through the stabilised passages: columns of `faces.csv`."""
        return self._table("faces")

    @cached_property
    def residual(self) -> Table:
        """Residual stress in the rail by depth: columns of `residual.csv`; no rows without residual
        stress."""
        return self._table("residual")

    def _table(self, name: str) -> Table:
        if not self.has(name):
            raise FolderError(
                f"{self._folder} has no {name}.csv: [output] of its case excludes it; "
                f'run.case.with_(output={{"{name}": "all"}}).run() computes it'
            )
        return Table(name, self._core.columns(name))

    def has(self, name: str) -> bool:
        """Whether the run has the table `sif` or `faces`: a run of a study has no faces unless
        [output] asks for them."""
        return self._folder is None or name not in ("sif", "faces") or (self._folder / f"{name}.csv").is_file()

    @cached_property
    def summary(self) -> dict[str, Any]:
        """`summary.json`."""
        return dict(json.loads(self._core.summary_json()))

    @property
    def verdict(self) -> Verdict | None:
        """The verdict: `level`, and `reasons` with their sentences. Without axle loads
        (`[traffic]`, `[[wheel]]`) there is one only if the model does not describe the run."""
        return verdict_of(self.summary)

    @property
    def life(self) -> Life:
        """Million gross tonnes until the first failure, its mode, crack and tip, and the load
        cycles of the run."""
        return life_of(self.summary)

    @property
    def inspection(self) -> InspectionInterval | None:
        """The inspection interval, and what it rests on; None without `[inspection]`, and if the
        verdict is `unknown`, `stop` or `outside`."""
        return inspection_of(self.summary)

    @property
    def decision(self) -> dict[str, Any] | None:
        """The whole decision, as in `summary.json`: risk, paths, scatter, wheels; None without
        axle loads."""
        return self.summary["decision"]  # type: ignore[no-any-return]

    @property
    def title(self) -> str:
        """Title of the case."""
        return str(self.summary["title"])

    @property
    def steps(self) -> int:
        """Number of increments computed."""
        return int(self.summary["steps"])

    @property
    def stop(self) -> str | None:
        """Reason for the end of the run; None if it can continue."""
        stop = self.summary["stop"]
        return None if stop is None else str(stop)

    @property
    def warnings(self) -> list[str]:
        """Warnings, in order."""
        return [w["text"] if isinstance(w, dict) else str(w) for w in self.summary["warnings"]]

    def to_xarray(self) -> Any:
        """K and growth as one `xarray.Dataset` with the dimensions `step`, `wheel` (of a mix),
        `crack`, `tip` and `position`; in space the tips are the points of the front, with their
        angle `phi_deg`. Stabilised passages only; `run.faces.to_xarray()` has the faces."""
        data = self.sif.to_xarray().merge(self.growth.to_xarray(), compat="override", join="outer")
        return data.assign_attrs(title=self.title, table="sif, growth")

    def cracks(self, step: int | None = None) -> list[NDArray[np.float64]]:
        """Each crack: shape (points, 2), x and y in mm; at the start of `step` 0, or of the last
        step (None)."""
        if step not in (None, 0):
            raise BadInput(f"step = {step}: must be 0, or None for the last one")
        key = "points_mm" if step is None else "initial_points_mm"
        return [np.array(crack[key]) for crack in self.summary["cracks"]]

    def history(self, step: int = 0, crack: int = 1, tip: int = 1, wheel: int = 1) -> NDArray[np.float64]:
        """K of a tip over the stabilised passage of a step at the output positions, in a mix under
        one wheel: shape (positions, 3), x_c/a, K_I and K_II (MPa√m). `sif` has K_III in space."""
        rows = under(self.sif.where(step=step, crack=crack, tip=tip), wheel)
        if rows.rows == 0:
            raise BadInput(f"no K of step {step}, crack {crack}, tip {tip}, wheel {wheel}")
        last = rows.where(passage=rows["passage"].max())
        return np.column_stack([last[c] for c in ("xc_over_a", "ki_mpa_sqrt_m", "kii_mpa_sqrt_m")])

    def save(self, folder: str | os.PathLike[str], *, replace: bool = False, report: bool = True) -> Path:
        """Writes the run folder: the files that `railcrack run` would have written, wall times
        aside; without `report` no plots and no page. A folder that holds a run is not overwritten
        unless `replace` is set."""
        folder = Path(folder)
        if self._is_in_memory:
            self._core.save(folder, replace, report)
        elif self._folder is not None:
            if folder.exists() and any(folder.iterdir()) and not replace:
                raise FolderError(f"{folder} is not empty; replace=True overwrites it")
            shutil.copytree(self._folder, folder, dirs_exist_ok=True)
        return folder

    def report(self, path: str | os.PathLike[str] | None = None) -> str:
        """The HTML report, one self-contained page: returned, and written to `path` if given. Data
        missing from the run folder, as in a study, are computed again."""
        with tempfile.TemporaryDirectory(prefix="railcrack-") as scratch:
            folder = self._folder
            if folder is None or not (folder / "report.html").is_file():
                copy = Path(scratch) / "run"
                if folder is not None:
                    shutil.copytree(folder, copy)
                self._core.report(copy)
                folder = copy
            page = (folder / "report.html").read_text(encoding="utf-8")
        if path is not None:
            Path(path).write_text(page, encoding="utf-8")
        return page

    def fields(self, step: int = 0, xc_over_a: float = 0.0, *, threads: int | None = None) -> Any:
        """Displacement (mm) and stress (MPa) around the cracks in `step` with the wheel at the
        output position nearest to `xc_over_a`, in space jumps and tractions of the crack faces and
        K along the front: a `pyvista.UnstructuredGrid` where pyvista is installed, a `FieldGrid`
        otherwise.

        For a run in memory the step is computed again; a run folder contains the fields requested
        in [output] and those of step 0. The engine `dislocation` computes no fields.
        """
        grid = self.field_grid(step, xc_over_a, threads=threads)
        try:
            import pyvista  # noqa: F401
        except ImportError:
            return grid
        return grid.to_pyvista()

    def field_grid(self, step: int = 0, xc_over_a: float = 0.0, *, threads: int | None = None) -> FieldGrid:
        """Like `fields`, but always returns a `FieldGrid`."""
        if not 0 <= step <= self.steps:
            raise BadInput(f"step = {step}: must be from 0 to {self.steps}")
        path = self._stored_field(step, xc_over_a)
        if path is not None:
            return FieldGrid(_railcrack.Run.read_grid(path))
        grid = self._core.fields_at(step, xc_over_a, threads)
        if grid is None:
            stored = sorted({(s, p) for s, p, _ in self._core.stored_fields()})
            have = ", ".join(f"step {s} position {p}" for s, p in stored) or "none"
            raise BadInput(
                f"no field of step {step} at x_c/a = {xc_over_a}: only the engines xfem and space compute fields, and a run "
                f"folder contains those requested in [output] ({have})"
            )
        return FieldGrid(grid)

    def _stored_field(self, step: int, xc_over_a: float) -> Path | None:
        stored = {position: path for s, position, path in self._core.stored_fields() if s == step}
        if not stored:
            return None
        history = self.history(step)
        position = int(np.argmin(np.abs(history[:, 0] - xc_over_a))) + 1
        return stored.get(position)

    def _repr_html_(self) -> str:
        last = self.growth.where(step=self.growth["step"].max()) if self.growth.rows else None
        rows: list[tuple[str, Any]] = [("engine", self.summary["engine"]), ("increments", self.steps), ("stop", self.stop or "")]
        rows.append(("load cycles", f"{self.summary['load_cycles']:.6g}"))
        for i in range(last.rows if last is not None else 0):
            tip = {name: last[name][i] for name in ("crack", "tip", "length_mm", "kink_angle_deg", "rate_mm_per_cycle")}  # type: ignore[index]
            what = f"length {tip['length_mm']:.3f} mm, {tip['rate_mm_per_cycle']:.3g} mm per cycle, kink {tip['kink_angle_deg']:.1f}°"
            rows.append((f"crack {tip['crack']} tip {tip['tip']}", what))
        rows.extend(("warning", text) for text in self.warnings)
        return facts(self.title, rows)
