"""An executor of which one worker is killed on the way, once."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any


def die_once(task: Callable[[int], object], number: int, study: Path) -> object:
    """Kills its own process once the folder `study` has the results of some run, unless one was
    killed before."""
    marker = killed(study)
    if marker.exists():
        return task(number)
    until = time.monotonic() + 120.0
    while not any(study.glob("runs/*/summary.json")) and time.monotonic() < until:
        time.sleep(0.01)
    marker.touch()
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError("the process outlives its kill")


def killed(study: Path) -> Path:
    """The file beside `study` that says that a worker was killed."""
    return study.with_name("killed")


class Dying:
    """`executor`, of which the worker that takes the run `number` of `study` is killed: with some
    runs behind it and this one to come, on a machine of any speed."""

    def __init__(self, executor: Any, number: int, study: Path) -> None:
        self.executor, self.number, self.study = executor, number, study

    def submit(self, task: Callable[[int], object], number: int) -> Any:
        if number == self.number:
            return self.executor.submit(die_once, task, number, self.study)
        return self.executor.submit(task, number)
