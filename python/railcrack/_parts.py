"""The parts of a run: cracked bodies, passages, criteria, plastic state."""

from __future__ import annotations

import json
import math
import operator
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _railcrack
from ._case import Case, History
from ._errors import BadInput
from ._html import facts
from ._progress import Progress, teller
from ._sections import Hertz
from ._table import Table

Array = NDArray[np.float64]


def crack(mouth_mm: float, length_mm: float, angle_deg: float) -> Array:
    """A straight crack from the surface: shape (2, 2), mouth and tip, x and y in mm. The angle is
    in (0, 180) degrees, below the surface, from +x."""
    if not (0.0 < angle_deg < 180.0 and 0.0 < length_mm < math.inf and math.isfinite(mouth_mm)):
        raise BadInput(f"length_mm = {length_mm}, angle_deg = {angle_deg}: must be positive and finite, and between 0 and 180")
    angle = math.radians(angle_deg)
    return np.array([[mouth_mm, 0.0], [mouth_mm + length_mm * math.cos(angle), -length_mm * math.sin(angle)]])


def _count(name: str, value: int) -> int:
    count = operator.index(value)
    if not 0 <= count < 2**63:
        raise BadInput(f"{name} = {count}: must be a positive integer")
    return count


def _points(cracks: Sequence[ArrayLike] | ArrayLike) -> list[list[tuple[float, float]]]:
    arrays = [np.asarray(c, float) for c in cracks]  # type: ignore[union-attr]
    if arrays and arrays[0].ndim == 1:
        arrays = [np.asarray(cracks, float)]
    for i, points in enumerate(arrays):
        if points.ndim != 2 or points.shape[1] != 2:
            raise BadInput(f"crack {i + 1} has the shape {points.shape}: must be (points, 2), x and y in mm")
    return [[(float(x), float(y)) for x, y in points] for points in arrays]


class Body:
    """A cracked elastic body loaded on its crack faces only, reduced to p face points and q tips.

    With f the nodal forces on the + faces (N/mm; their negatives on the − faces), index 2 j along
    the crack (x1) and 2 j + 1 across it (x2) of face point j, the displacement jump is C f (slip
    and opening, mm) and K is S f. The arrays are shared with Python without copying, and a passage
    uses their current values, so that a matrix can be replaced (`body.compliance[:] = …`, with
    `body.stiffness` its inverse).
    """

    _core: _railcrack.Body

    @classmethod
    def of(cls, case: Case, *, threads: int | None = None) -> Body:
        """The body of the initial cracks of `case`, computed by its engine."""
        body = cls.__new__(cls)
        body._core = _railcrack.case_body(case._core, threads)
        return body

    @property
    def compliance(self) -> Array:
        """C: shape (2 p, 2 p), mm per N/mm."""
        return self._core.compliance

    @property
    def stiffness(self) -> Array:
        """A = C⁻¹: shape (2 p, 2 p), N/mm per mm."""
        return self._core.stiffness

    @property
    def sif_influence(self) -> Array:
        """S: shape (2 q, 2 p), mm^(−1/2): rows 2 t and 2 t + 1 are K_I and K_II of tip t, in
        MPa√mm; divide by √1000 for MPa√m."""
        return self._core.sif_influence

    @property
    def points(self) -> Array:
        """Face points: shape (p, 2), x and y in mm."""
        return self._core.points

    @property
    def tangents(self) -> Array:
        """Unit vectors x1 along the crack at the face points: shape (p, 2)."""
        return self._core.tangents

    @property
    def arc_lengths(self) -> Array:
        """Arc length of the face points from the first point of their crack: shape (p,), mm."""
        return self._core.arc_lengths

    @property
    def weights(self) -> Array:
        """Length of crack face associated with each point: shape (p,), mm; force / weight is
        traction."""
        return self._core.weights

    @property
    def crack_of_point(self) -> NDArray[np.int64]:
        """Crack of each face point, from 1: shape (p,)."""
        return self._core.crack_of_point

    @property
    def samples(self) -> Array:
        """Quadrature points of the faces, at which stress fields are evaluated: shape (s, 2), x and
        y in mm."""
        return self._core.samples

    @property
    def tips(self) -> list[tuple[int, int]]:
        """Crack and tip within it of each tip, from 1, in the order of `sif_influence`."""
        return self._core.tips

    @property
    def unknowns(self) -> int:
        """Number of displacement unknowns of the engine."""
        return self._core.unknowns

    @property
    def remarks(self) -> list[str]:
        """Remarks of the engine."""
        return self._core.remarks

    def nodal_forces(self, stress: Callable[[Array], ArrayLike]) -> Array:
        """Nodal forces f, shape (2 p,), equivalent to removing the stress transmitted across the
        faces: `stress` is a function of points (n, 2) in mm and returns (n, 3): sxx, syy, sxy in
        MPa."""
        return self._core.nodal_forces(np.ascontiguousarray(stress(self.samples), float))

    def sif(self, stress: Callable[[Array], ArrayLike]) -> Array:
        """K_I and K_II (MPa√m) of each tip under a remote stress with open faces: shape (q, 2)."""
        forces = self.nodal_forces(stress)
        k: Array = (self.sif_influence @ forces).reshape(-1, 2) / math.sqrt(1000.0)
        return k

    def __repr__(self) -> str:
        return f"<railcrack.{type(self).__name__}: {len(self.weights)} face points, {len(self.tips)} tips>"


class XfemBody(Body):
    """Body of cracks in a half-plane, computed with extended finite elements."""

    def __init__(
        self,
        cracks: Sequence[ArrayLike] | ArrayLike,
        *,
        young_modulus_mpa: float = 210e3,
        poisson_ratio: float = 0.3,
        element_size_mm: float | None = None,
        threads: int | None = None,
    ) -> None:
        """cracks: each of the shape (points, 2), x and y in mm, y ≤ 0, the first point on the
        surface or below it (`crack(0.0, 6.0, 15.0)` makes one); or one such array.
        element_size_mm: at the cracks; None: the default of a case.
        """
        points = _points(cracks)
        self._core = _railcrack.xfem_body(points, young_modulus_mpa, poisson_ratio, element_size_mm, threads)


class DislocationBody(Body):
    """Body of cracks in a half-plane, computed with continuous distributions of dislocations."""

    def __init__(
        self,
        cracks: Sequence[ArrayLike] | ArrayLike,
        *,
        young_modulus_mpa: float = 210e3,
        poisson_ratio: float = 0.3,
        elements: int | None = None,
        threads: int | None = None,
    ) -> None:
        """cracks: as for `XfemBody`. elements: number along each crack; None: the default of
        cases."""
        points = _points(cracks)
        elements = None if elements is None else _count("elements", elements)
        self._core = _railcrack.dislocation_body(points, young_modulus_mpa, poisson_ratio, elements, threads)


@dataclass(frozen=True)
class OwnWheel:
    """A user-defined wheel on the half-plane y ≤ 0: a field in equilibrium that moves with x_c."""

    stress: Callable[[Array, float], ArrayLike]
    """The stress in MPa as a function of points (n, 2) in mm and x_c in mm: shape (n, 3), sxx, syy
    and sxy."""
    edges_mm: tuple[float, ...]
    """Positions relative to x_c, increasing, where the field is not smooth on the surface: the
    edges of the contact."""


@dataclass(frozen=True, repr=False)
class Passage:
    """The stabilised passage of a wheel over fixed cracks: m output positions, p face points, q
    tips."""

    xc_mm: Array
    """Wheel positions: shape (m,)."""
    ki_mpa_sqrt_m: Array
    """K_I of the stabilised passage: shape (q, m)."""
    kii_mpa_sqrt_m: Array
    """K_II of the stabilised passage: shape (q, m)."""
    earlier: list[tuple[Array, Array]]
    """K_I and K_II of the preceding passages."""
    histories: list[History]
    """K_I and K_II at all load steps for each tip: shape (samples, 2), MPa√m."""
    opening_mm: Array
    """Shape (m, p)."""
    slip_mm: Array
    """Shape (m, p)."""
    s22_mpa: Array
    """Normal stress across the faces, ≤ 0: shape (m, p)."""
    s12_mpa: Array
    """Shear stress across the faces: shape (m, p)."""
    status: NDArray[np.int8]
    """0 open, 1 stick, 2 slip: shape (m, p)."""
    passages: int
    """Number of passages until the history repeated."""
    solves: int
    """Number of contact solutions."""
    last_change: float | None
    """Change of K between the last two passages relative to its peak; None after a single
    passage."""

    def __repr__(self) -> str:
        peak = max(float(np.abs(k).max(initial=0.0)) for k in (self.ki_mpa_sqrt_m, self.kii_mpa_sqrt_m))
        tips, positions = self.ki_mpa_sqrt_m.shape
        count = f"{tips} tip{'s' if tips != 1 else ''}, {positions} positions, {self.passages} passages"
        return f"<railcrack.Passage: {count}, peak K {peak:.4g} MPa√m>"


def passage(
    body: Body,
    load: Hertz | OwnWheel,
    friction: float | Sequence[float] = 0.0,
    *,
    residual: Callable[[Array], ArrayLike] | None = None,
    from_mm: float | None = None,
    to_mm: float | None = None,
    positions: int = 241,
    max_passages: int = 5,
    passage_tolerance: float = 1e-3,
    step_tolerance: float = 2e-3,
    solver: Literal["newton", "latin"] = "newton",
    threads: int | None = None,
    progress: Progress = False,
) -> Passage:
    """The stabilised passage of a wheel over the cracks of `body`, with unilateral contact and
    friction on their faces.

    load: `Hertz` with peak pressure and half-width, or an `OwnWheel` whose stress is a function.
    friction: of the crack faces, one number or one for each crack.
    residual: a balanced residual stress as a function of points (n, 2) in mm: shape (n, 3), sxx, syy
        and sxy in MPa.
    from_mm, to_mm: first and last wheel position; None: 6 half-widths beyond the outermost face
        points.

    Raises `NotConverged`.
    """
    cracks = int(body.crack_of_point.max(initial=0))
    given = np.asarray(friction, float)
    frictions = [float(f) for f in (np.full(cracks, given) if given.ndim == 0 else given)]
    wheel: tuple[Any, ...]
    if isinstance(load, Hertz):
        if load.peak_pressure_mpa is None or load.half_width_mm is None:
            raise BadInput("Hertz: a passage in the plane needs peak_pressure_mpa and half_width_mm")
        half_width = float(load.half_width_mm)
        wheel = (float(load.peak_pressure_mpa), half_width, float(load.friction or 0.0))
    else:
        edges = [float(edge) for edge in load.edges_mm]
        half_width = 0.5 * (max(edges) - min(edges)) if edges else 1.0
        wheel = (load.stress, edges)
    x = body.points[:, 0]
    first = float(x.min()) - 6.0 * half_width if from_mm is None else from_mm
    last = float(x.max()) + 6.0 * half_width if to_mm is None else to_mm
    positions, max_passages = _count("positions", positions), _count("max_passages", max_passages)
    settings = (first, last, positions, max_passages, passage_tolerance, step_tolerance)
    told = teller(progress, max_passages, "passage")
    try:
        found = _railcrack.passage(body._core, wheel, frictions, residual, settings, solver, threads, told)
    finally:
        told.close()
    ki, kii = found["ki"], found["kii"]
    return Passage(
        xc_mm=found["xc"],
        ki_mpa_sqrt_m=ki[-1],
        kii_mpa_sqrt_m=kii[-1],
        earlier=list(zip(ki[:-1], kii[:-1], strict=True)),
        histories=found["histories"],
        opening_mm=found["opening"],
        slip_mm=found["slip"],
        s22_mpa=found["s22"],
        s12_mpa=found["s12"],
        status=found["status"].astype(np.int8),
        passages=found["passages"],
        solves=found["solves"],
        last_change=found["last_change"],
    )


@dataclass(frozen=True)
class Kink:
    """Direction selected by a criterion."""

    angle_deg: float
    """From straight ahead, counter-clockwise positive."""
    rate_mm_per_cycle: float
    """Growth rate of the virtual kink."""
    delta_k1_mpa_sqrt_m: float
    """Range of k1, clipped at zero, of the virtual kink."""
    delta_k2_mpa_sqrt_m: float
    """Range of k2 of the virtual kink."""
    rival_angle_deg: float | None
    """Angle of the largest secondary maximum, at least 15° away."""
    rival_ratio: float | None
    """Its value relative to the main maximum."""


def hourlier_pineau(
    history: ArrayLike,
    *,
    c: float = 2e-9,
    m: float = 3.33,
    mode_2_weight: float = 0.772,
    threshold_mpa_sqrt_m: float = 0.0,
    threshold_2_mpa_sqrt_m: float = 0.0,
    criterion: Literal[
        "max-rate", "max-rate-unclipped", "max-delta-k1", "max-k1", "coplanar", "mts", "max-delta-ctd"
    ] = "max-rate",
    kink_friction: float = 0.0,
) -> Kink | None:
    """The kink of a tip under a history of K_I and K_II (MPa√m), shape (samples, 2); None for an
    unloaded tip.

    The criterion is maximised over the kink angle within ±110°: by default the growth rate of the
    virtual kink by Paris' law da/dN = c ΔK_eq^m, ΔK_eq² = Δk1² + w Δk2² (Hourlier & Pineau 1982);
    the others are those of `[growth] direction` in the case file. The thresholds are those of
    `[growth]`: they act on the rate, not on the direction. `kink_friction` is the friction of
    the faces of the virtual kink.
    """
    samples = np.ascontiguousarray(history, float)
    found = _railcrack.hourlier_pineau(
        samples,
        c=c,
        m=m,
        mode_2_weight=mode_2_weight,
        thresholds=(threshold_mpa_sqrt_m, threshold_2_mpa_sqrt_m),
        criterion=criterion,
        kink_friction=kink_friction,
    )
    if found is None:
        return None
    angle, rate, k1, k2, rival = found
    return Kink(angle, rate, k1, k2, *(rival or (None, None)))


def kink_functions(angle_deg: float) -> Array:
    """F of (k1, k2) = F (K_I, K_II) for an infinitesimal kink: shape (2, 2).

    Source: Amestoy & Leblond 1992, Int. J. Solids Struct. 29, 465–501.
    """
    return np.array(_railcrack.kink_functions(angle_deg))


@dataclass(frozen=True)
class Shakedown:
    """The stabilised plastic state of a rail under the repeated passage of a wheel."""

    profile: Table
    """By depth: columns of `profile.csv`."""
    passes: Table
    """By passage: columns of `passes.csv`."""
    summary: dict[str, Any]
    """`shakedown.json`."""

    @property
    def state(self) -> str:
        """`elastic`, `elastic shakedown`, `plastic shakedown` or `not stabilised`."""
        return str(self.summary["state"])

    def _repr_html_(self) -> str:
        return facts("Stabilised plastic state", [("state", self.state)], self.profile._repr_html_())


def shakedown(
    case: Case,
    *,
    out: str | os.PathLike[str] | None = None,
    replace: bool = False,
    progress: Progress = False,
    threads: int | None = None,
) -> Shakedown:
    """The stabilised plastic state of the rail of `case` and its Dang Van profile, as computed by
    `railcrack shakedown`; also written to the folder `out`, with plots and report, if given."""
    told = teller(progress, 1, "passage")
    try:
        folder = None if out is None else Path(out)
        profile, passes, summary = _railcrack.shakedown(case._core, folder, replace, threads, told)
    finally:
        told.close()
    return Shakedown(Table("profile", profile), Table("passes", passes), json.loads(summary))
