"""Cases of the tests, small enough to be computed in a second."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import railcrack as rc

# A shell that starts the tests in the background has them ignore Ctrl-C.
signal.signal(signal.SIGINT, signal.default_int_handler)

CASES = Path(__file__).parents[2] / "cases"

SMALL = """\
title = "Small case"
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = 0.1
[passage]
positions = 61
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 20.0
friction = 0.3
[growth]
steps = 2
increment = 0.05
[solver]
engine = "dislocation"
"""


@pytest.fixture(scope="session")
def case() -> rc.Case:
    """A crack of 6 mm at 20°, two increments, by dislocations."""
    return rc.Case(SMALL)


@pytest.fixture(scope="session")
def run(case: rc.Case) -> rc.Run:
    """Its run."""
    return case.run()


@pytest.fixture(scope="session")
def command() -> Callable[..., str]:
    """The command of the package: its standard output."""

    def command(*arguments: object) -> str:
        line = [sys.executable, "-c", "from railcrack._command import main; main()", *map(str, arguments)]
        return subprocess.run(line, check=True, capture_output=True, text=True).stdout

    return command
