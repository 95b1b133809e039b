"""A study of 300 short runs by several worker processes, of which one is killed on the way."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import railcrack as rc

from dying import Dying, killed
from test_study import assert_same_study

pytestmark = pytest.mark.cluster

# 300 runs of milliseconds: few face elements and positions.
MANY = """\
title = "Three hundred cracks"
[contact]
peak_pressure_mpa = [600.0, 700.0, 800.0, 900.0, 1000.0]
half_width_mm = 6.75
friction = [-0.3, -0.2, -0.1, 0.1, 0.2, 0.3]
[passage]
positions = 31
max_passages = 2
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = [15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0]
friction = 0.3
[growth]
steps = 0
[solver]
engine = "dislocation"
[mesh]
interface_elements = 16
"""


@pytest.fixture(scope="module")
def swept(command: Callable[..., str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The study by the command."""
    folder = tmp_path_factory.mktemp("swept")
    (folder / "study.toml").write_text(MANY)
    command("sweep", folder / "study.toml", "--out", folder / "study", "--quiet")
    return folder / "study"


def test_dask_computes_again_what_a_killed_worker_had(swept: Path, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    study = rc.Study(MANY)
    out = tmp_path / "study"
    with distributed.LocalCluster(n_workers=3, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            before = set(client.run(os.getpid).values())
            done = study.map(Dying(client, 150, out), out=out)
            now = set(client.run(os.getpid).values())
    assert killed(out).exists() and before - now, "a worker was killed"
    assert len(done) == 300
    assert_same_study(done.folder, swept)
    assert np.array_equal(done.results["kii_peak_mpa_sqrt_m"], rc.Study.open(swept).results["kii_peak_mpa_sqrt_m"])


PROGRAM = """\
import sys
from pathlib import Path
from mpi4py.futures import MPIPoolExecutor
from dying import Dying
import railcrack as rc

if __name__ == "__main__":
    study, out = sys.argv[1:]
    with MPIPoolExecutor() as executor:
        rc.Study.read(study).map(Dying(executor, 150, Path(out)), out=out, resume=True)
"""


def test_mpi_goes_on_after_a_killed_worker(swept: Path, tmp_path: Path) -> None:
    """A killed process ends the whole MPI job; the next one computes what is missing."""
    pytest.importorskip("mpi4py")
    mpiexec = shutil.which("mpiexec.openmpi") or shutil.which("mpiexec")
    if mpiexec is None:
        pytest.skip("no mpiexec")
    (tmp_path / "study.toml").write_text(MANY)
    (tmp_path / "job.py").write_text(PROGRAM)
    out = tmp_path / "study"
    # OpenMPI refuses root and more processes than cores.
    names = ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe")
    environment = {**os.environ, **dict.fromkeys(names, "1"), "PYTHONPATH": str(Path(__file__).parent)}
    line = [mpiexec, "-n", "3", sys.executable, "-m", "mpi4py.futures", *map(str, (tmp_path / "job.py", tmp_path / "study.toml", out))]

    def job() -> int:
        return subprocess.run(line, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=300).returncode

    assert job() != 0 and killed(out).exists(), "a worker was killed"
    before = len(list(out.glob("runs/*/summary.json")))
    assert 0 < before < 300, "on the way"
    assert job() == 0
    assert_same_study(out, swept)
