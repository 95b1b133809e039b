"""Runs in memory, and the same bits as the command's."""

from __future__ import annotations

import filecmp
import json
import pickle
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import railcrack as rc

from conftest import CASES, SMALL

TABLES = ["sif.csv", "growth.csv", "faces.csv"]


def read_csv(path: Path) -> dict[str, list[str]]:
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    columns = zip(*(line.split(",") for line in lines[1:]), strict=True)
    return dict(zip(lines[0].split(","), map(list, columns), strict=True))


def assert_same_bits(table: rc.Table, path: Path) -> None:
    stored = read_csv(path)
    assert table.columns == list(stored)
    for name, texts in stored.items():
        values = table[name]
        if values.dtype.kind == "U":
            assert values.tolist() == texts, name
        else:
            read = np.array([float(text) if text else np.nan for text in texts])
            assert np.array_equal(values, read, equal_nan=True), name


def test_the_same_bits_as_the_command(run: rc.Run, command: Callable[..., str], tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(SMALL)
    command("run", tmp_path / "case.toml", "--out", tmp_path / "theirs", "--quiet", "--threads", 1)
    ours = run.save(tmp_path / "ours")
    for name in [*TABLES, "case.toml", "plots/kii.svg", "plots/paths.svg"]:
        assert filecmp.cmp(ours / name, tmp_path / "theirs" / name, shallow=False), name
    for name, table in zip(TABLES, (run.sif, run.growth, run.faces), strict=True):
        assert_same_bits(table, tmp_path / "theirs" / name)
    numbers = [json.loads((folder / "summary.json").read_text()) for folder in (ours, tmp_path / "theirs")]
    for summary in numbers:
        for key in ("wall_s", "phases_s", "peak_memory_mb"):
            del summary[key]
    assert numbers[0] == numbers[1]
    command("verify", ours)


@pytest.mark.parametrize("name", ["rail-curve", "plastic-stress", "junction", "winter-rail"])
def test_shipped_cases_have_the_bits_of_the_command(name: str, command: Callable[..., str], tmp_path: Path) -> None:
    case = rc.Case.read(CASES / f"{name}.toml").with_(growth={"steps": 1}, solver={"engine": "dislocation"})
    command("run", CASES / f"{name}.toml", "--engine", "dislocation", "--steps", 1, "--out", tmp_path / "run", "--quiet")
    run = case.run()
    for file, table in zip(TABLES, (run.sif, run.growth, run.faces), strict=True):
        assert_same_bits(table, tmp_path / "run" / file)


def test_a_mix_of_wheels_has_the_bits_of_the_command(command: Callable[..., str], tmp_path: Path) -> None:
    contact = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n"
    assert contact in SMALL
    wheels = "".join(
        f"[[wheel]]\nname = \"{name}\"\nshare = {share}\naxle_load_t = {load}\n"
        f"contact = {{ peak_pressure_mpa = {pressure}, half_width_mm = 6.75, friction = 0.1 }}\n"
        for name, share, load, pressure in [("loaded", 0.75, 22.5, 845.0), ("empty", 0.25, 6.0, 600.0)]
    )
    text = SMALL.replace(contact, wheels).replace("steps = 2", "steps = 1")
    (tmp_path / "mix.toml").write_text(text)
    command("run", tmp_path / "mix.toml", "--out", tmp_path / "run", "--quiet")
    run = rc.Case(text).run()
    for file, table in zip(TABLES, (run.sif, run.growth, run.faces), strict=True):
        assert_same_bits(table, tmp_path / "run" / file)
    opened = rc.Run.open(tmp_path / "run")
    assert opened.sif.columns == run.sif.columns and "wheel" in run.sif and "share_wheel_2" in run.growth
    with pytest.raises(rc.BadInput, match="mix"):
        rc.Case(text).run(law=lambda history: 0.0)


def test_a_folder_and_a_pickle_have_the_tables(run: rc.Run, tmp_path: Path) -> None:
    opened = rc.Run.open(run.save(tmp_path / "run", report=False))
    copies = [opened, pickle.loads(pickle.dumps(run)), pickle.loads(pickle.dumps(opened))]
    for copy in copies:
        for ours, theirs in [(run.sif, copy.sif), (run.growth, copy.growth), (run.faces, copy.faces)]:
            assert ours.columns == theirs.columns
            for column in ours:
                equal_nan = ours[column].dtype.kind == "f"
                assert np.array_equal(ours[column], theirs[column], equal_nan=equal_nan), column
        assert copy.case == run.case and copy.stop == run.stop == "steps-done"
    with pytest.raises(rc.FolderError, match="run"):
        run.save(tmp_path / "run")
    run.save(tmp_path / "run", replace=True, report=False)


def test_the_run_with_one_thread_and_with_two(case: rc.Case, run: rc.Run) -> None:
    for threads in (1, 2):
        assert np.array_equal(case.run(threads=threads).sif.ki_mpa_sqrt_m, run.sif.ki_mpa_sqrt_m)


def test_tables_convert(run: rc.Run) -> None:
    pandas = pytest.importorskip("pandas")
    frame = run.faces.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame) == run.faces.columns
    assert frame["status"].cat.categories.tolist() == ["open", "stick", "slip"]
    assert np.shares_memory(frame["slip_mm"].to_numpy(), run.faces.slip_mm)
    assert frame.attrs["units"]["s22_mpa"] == "MPa"
    assert run.sif.units["ki_mpa_sqrt_m"] == "MPa m^(1/2)" and run.growth.units["kink_angle_deg"] == "degree"
    xarray = pytest.importorskip("xarray")
    data = run.growth.to_xarray()
    assert isinstance(data, xarray.Dataset) and data["length_mm"].attrs["units"] == "mm"
    assert run.growth["stop"].tolist() == ["", "", "steps-done"]
    assert run.growth.where(step=1).rows == 1


def test_arrow_streams(run: rc.Run) -> None:
    arrow = pytest.importorskip("pyarrow")
    for table in (run.sif, run.growth, run.faces, run.residual):
        for _ in range(3):
            read = arrow.table(table)
            assert read.column_names == table.columns and read.num_rows == table.rows
        for column in table:
            got = read[column].to_pylist()
            want = [None if v == "" or (isinstance(v, float) and np.isnan(v)) else v for v in table[column].tolist()]
            assert got == want, column
    values = arrow.table(run.sif)["ki_mpa_sqrt_m"].chunk(0)
    assert values.buffers()[1].address == run.sif.ki_mpa_sqrt_m.ctypes.data, "not a copy"
    from railcrack import _arrow

    del read, values
    run.sif.__arrow_c_stream__()  # given to nobody
    assert not _arrow._kept and not _arrow._streams
    polars = pytest.importorskip("polars")
    frame = run.faces.to_polars()
    assert isinstance(frame, polars.DataFrame) and frame.height == run.faces.rows
    assert frame["slip_mm"].to_numpy().tolist() == run.faces.slip_mm.tolist()


def test_plots_and_report(run: rc.Run, tmp_path: Path) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    run.plot().savefig(tmp_path / "all.png")
    axes = run.plot.sif()
    assert axes.get_xlabel() == "$x_c / a$" and len(axes.get_lines()[0].get_xdata()) == 61
    page = run.report(tmp_path / "r.html")
    assert "<html" in page and (tmp_path / "r.html").read_text() == page


def test_fields() -> None:
    case = rc.Case(SMALL).with_(solver={"engine": "xfem"}, mesh={"element_size_mm": 0.6}, passage={"positions": 13})
    run = case.run()
    for step in (0, 1):
        grid = run.field_grid(step, 1.0)
        stress = grid.point_data["stress_mpa"]
        assert stress.shape == (len(grid.points), 6) and np.isfinite(stress).all()
        assert set(np.unique(grid.cell_data["face"])) == {-1.0, 0.0, 1.0}
    pyvista = pytest.importorskip("pyvista")
    assert isinstance(run.fields(0, 1.0), pyvista.UnstructuredGrid)
    with pytest.raises(rc.BadInput, match="engines xfem"):
        rc.Case(SMALL).run().fields()


def test_a_million_rows_go_to_pandas_at_once(run: rc.Run, tmp_path: Path) -> None:
    """Within a tenth of a second, since nothing is copied: it is a thousandth on an idle core. The rows of
    step 0 stand in the run folder again and again, as passages."""
    pytest.importorskip("pandas")
    folder = run.save(tmp_path / "run", report=False)
    lines = (folder / "sif.csv").read_text().splitlines()
    first = [line.split(",", 2)[2] for line in lines if line.startswith("0,")]
    passages = 1_000_000 // len(first) + 1
    rows = [line for line in lines if not line[0].isdigit()]
    rows.extend(f"0,{passage},{rest}" for passage in range(1, passages + 1) for rest in first)
    rows.extend(line for line in lines if line[0].isdigit() and not line.startswith("0,"))
    (folder / "sif.csv").write_text("\n".join(rows) + "\n")
    sif = rc.Run.open(folder).sif
    assert sif.rows > 1_000_000 and np.array_equal(sif.where(step=1).kii_mpa_sqrt_m, run.sif.where(step=1).kii_mpa_sqrt_m)
    sif.where(crack=1).to_pandas()  # loads pandas
    begun = time.perf_counter()
    frame = sif.to_pandas()
    assert time.perf_counter() - begun < 0.1
    assert len(frame) == sif.rows and np.shares_memory(frame["ki_mpa_sqrt_m"].to_numpy(), sif.ki_mpa_sqrt_m)
