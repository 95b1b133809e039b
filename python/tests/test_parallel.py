"""Cases, runs and studies with joblib, pools of processes and Dask."""

from __future__ import annotations

import concurrent.futures
import multiprocessing
import pickle
from pathlib import Path

import numpy as np
import pytest

import railcrack as rc

from conftest import SMALL

CASES = [rc.Case(SMALL).with_(growth={"steps": 0}, contact={"friction": friction}) for friction in (0.1, 0.2, 0.3)]


@pytest.fixture(scope="module")
def done() -> rc.Study:
    """A study of these cases, in a temporary folder."""
    return rc.Study.of(CASES[0], contact={"friction": [0.1, 0.2, 0.3]}).map()


def compute(case: rc.Case) -> rc.Run:
    return case.run(threads=1)


def assert_same(runs: list[rc.Run], done: rc.Study) -> None:
    assert len(runs) == 3
    for ours, theirs in zip(runs, done, strict=True):
        assert np.array_equal(ours.sif.kii_mpa_sqrt_m, theirs.sif.kii_mpa_sqrt_m)


def test_a_computed_study_is_iterable_and_pickles(done: rc.Study, tmp_path: Path) -> None:
    assert_same([case.run() for case in done.cases], done)
    copy = pickle.loads(pickle.dumps(done))
    assert_same(list(copy), done)
    assert copy.folder != done.folder and np.array_equal(copy.results["rate_mm_per_cycle"], done.results["rate_mm_per_cycle"])
    # Results in a folder of the user stay there.
    kept = rc.Study.of(CASES[0], contact={"friction": [0.1, 0.2, 0.3]}).map(out=tmp_path / "study")
    assert pickle.loads(pickle.dumps(kept)).folder == tmp_path / "study"
    with pytest.raises(rc.FolderError, match="replace=True"):
        kept.map(out=tmp_path / "study")
    kept.map(out=tmp_path / "study", replace=True)
    with pytest.raises(rc.BadInput, match="not computed"):
        iter(rc.Study.of(CASES[0], contact={"friction": [0.1, 0.2]}))


@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_a_pool_of_processes(method: str, done: rc.Study) -> None:
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"this system does not {method}")
    context = multiprocessing.get_context(method)
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as executor:
        assert_same(list(executor.map(compute, CASES)), done)
    with context.Pool(2) as pool:
        assert_same(pool.map(compute, CASES), done)


def test_joblib(done: rc.Study) -> None:
    joblib = pytest.importorskip("joblib")
    with joblib.Parallel(n_jobs=2) as parallel:
        assert_same(parallel(joblib.delayed(compute)(case) for case in CASES), done)
        study = rc.Study.of(CASES[0], contact={"friction": [0.1, 0.2, 0.3]}).map(parallel)
    assert np.array_equal(study.results["rate_mm_per_cycle"], done.results["rate_mm_per_cycle"])


def test_dask(done: rc.Study) -> None:
    dask = pytest.importorskip("dask")
    assert_same(list(dask.compute(*[dask.delayed(compute)(case) for case in CASES], scheduler="processes")), done)
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            assert_same(client.gather(client.map(compute, CASES)), done)
            # A computed study as an argument.
            assert client.submit(lambda study: len(list(study)), done).result() == 3
