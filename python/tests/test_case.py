"""Cases: read, changed, checked, wrong."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import railcrack as rc
from railcrack import _toml

from conftest import CASES, SMALL


def test_a_dictionary_and_a_text_are_the_same_case(case: rc.Case) -> None:
    sections = {
        "title": "Small case",
        "contact": {"peak_pressure_mpa": 845.0, "half_width_mm": np.float64(6.75), "friction": 0.1},
        "passage": {"positions": np.int64(61)},
        "crack": [{"mouth_mm": 0.0, "length_mm": 6.0, "angle_deg": 20.0, "friction": 0.3}],
        "growth": {"steps": 2, "increment": 0.05},
        "solver": {"engine": "dislocation"},
    }
    assert rc.Case(sections) == case
    assert hash(rc.Case(sections)) == hash(case)
    assert (case.title, case.steps, case.engine) == ("Small case", 2, "dislocation")
    assert case.cracks[0][1] == pytest.approx([6.0 * np.cos(np.pi / 9), -6.0 * np.sin(np.pi / 9)], rel=1e-14)


@pytest.mark.parametrize("path", sorted(CASES.glob("*.toml")), ids=lambda path: path.stem)
def test_every_shipped_case_is_read_and_pickles(path: Path) -> None:
    if "study" in path.stem:
        study = rc.Study.read(path)
        copy = pickle.loads(pickle.dumps(study))
        assert copy.keys == study.keys and copy.case(1).to_toml() == study.case(1).to_toml()
        return
    case = rc.Case.read(path)
    copy = pickle.loads(pickle.dumps(case))
    assert copy == case and copy.to_toml() == case.to_toml()


@pytest.mark.parametrize(
    "sections",
    [
        {"title": "a\x7fb \x85 \\"},
        {"contact": {"peak pressure": 1.5}, "a.b": {"é": 1.0}},
        {"wheel": [{"contact": {"u.v": 1.0, "w": [{"x y": 2.0}]}}]},
        {"mixed": [1, {"a": 2}], "wheel": [], "nested": {"one": [{"b": {"c": 1}}]}},
    ],
    ids=["control characters", "keys with spaces and dots", "keys in sections of sections", "lists"],
)
def test_toml_of_any_dictionary_reads_back(sections: dict[str, Any]) -> None:
    assert _toml.read(_toml.write(sections)) == sections


def test_toml_of_numpy_and_paths() -> None:
    given = {"a": np.float32(0.5), "n": np.int64(3), "b": np.arange(3), "is": np.bool_(True), "no": None}
    given |= {"f": float("inf"), "file": Path("x.csv"), "section": {"no": None, "x": 1e300}}
    want = {"a": 0.5, "n": 3, "b": [0, 1, 2], "is": True, "f": float("inf"), "file": "x.csv", "section": {"x": 1e300}}
    assert _toml.read(_toml.write(given)) == want
    with pytest.raises(TypeError, match="not valid in a case"):
        _toml.write({"a": object()})


def test_errors_have_line_column_and_key() -> None:
    with pytest.raises(rc.CaseError) as raised:
        rc.Case(SMALL.replace("friction = 0.3", "fricton = 0.3").replace("845.0", '"high"'))
    by_key = {error.key: error for error in raised.value.errors}
    assert set(by_key) == {"contact.peak_pressure_mpa", "crack[1].friction", "crack[1].fricton"}
    wrong = by_key["contact.peak_pressure_mpa"]
    assert (wrong.line, wrong.column) == (3, 21)
    unknown = by_key["crack[1].fricton"]
    assert unknown.line == 12 and "friction" in f"{unknown.message} {unknown.help}"
    assert isinstance(raised.value, ValueError) and "case:3:21" in str(raised.value)
    copy = pickle.loads(pickle.dumps(raised.value))
    assert copy.errors == raised.value.errors


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        rc.Case.read(tmp_path / "none.toml")
    (tmp_path / "latin.toml").write_bytes(b"title = \"\xe9\"")
    with pytest.raises(rc.CaseError, match="UTF-8"):
        rc.Case.read(tmp_path / "latin.toml")


def test_a_changed_case(case: rc.Case) -> None:
    changed = case.with_(growth={"steps": 5, "critical_length_mm": 8}, crack={"friction": 0.0}, traffic={"axle_load_t": 20})
    assert (changed.steps, case.steps) == (5, 2)
    assert "critical_length_mm = 8.0" in changed.to_toml() and "axle_load_t = 20.0" in changed.to_toml()
    assert changed.with_(growth={"steps": 2, "critical_length_mm": None}, crack={"friction": 0.3}, traffic=None) == case
    two = case.with_(crack=[{"mouth_mm": x, "length_mm": 3.0, "angle_deg": 30.0, "friction": 0.1} for x in (0.0, 9.0)])
    assert len(two.cracks) == 2
    with pytest.raises(rc.CaseError, match="steps"):
        case.with_(growth={"steps": -1})


def test_files_travel_with_the_case(tmp_path: Path) -> None:
    (tmp_path / "cases").mkdir()
    (tmp_path / "profile.csv").write_text("depth_mm,sxx_mpa\n0,-200\n10,0\n")
    path = tmp_path / "cases" / "case.toml"
    path.write_text(SMALL + '[residual_stress]\nprofile = "../profile.csv"\n')
    case = rc.Case.read(path)
    packed, changed = pickle.dumps(case), case.with_(growth={"steps": 0})
    (tmp_path / "profile.csv").unlink()
    assert pickle.loads(packed).run(threads=1).residual["sxx_mpa"][0] == -200.0
    assert changed.run().residual["sxx_mpa"][0] == -200.0


def test_check(case: rc.Case) -> None:
    check = case.check()
    assert check.tips == 1 and check.face_points > 10 and check.displacement_unknowns == 0
    # A line contact without friction yields at p0 = 3.1 k (von Mises, Johnson 1985, eq. 6.4), and shakes
    # down up to p0 = 4 k (his section 9.2).
    smooth = case.with_(contact={"friction": 0.0}).check()
    assert smooth.first_yield_p0_over_k == pytest.approx(3.1, abs=0.05)
    assert smooth.shakedown_limit_p0_over_k == pytest.approx(4.0, abs=0.05)
    assert "output positions" in str(check) and "<pre>" in check._repr_html_()


def test_what_notebooks_show(case: rc.Case, run: rc.Run) -> None:
    assert "Small case" in case._repr_html_() and "steps" in repr(case)
    assert "length" in run._repr_html_() and "2 steps" in repr(run)
    assert run.sif._repr_html_().count("<tr>") == 12
