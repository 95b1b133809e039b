"""Results as attributes, printed, labelled, with units."""

from __future__ import annotations

import json
import pickle

import numpy as np
import pytest

import railcrack as rc
from railcrack._units import unit_of

from conftest import CASES, SMALL


@pytest.fixture(scope="module")
def decided() -> rc.Run:
    """A head check under traffic with an inspection, as in the explorer."""
    return rc.Case.read(CASES.parent / "crates/railcrack-cli/templates/explorer.toml").with_(growth={"steps": None}, passage={"positions": 61}).run()


def test_the_decision_as_attributes(decided: rc.Run, run: rc.Run) -> None:
    decision = decided.summary["decision"]
    assert decided.verdict is not None and decided.inspection is not None
    assert decided.verdict.level == decision["verdict"]["level"] and decided.verdict.reasons[0].text in str(decided.verdict)
    assert decided.inspection.interval_mgt == decision["inspection"]["interval_mgt"]
    life = decided.life
    assert life.nominal_mgt == decision["failure"]["mgt"] and life.mode == decision["failure"]["mode"] == "depth"
    # The path that governs the verdict, not that of the tables.
    assert life.mgt == decision["paths"][life.governed_by] == decided.inspection.mgt_to_critical
    assert f"after {life.mgt:.3g} million" in decided.verdict.reasons[0].text
    assert str(life) == f"{life.mgt:.3g} million gross tonnes, {life.governed_by} path"
    assert decided.decision == decision
    assert pickle.loads(pickle.dumps(decided)).life == decided.life
    # Without axle loads.
    assert run.life.mgt is None and run.life.load_cycles == run.summary["load_cycles"] > 0.0
    assert str(run.life).startswith("no failure known within ")
    assert run.inspection is None and run.decision is None


def test_tables_print_their_numbers(run: rc.Run) -> None:
    text = str(run.growth)
    assert f"{run.growth.length_mm[0]:.6g}" in text and "mm/cycle" in text and "steps-done" in text
    assert "…" in str(run.sif) and max(map(len, str(run.sif).splitlines())) <= 200
    assert "\n" not in repr(run.sif) and "rows" in repr(run.sif)
    assert len(run.growth) == run.growth.rows == 3 and "step" in run.growth and len(list(run.growth)) > 10


def test_a_missing_column_names_its_neighbour(run: rc.Run) -> None:
    with pytest.raises(KeyError, match="did you mean ki_mpa_sqrt_m"):
        run.sif["ki_mpa_sqrtm"]
    with pytest.raises(AttributeError, match="did you mean length_mm"):
        run.growth.lenght_mm
    with pytest.raises(KeyError, match="did you mean step"):
        run.sif.where(steps=0)


def test_a_passage_is_one_line() -> None:
    found = rc.passage(rc.DislocationBody(rc.crack(0.0, 6.0, 30.0), elements=8), rc.Hertz(845.0, 6.75), positions=13)
    assert "\n" not in repr(found) and len(repr(found)) < 100 and "13 positions" in repr(found)


def test_labelled_results(run: rc.Run) -> None:
    pytest.importorskip("xarray")
    data = run.to_xarray()
    assert dict(data.sizes) == {"step": 3, "crack": 1, "tip": 1, "position": 61}
    one = data.sel(step=1, crack=1, tip=1)
    assert np.array_equal(one["kii_mpa_sqrt_m"], run.history(step=1)[:, 2])
    assert data["xc_over_a"].dims[-1] == "position" and data["length_mm"].dims == ("step", "crack", "tip")
    assert np.array_equal(data["length_mm"].squeeze(), run.growth.length_mm)
    assert data["rate_mm_per_cycle"].attrs["units"] == "mm/cycle"
    assert run.growth.to_pandas().attrs["units"]["rate_mm_per_cycle"] == "mm/cycle"
    faces = run.faces.to_xarray()
    assert set(faces.dims) == {"step", "position", "point"} and faces["s_mm"].dims == ("step", "point")
    assert set(np.unique(faces["status"])) <= {"open", "stick", "slip", ""}
    first = run.faces.where(step=0)
    assert np.array_equal(faces["opening_mm"].sel(step=0).to_numpy()[:, : first.rows // 61].ravel(), first.opening_mm)
    assert run.residual.to_xarray().sizes == {"depth_mm": 0}
    first_passage = run.sif.where(passage=1).to_xarray()
    assert first_passage["passage"].max() == 1


def test_labelled_results_of_several_wheels_and_cracks() -> None:
    pytest.importorskip("xarray")
    contact = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n"
    wheels = "".join(
        f"[[wheel]]\nname = \"{name}\"\nshare = 0.5\naxle_load_t = 20\n"
        f"contact = {{ peak_pressure_mpa = {p}, half_width_mm = 6.75, friction = 0.1 }}\n"
        for name, p in (("a", 845.0), ("b", 600.0))
    )
    second = "[[crack]]\nmouth_mm = 9.0\nlength_mm = 5.0\nangle_deg = 25.0\nfriction = 0.3\n"
    run = rc.Case((SMALL + second).replace(contact, wheels).replace("steps = 2", "steps = 1")).run()
    data = run.to_xarray()
    assert dict(data.sizes) == {"step": 2, "wheel": 2, "crack": 2, "tip": 1, "position": 61}
    ours = data["ki_mpa_sqrt_m"].sel(step=1, wheel=2, crack=2, tip=1)
    assert np.array_equal(ours, run.history(step=1, crack=2, wheel=2)[:, 1])


def test_labelled_fronts_in_space() -> None:
    pytest.importorskip("xarray")
    run = rc.Case.read(CASES / "head-check-space.toml").with_(growth={"steps": 1}, passage={"positions": 13}).run()
    data = run.to_xarray()
    assert data.sizes["tip"] == 13 and data["phi_deg"].dims == ("tip",)
    front = data.swap_dims(tip="phi_deg").sel(step=0, crack=1, phi_deg=90.0)
    rows = run.sif.where(step=0, phi_deg=90.0)
    assert np.array_equal(front["kiii_mpa_sqrt_m"], rows.where(passage=rows.passage.max()).kiii_mpa_sqrt_m)


def columns_of(run: rc.Run, decided: rc.Run) -> set[str]:
    tables = (run.sif, run.growth, run.faces, run.residual, decided.growth, decided.sif)
    return {column for table in tables for column in table} | {"tgamma_n", "fx_kn", "mgt_per_year", "gap_um", "wall_s", "p05_months"}


def test_every_unit_is_one(run: rc.Run, decided: rc.Run) -> None:
    pint = pytest.importorskip("pint")
    registry = pint.UnitRegistry()
    for column in columns_of(run, decided):
        if unit := unit_of(column):
            registry.parse_units(unit)
    assert registry(unit_of("rate_mm_per_cycle")) == registry("1 mm / cycle")
    assert registry("5.0 " + unit_of("ki_mpa_sqrt_m")).check("[pressure] * [length] ** 0.5")
    assert unit_of("kii_peak_mpa_sqrt_m") == "MPa m^(1/2)" and unit_of("step") == unit_of("turns_in_steps") == ""


def test_every_column_with_a_unit_in_its_name_has_it(run: rc.Run, decided: rc.Run) -> None:
    """Numbers without a unit are counts, ratios and codes."""
    pure = {"step", "passage", "crack", "tip", "position", "segment", "wheel", "xc_over_a", "rival_ratio", "stop", "status", "jump"}
    for column in columns_of(run, decided):
        assert unit_of(column) or column in pure or column.startswith("share"), column


def test_the_axes_of_a_study_have_units() -> None:
    pytest.importorskip("matplotlib").use("Agg")
    study = rc.Study.of(rc.Case(SMALL).with_(growth={"steps": 0}), contact={"friction": [0.1, 0.2]}).map()
    assert study.plot.scatter("contact.friction", "rate_mm_per_cycle").get_ylabel() == "rate_mm_per_cycle (mm/cycle)"


def test_the_summary_is_json(decided: rc.Run) -> None:
    json.dumps(decided.summary)
