"""A crack in space in Python."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import railcrack as rc

from conftest import CASES
from test_run import TABLES, assert_same_bits


@pytest.fixture(scope="module")
def case() -> rc.Case:
    """A head check with a curved front, one increment."""
    return rc.Case.read(CASES / "head-check-space.toml").with_(growth={"steps": 1}, passage={"positions": 13})


@pytest.fixture(scope="module")
def run(case: rc.Case) -> rc.Run:
    """Its run."""
    return case.run()


def test_the_same_bits_as_the_command(case: rc.Case, run: rc.Run, command: Callable[..., str], tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(case.to_toml())
    command("run", tmp_path / "case.toml", "--out", tmp_path / "run", "--quiet")
    for file, table in zip(TABLES, (run.sif, run.growth, run.faces), strict=True):
        assert_same_bits(table, tmp_path / "run" / file)
    assert "semi-axes" in str(case.check())
    assert "along the front" in run.report()
    opened = rc.Run.open(tmp_path / "run")
    assert np.array_equal(opened.sif["kiii_mpa_sqrt_m"], run.sif["kiii_mpa_sqrt_m"])


def test_fields_are_on_the_faces_and_along_the_front(run: rc.Run) -> None:
    grid = run.field_grid(0, 0.0)
    # Semi-axes 4 mm at 30° and 6 mm: the deepest point, and the ends of the front.
    assert np.allclose(grid.points.min(axis=0), [0.0, -2.0, -6.0], atol=1e-12)
    assert np.allclose(grid.points.max(axis=0), [4.0 * np.cos(np.radians(30.0)), 0.0, 6.0], atol=1e-12)
    deepest = int(np.argmin(grid.points[:, 1]))
    sif = run.sif.where(step=0, phi_deg=90.0)
    here = sif.where(passage=sif["passage"].max(), position=7)
    for name in ("kii_mpa_sqrt_m", "kiii_mpa_sqrt_m"):
        assert grid.point_data[name][deepest] == pytest.approx(here[name][0], abs=1e-12)


def test_plots(run: rc.Run) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    run.plot()
    sif = run.plot.sif()
    assert [line.get_label() for line in sif.get_lines()][:3] == ["$K_I$", "$K_{II}$", "$K_{III}$"]
    assert "90°" in sif.get_title()
    fronts = run.plot.paths().get_lines()
    assert np.ptp(fronts[0].get_xdata()) == pytest.approx(12.0) and len(fronts[0].get_xdata()) == 13
    faces = run.plot.faces(xc_over_a=1.0).collections[0]
    assert len(faces.get_offsets()) == 54
    assert run.plot.length().get_lines()[1].get_ydata()[0] == 6.0


def test_a_law_of_ones_own_and_no_direction(case: rc.Case) -> None:
    run = case.run(law=lambda history: 1e-7)
    assert (run.growth["rate_mm_per_cycle"] == 1e-7).all()
    with pytest.raises(rc.BadInput, match="in their plane"):
        case.run(direction=lambda history: 0.0)
