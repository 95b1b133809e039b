"""From growth to a decision: life, verdict, inspection."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal, TypeVar

Level = Literal["ok", "act", "unknown", "stop", "outside"]
Mode = Literal["depth", "length", "fracture", "spall", "detached"]

Made = TypeVar("Made")


def _made(cls: type[Made], entries: Mapping[str, Any]) -> Made:
    """A `cls` of the entries that it has; None where there is none."""
    return cls(**{field.name: entries.get(field.name) for field in fields(cls)})  # type: ignore[arg-type]


@dataclass(frozen=True)
class Reason:
    """A reason of a verdict."""

    kind: str
    """Its kind: `failure`, `at-once`, `before-detectable`, `risk`, `end-of-run`, `steps`, …"""
    text: str
    """A sentence with its numbers."""
    crack: int | None = None
    """Crack, from 1."""
    tip: int | None = None
    """Tip within its crack, from 1."""
    step: int | None = None
    """Growth step."""
    mgt: float | None = None
    """Traffic until then, million gross tonnes."""
    value: float | None = None
    """The value in question, in the unit of the text."""
    limit: float | None = None
    """Its limit."""

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Verdict:
    """The verdict on a run."""

    level: Level
    """`ok`: no failure within the run; `act`: failure within the run, or too much risk;
    `unknown`: the run ends before the answer; `stop`: failure at once, or before the crack is
    detectable; `outside`: the model does not describe this."""
    reasons: list[Reason]
    """The reasons, the gravest first."""

    def __str__(self) -> str:
        return "\n".join([self.level, *(f"  {reason}" for reason in self.reasons)])


@dataclass(frozen=True)
class InspectionInterval:
    """Growth from a detectable crack to the failure of the rail, in million gross tonnes (MGT).
    Depths in mm."""

    interval_mgt: float | None
    """The interval: from detectable to critical, divided by the safety factor; None if the crack
    does not become critical, or is missed too often at it."""
    safety_factor: float
    """Safety factor."""
    mgt_to_detectable: float | None
    """From the start until the crack is detectable for good."""
    mgt_to_critical: float | None
    """From the start until failure; None without one."""
    mgt_detectable_to_critical: float | None
    """From detectable to critical, or until the crack hides again."""
    critical_by: Mode | None
    """Mode of the failure."""
    detectable_depth_mm: float | None
    """Depth from which the crack is detected."""
    mgt_first_detectable: float | None = None
    """From the start until the crack is first detectable."""
    longest_hidden_mgt: float | None = None
    """The longest stretch in which it hides after that."""


@dataclass(frozen=True)
class Life:
    """Life of the rail in the run: until its first failure over all cracks, tips and modes."""

    mgt: float | None
    """Million gross tonnes until failure along the path with the shortest life, on which verdict
    and inspection rest; None if the rail does not fail within the run, or without axle loads."""
    governed_by: Literal["straight", "nominal", "limit"]
    """That path."""
    nominal_mgt: float | None
    """Million gross tonnes until failure along the nominal path, that of the tables."""
    nominal_mgt_error: float | None
    """Its estimated error by the increments."""
    mode: Mode | None
    """Mode of the failure along the nominal path; None without one."""
    crack: int | None
    """Its crack, from 1."""
    tip: int | None
    """The tip within its crack, from 1."""
    load_cycles: float
    """Axles at the start of the last step of the run, whatever its end."""
    load_cycles_error: float
    """Their estimated error by the increments."""
    paths: dict[str, float | None]
    """Million gross tonnes to failure along each path; empty where the others were not computed."""

    def __str__(self) -> str:
        if self.mgt is None:
            return f"no failure known within {self.load_cycles:,.0f} axles"
        return f"{self.mgt:.3g} million gross tonnes" + (f", {self.governed_by} path" if self.paths else "")


def verdict_of(summary: Mapping[str, Any]) -> Verdict | None:
    """The verdict in `summary.json`."""
    found = summary.get("verdict") or (summary.get("decision") or {}).get("verdict")
    if not found:
        return None
    return Verdict(found["level"], [_made(Reason, reason) for reason in found["reasons"]])


def inspection_of(summary: Mapping[str, Any]) -> InspectionInterval | None:
    """The inspection in `summary.json`."""
    found = (summary.get("decision") or {}).get("inspection")
    return _made(InspectionInterval, found) if found else None


def life_of(summary: Mapping[str, Any]) -> Life:
    """The life in `summary.json`."""
    decision = summary.get("decision") or {}
    failure = decision.get("failure") or {}
    mode = failure.get("mode")
    paths = {name: value for name, value in (decision.get("paths") or {}).items() if name in ("straight", "nominal", "limit")}
    governed_by = decision.get("governed_by", "nominal")
    nominal = failure.get("mgt")
    return Life(
        mgt=paths.get(governed_by, nominal),
        governed_by=governed_by,
        nominal_mgt=nominal,
        nominal_mgt_error=failure.get("mgt_error"),
        mode=None if mode == "none" else mode,
        crack=failure.get("crack"),
        tip=failure.get("tip"),
        load_cycles=summary["load_cycles"],
        load_cycles_error=summary.get("load_cycles_error") or 0.0,
        paths=paths,
    )
