"""A study of 300 short runs by several worker processes, of which one is killed on the way."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import railcrack as rc

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
    killed: list[int] = []
    with distributed.LocalCluster(n_workers=3, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            workers = client.run(os.getpid)

            def kill(step: rc.Step) -> None:
                if step.done >= 60 and not killed:
                    killed.append(next(iter(workers.values())))
                    os.kill(killed[0], signal.SIGKILL)

            done = study.map(client, out=tmp_path / "study", progress=kill)
            now = client.run(os.getpid)
    assert killed and killed[0] not in now.values()
    assert len(done) == 300
    assert_same_study(done.folder, swept)
    assert np.array_equal(done.results["kii_peak_mpa_sqrt_m"], rc.Study.open(swept).results["kii_peak_mpa_sqrt_m"])


PROGRAM = """\
import sys
from mpi4py.futures import MPIPoolExecutor
import railcrack as rc

if __name__ == "__main__":
    with MPIPoolExecutor() as executor:
        rc.Study.read(sys.argv[1]).map(executor, out=sys.argv[2], resume=True)
"""


def test_mpi_goes_on_after_a_killed_worker(swept: Path, tmp_path: Path) -> None:
    """A killed process ends the whole MPI job; the next one computes what is missing."""
    pytest.importorskip("mpi4py")
    mpiexec = shutil.which("mpiexec.openmpi") or shutil.which("mpiexec")
    if mpiexec is None:
        pytest.skip("no mpiexec")
    (tmp_path / "study.toml").write_text(MANY)
    (tmp_path / "job.py").write_text(textwrap.dedent(PROGRAM))
    out = tmp_path / "study"
    # OpenMPI refuses root and more processes than cores.
    names = ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe")
    environment = {**os.environ, **dict.fromkeys(names, "1")}
    line = [mpiexec, "-n", "3", sys.executable, "-m", "mpi4py.futures", str(tmp_path / "job.py"), str(tmp_path / "study.toml"), str(out)]

    def start() -> subprocess.Popen[bytes]:
        return subprocess.Popen(line, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    job = start()
    until = time.monotonic() + 120.0
    while len(list(out.glob("runs/*/outcome.json"))) < 60 and job.poll() is None and time.monotonic() < until:
        time.sleep(0.05)
    kill_a_worker(job.pid)
    job.wait(timeout=120)
    before = len(list(out.glob("runs/*/outcome.json")))
    assert 60 <= before < 300, "the worker was killed on the way"
    again = start()
    assert again.wait(timeout=300) == 0
    assert_same_study(out, swept)


def kill_a_worker(job: int) -> None:
    """Kills a process of the MPI job that computes: the youngest Python below it."""
    children: dict[int, list[int]] = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            text = stat.read_text()
        except OSError:
            continue
        parent = int(text.rpartition(")")[2].split()[1])
        children.setdefault(parent, []).append(int(stat.parent.name))
    below, found = [job], []
    while below:
        process = below.pop()
        below.extend(children.get(process, []))
        try:
            if b"mpi4py.futures" in Path(f"/proc/{process}/cmdline").read_bytes() and process != job:
                found.append(process)
        except OSError:
            continue
    assert found, "no process of the job"
    os.kill(max(found), signal.SIGKILL)
