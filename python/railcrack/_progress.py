"""Progress of computations."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable
from typing import Any, Protocol

Progress = bool | Callable[["Step"], object]
"""True: a progress bar (with tqdm if it is installed, otherwise lines on standard error); or a
function that is called with every `Step`."""


class Step:
    """Progress of a computation: `done` of `total` growth steps or runs, and a message."""

    def __init__(self, done: float, total: int, text: str = "") -> None:
        self.done, self.total, self.text = done, total, text

    def __repr__(self) -> str:
        return f"Step(done={self.done}, total={self.total}, text={self.text!r})"


class Teller(Protocol):
    """Receives the events of a computation."""

    def __call__(self, kind: str, value: Any) -> None: ...

    def close(self) -> None: ...


class _Silent:
    def __call__(self, kind: str, value: Any) -> None:
        pass

    def close(self) -> None:
        pass


class _ToFunction:
    def __init__(self, function: Callable[[Step], object], total: int) -> None:
        self.function, self.total, self.done = function, total, 0.0

    def __call__(self, kind: str, value: Any) -> None:
        text = ""
        if kind == "begins":
            self.done = value
        elif kind == "fraction":
            # The fraction of a passage; a step has several passages.
            self.done = max(self.done, int(self.done) + min(value, 0.999))
        elif kind in ("finished", "run"):
            self.done = value + 1
        else:
            text = str(value)
        self.function(Step(self.done, self.total, text))

    def close(self) -> None:
        pass


class _Lines:
    def __init__(self, total: int, unit: str) -> None:
        self.total, self.unit = total, unit

    def __call__(self, kind: str, value: Any) -> None:
        if kind in ("finished", "run"):
            print(f"{self.unit} {value + 1} of {self.total}", file=sys.stderr)
        elif kind == "said":
            print(value, file=sys.stderr)

    def close(self) -> None:
        pass


class _Bar:
    def __init__(self, total: int | None, unit: str, tqdm: Any) -> None:
        done = "{n:.0f}" if unit == "run" else "{n:.2f}"
        known = f"{{l_bar}}{{bar}}| {done}/{{total}} [{{elapsed}}<{{remaining}}]"
        self.bar = tqdm(total=total, unit=f" {unit}", bar_format=known if total else "{n:.2f}{unit}s [{elapsed}]{postfix}")

    def __call__(self, kind: str, value: Any) -> None:
        if kind == "said":
            self.bar.set_postfix_str(str(value)[:60])
            return
        whole = kind in ("finished", "run")
        done = value + 1 if whole else value if kind == "begins" else int(self.bar.n) + min(value, 0.99)
        done = max(done, self.bar.n)
        self.bar.update(done - self.bar.n)

    def close(self) -> None:
        self.bar.close()


def teller(progress: Progress, total: int, unit: str = "step", *, ends_before: bool = False) -> Teller:
    """The listener for a computation of `total` steps or runs; one that `ends_before` may have
    fewer."""
    if progress is True:
        try:
            with warnings.catch_warnings():
                # A notebook without widgets shows the bar as text.
                warnings.simplefilter("ignore")
                from tqdm.auto import tqdm
        except ImportError:
            return _Lines(total, unit)
        return _Bar(None if ends_before else total, unit, tqdm)
    return _ToFunction(progress, total) if callable(progress) else _Silent()
