"""Plots with matplotlib. Every function draws on `ax`, or on new axes by default, and returns the
axes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ._results import RunResults
from ._table import Table, under

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(layout="constrained")
    return axes


def _tips(run: RunResults) -> list[tuple[int, int]]:
    growth = run.growth
    return sorted({(int(c), int(t)) for c, t in zip(growth["crack"], growth["tip"], strict=True)})


def _name(run: RunResults, crack: int, tip: int) -> str:
    tips = _tips(run)
    if len(tips) == 1:
        return ""
    many = sum(1 for c, _ in tips if c == crack) > 1
    return f"crack {crack}" + (f" tip {tip}" if many else "")


def _section(axes: Axes, across: str) -> Axes:
    """A section of the rail, to scale, with its surface at y = 0."""
    left, right = axes.get_xlim()
    axes.plot([left, right], [0.0, 0.0], color="0.5", linewidth=0.8, zorder=0)
    axes.set_xlim(left, right)
    axes.set_aspect("equal")
    axes.set_xlabel(across)
    axes.set_ylabel("y (mm)")
    return axes


def _is_in_space(run: RunResults) -> bool:
    return "phi_deg" in run.growth


def _deepest(run: RunResults, crack: int) -> int:
    """The point of the front in space that is deepest in step 0."""
    rows = run.growth.where(step=0, crack=crack)
    return int(rows["tip"][np.argmin(rows["tip_y_mm"])])


class RunPlots:
    """Plots of a run: `run.plot.sif()`, `.paths()`, `.length()`, `.faces()`."""

    def __init__(self, run: RunResults) -> None:
        self._run = run

    def __call__(self) -> Any:
        """All four plots in one figure, without the faces if the run folder has none."""
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots(2, 2, figsize=(11, 8), layout="constrained")
        self.sif(ax=axes[0, 0])
        self.paths(ax=axes[0, 1])
        self.length(ax=axes[1, 0])
        if self._run.has("faces"):
            self.faces(ax=axes[1, 1])
        else:
            axes[1, 1].set_axis_off()
        return figure

    def sif(self, step: int = 0, crack: int = 1, tip: int | None = None, *, ax: Axes | None = None) -> Axes:
        """K_I and K_II of a tip over the stabilised passage of a step, by default of the first one;
        in space K_III too, by default at the deepest point of the front."""
        axes: Axes = _axes(ax)
        in_space = _is_in_space(self._run)
        if tip is None:
            tip = _deepest(self._run, crack) if in_space else 1
        xc, ki, kii = self._run.history(step, crack, tip).T
        axes.plot(xc, ki, label="$K_I$")
        axes.plot(xc, kii, label="$K_{II}$")
        name = _name(self._run, crack, tip)
        if in_space:
            rows = under(self._run.sif.where(step=step, crack=crack, tip=tip))
            rows = rows.where(passage=rows["passage"].max())
            axes.plot(xc, rows["kiii_mpa_sqrt_m"], label="$K_{III}$")
            whose = f"crack {crack} " if len(np.unique(self._run.growth["crack"])) > 1 else ""
            name = f"{whose}front at {rows['phi_deg'][0]:.4g}°"
        axes.axhline(0.0, color="0.7", linewidth=0.8, zorder=0)
        axes.set_xlabel("$x_c / a$")
        axes.set_ylabel(r"K (MPa$\sqrt{\mathrm{m}}$)")
        axes.set_title(" ".join(filter(None, [f"step {step}", name])))
        axes.legend()
        return axes

    def paths(self, *, ax: Axes | None = None) -> Axes:
        """The cracks at the start and at the end, to scale, and the tips of every step; in space the
        fronts of every step, seen along the rail."""
        axes: Axes = _axes(ax)
        growth = self._run.growth
        if _is_in_space(self._run):
            for step, crack in np.unique(np.stack([growth["step"], growth["crack"]], axis=1), axis=0):
                front = growth.where(step=step, crack=crack)
                width = 3.0 if step == 0 else 1.0
                axes.plot(front["tip_z_mm"], front["tip_y_mm"], color=f"C{(crack - 1) % 10}", linewidth=width)
            return _section(axes, "z (mm)")
        for i, (first, last) in enumerate(zip(self._run.cracks(0), self._run.cracks(), strict=False)):
            colour = f"C{i % 10}"
            axes.plot(*last.T, color=colour, linewidth=1.2)
            axes.plot(*first.T, color=colour, linewidth=3.0, solid_capstyle="round")
        axes.plot(growth["tip_x_mm"], growth["tip_y_mm"], ".", color="0.2", markersize=3)
        return _section(axes, "x (mm)")

    def length(self, *, ax: Axes | None = None) -> Axes:
        """Length of each crack against load cycles; both semi-axes for cracks in space."""
        axes: Axes = _axes(ax)
        growth, last = self._run.growth, {}
        if _is_in_space(self._run):
            cracks = np.unique(growth["crack"])
            for crack in cracks:
                rows = growth.where(crack=crack, tip=growth["tip"].min())
                whose = f"crack {crack} " if len(cracks) > 1 else ""
                axes.plot(rows["load_cycles"], rows["length_mm"], ".-", label=f"{whose}down the dip")
                axes.plot(rows["load_cycles"], rows["surface_half_length_mm"], ".-", label=f"{whose}along the surface")
            axes.set_xlabel("load cycles")
            axes.set_ylabel("semi-axis (mm)")
            axes.legend()
            return axes
        for crack, tip in _tips(self._run):
            last[crack] = tip
        for crack, tip in last.items():
            rows = growth.where(crack=crack, tip=tip)
            axes.plot(rows["load_cycles"], rows["length_mm"], ".-", label=_name(self._run, crack, tip) or None)
        axes.set_xlabel("load cycles")
        axes.set_ylabel("length (mm)")
        if len(last) > 1:
            axes.legend()
        return axes

    def faces(
        self, step: int = 0, crack: int = 1, *, xc_over_a: float = 0.0, ax: Axes | None = None
    ) -> Axes:
        """Status of the faces of a crack through the stabilised passage: position by arc length; in
        space over the faces, with the wheel at the output position nearest to `xc_over_a`."""
        from matplotlib.colors import ListedColormap
        from matplotlib.patches import Patch

        axes: Axes = _axes(ax)
        rows = under(self._run.faces.where(step=step, crack=crack))
        positions = np.unique(rows["position"])
        words, colours = ["open", "stick", "slip"], ["#f2f0e9", "#7a9cc6", "#d1495b"]
        codes = np.select([rows["status"] == word for word in words], range(3))
        sif = under(self._run.sif.where(step=step, crack=crack))
        sif = sif.where(passage=sif["passage"].max(), tip=sif["tip"].min())
        handles = [Patch(color=c, label=w) for c, w in zip(colours, words, strict=True)]
        if _is_in_space(self._run):
            nearest = int(np.argmin(np.abs(sif["xc_over_a"] - xc_over_a)))
            here = rows["position"] == sif["position"][nearest]
            axes.scatter(
                rows["z_mm"][here], rows["s_mm"][here], c=codes[here], cmap=ListedColormap(colours), vmin=0, vmax=2
            )
            axes.legend(handles=handles, loc="center left", bbox_to_anchor=(1.0, 0.5))
            axes.invert_yaxis()
            axes.set_aspect("equal")
            axes.set_xlabel("z (mm)")
            axes.set_ylabel("down the dip (mm)")
            axes.set_title(f"step {step}, $x_c / a$ = {sif['xc_over_a'][nearest]:.4g}")
            return axes
        s = rows["s_mm"].reshape(len(positions), -1)[0]
        codes = codes.reshape(len(positions), -1).T
        axes.pcolormesh(sif["xc_over_a"], s, codes, cmap=ListedColormap(colours), vmin=0, vmax=2, shading="nearest")
        axes.legend(handles=handles, loc="upper right")
        axes.set_xlabel("$x_c / a$")
        axes.set_ylabel("arc length from the mouth (mm)")
        axes.set_title(f"step {step}")
        return axes


class StudyResults(Protocol):
    """Results of a study for its plots."""

    @property
    def results(self) -> Table:
        """A row per run."""

    @property
    def numbers(self) -> Iterable[int]:
        """Numbers of the runs."""

    def run(self, number: int) -> RunResults:
        """The results of a run."""


class StudyPlots:
    """Plots of a study: `study.plot.scatter(key, column)`, `.paths()`."""

    def __init__(self, study: StudyResults) -> None:
        self._study = study

    def scatter(self, key: str, column: str, *, ax: Axes | None = None) -> Axes:
        """A column of the table against a varying key or another column."""
        axes: Axes = _axes(ax)
        table = self._study.results
        axes.plot(table[key], table[column], "o")
        axes.set_xlabel(key)
        axes.set_ylabel(f"{column}" + (f" ({table.units[column]})" if table.units[column] else ""))
        return axes

    def paths(self, *, ax: Axes | None = None) -> Axes:
        """The final cracks of all runs."""
        axes: Axes = _axes(ax)
        for number in self._study.numbers:
            for crack in self._study.run(number).cracks():
                axes.plot(*crack.T, linewidth=0.8, color="C0", alpha=0.5)
        axes.set_aspect("equal")
        axes.set_xlabel("x (mm)")
        axes.set_ylabel("y (mm)")
        return axes
