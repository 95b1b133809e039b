"""Studies, computed here and by several processes."""

from __future__ import annotations

import concurrent.futures
import filecmp
import multiprocessing
import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import railcrack as rc

from conftest import SMALL
from dying import Dying

STUDY = SMALL.replace("friction = 0.1", "friction = [0.1, 0.2, 0.3]", 1).replace("angle_deg = 20.0", "angle_deg = [20.0, 25.0]")
STUDY = STUDY.replace("steps = 2", "steps = 0")
TABLES = ["sif.csv", "growth.csv"]


@pytest.fixture(scope="module")
def swept(command: Callable[..., str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The study by the command."""
    folder = tmp_path_factory.mktemp("swept")
    (folder / "study.toml").write_text(STUDY)
    command("sweep", folder / "study.toml", "--out", folder / "study", "--quiet")
    return folder / "study"


def assert_same_study(ours: Path, theirs: Path) -> None:
    assert filecmp.cmp(ours / "summary.csv", theirs / "summary.csv", shallow=False)
    for run in sorted((theirs / "runs").iterdir()):
        for table in TABLES:
            assert filecmp.cmp(run / table, ours / "runs" / run.name / table, shallow=False), run.name


def test_here(swept: Path, tmp_path: Path) -> None:
    study = rc.Study(STUDY)
    assert len(study) == 6 and list(study.keys) == ["contact.friction", "crack[1].angle_deg"]
    seen: list[rc.Step] = []
    done = study.map(out=tmp_path / "study", progress=seen.append)
    assert_same_study(done.folder, swept)
    assert seen[-1].done == seen[-1].total == 6
    table = done.results
    assert table["contact.friction"].tolist() == [0.1, 0.1, 0.2, 0.2, 0.3, 0.3]
    assert table["state"].tolist() == ["done"] * 6
    assert done.run(3).growth.rows == 1 and done.case(3).to_toml() == done.run(3).case.to_toml()
    opened = rc.Study.open(swept)
    assert np.array_equal(opened.results["rate_mm_per_cycle"], table["rate_mm_per_cycle"])
    with pytest.raises(rc.FolderError):
        study.map(out=tmp_path / "study")
    study.map(out=tmp_path / "study", resume=True)
    assert "6" in opened._repr_html_() and "6 runs" in repr(pickle.loads(pickle.dumps(opened)))


def test_the_run_of_a_study_has_report_and_plots(swept: Path, tmp_path: Path) -> None:
    """Its folder has neither faces nor K of every step: the page is computed again, beside the folder."""
    study = rc.Study.open(swept)
    run = study.run(1)
    before = sorted(file.name for file in (swept / "runs" / "001").iterdir())
    page = run.report(tmp_path / "run.html")
    assert page == study.case(1).run().report()
    assert before == sorted(file.name for file in (swept / "runs" / "001").iterdir())
    with pytest.raises(rc.FolderError, match=r"no faces.csv: \[output\]"):
        _ = run.faces
    pytest.importorskip("matplotlib").use("Agg")
    assert len(run.plot().axes) == 4


@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
@pytest.mark.parametrize("kind", ["processes", "forked", "threads", "pool"])
def test_by_an_executor(kind: str, swept: Path, tmp_path: Path) -> None:
    # A forked process has none of the threads that read the study here.
    context = multiprocessing.get_context("fork" if kind == "forked" else "spawn")
    study = rc.Study(STUDY)
    if kind == "pool":
        with context.Pool(2) as pool:
            done = study.map(pool, out=tmp_path / "study")
    else:
        executor = (
            concurrent.futures.ProcessPoolExecutor(2, mp_context=context)
            if kind in ("processes", "forked")
            else concurrent.futures.ThreadPoolExecutor(2)
        )
        with executor:
            done = study.map(executor, out=tmp_path / "study")
    assert_same_study(done.folder, swept)


def test_runs_without_folders_travel_and_are_packed(swept: Path, tmp_path: Path) -> None:
    study = rc.Study(STUDY + "[output]\nrun_folders = false\n")
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        away = study.map(executor, out=tmp_path / "away")
    here = study.map(out=tmp_path / "here")
    for done in (away, here):
        assert done.results["state"].tolist() == ["done"] * 6
        assert not [run for run in (done.folder / "runs").glob("*") if any(run.iterdir())]
        assert np.array_equal(done.results["rate_mm_per_cycle"], rc.Study.open(swept).results["rate_mm_per_cycle"])
        assert done.run(3).growth.rows == 1
    assert filecmp.cmp(away.folder / "runs.parquet", here.folder / "runs.parquet", shallow=False)


def test_a_killed_worker_loses_nothing_that_was_computed(swept: Path, tmp_path: Path) -> None:
    context = multiprocessing.get_context("spawn")
    study = rc.Study(STUDY)
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=context) as executor:
        with pytest.raises(rc.StudyIncomplete) as raised:
            study.map(Dying(executor, 3, tmp_path / "study"), out=tmp_path / "study")
    assert 3 in raised.value.missing and raised.value.study is not None
    states = raised.value.study.results["state"].tolist()
    assert states.count("missing") == len(raised.value.missing) and states[2] == "missing"
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as executor:
        done = study.map(executor, out=tmp_path / "study", resume=True)
    assert_same_study(done.folder, swept)


def test_runs_that_fail_are_named_and_the_others_are_there(tmp_path: Path) -> None:
    # Points of the faces so close that the elements do not tell them apart.
    upright = STUDY.replace("angle_deg = [20.0, 25.0]", "angle_deg = 90.0").replace('"dislocation"', '"xfem"')
    wrong = rc.Study(upright + "[mesh]\nelement_size_mm = 0.3\ninterface_spacing_mm = [0.3, 0.1]\n")
    with pytest.raises(rc.StudyIncomplete) as raised:
        wrong.map(out=tmp_path / "study")
    assert len(raised.value.failed) == 3 and "interface_spacing_mm" in str(raised.value)
    assert raised.value.study is not None
    assert raised.value.study.results["state"].tolist().count("done") == 3


def test_the_run_of_a_study_keeps_its_folder() -> None:
    run = rc.Study(STUDY).map().run(2)  # the study itself is gone
    assert run.case.steps == 0 and run.history().shape == (61, 3)


def test_errors_of_a_study() -> None:
    with pytest.raises(rc.CaseError, match="nothing varies"):
        rc.Study(SMALL)
    with pytest.raises(rc.CaseError) as raised:
        rc.Study(STUDY.replace("0.3]", '"x"]'))
    assert raised.value.errors[0].line is not None
