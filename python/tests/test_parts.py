"""The parts: bodies, passages, functions of one's own, criteria, plastic state."""

from __future__ import annotations

import numpy as np
import pytest

import railcrack as rc

from conftest import SMALL


@pytest.mark.parametrize("engine", [rc.XfemBody, rc.DislocationBody])
def test_an_edge_crack_in_tension(engine: type[rc.Body]) -> None:
    """K_I = 1.1215 σ √(π a) (Tada, Paris, Irwin)."""
    body = engine(rc.crack(0.0, 4.0, 90.0))  # type: ignore[call-arg]
    p = len(body.weights)
    assert body.compliance.shape == (2 * p, 2 * p) and body.sif_influence.shape == (2, 2 * p)
    assert body.points.shape == (p, 2) and body.tips == [(1, 1)]
    identity = body.compliance @ body.stiffness
    assert np.abs(identity - np.eye(2 * p)).max() < 1e-8
    (ki, kii), = body.sif(lambda points: np.tile([100.0, 0.0, 0.0], (len(points), 1)))
    want = 1.1215 * 100.0 * np.sqrt(np.pi * 4.0e-3)
    assert ki == pytest.approx(want, rel=0.005) and abs(kii) < 0.002 * want


def test_the_arrays_are_never_copied() -> None:
    body = rc.DislocationBody(rc.crack(0.0, 4.0, 30.0))
    assert np.shares_memory(body.compliance, body.compliance)
    assert np.shares_memory(body.sif_influence, body.sif_influence)


def test_a_passage_has_the_bits_of_the_run(case: rc.Case, run: rc.Run) -> None:
    body = rc.Body.of(case)
    first = run.sif.where(step=0)
    found = rc.passage(
        body,
        rc.Hertz(845.0, 6.75, 0.1),
        0.3,
        from_mm=float(first["xc_mm"][0]),
        to_mm=float(first["xc_mm"][60]),
        positions=61,
        solver="newton" if "contact = \"newton\"" in case.to_toml() else "latin",
    )
    last = first.where(passage=first["passage"].max())
    assert np.array_equal(found.ki_mpa_sqrt_m[0], last["ki_mpa_sqrt_m"])
    assert np.array_equal(found.kii_mpa_sqrt_m[0], last["kii_mpa_sqrt_m"])
    faces = run.faces.where(step=0)
    assert np.array_equal(found.opening_mm.ravel(), faces["opening_mm"])
    assert found.passages == first["passage"].max() and found.histories[0].shape[1] == 2


def hertz(points: np.ndarray, xc: float) -> np.ndarray:
    """Hertzian pressure without friction, p0 = 845 MPa, a = 6.75 mm (McEwen 1949; Johnson 1985, eqs 4.49)."""
    p0, a = 845.0, 6.75
    x, z = points[:, 0] - xc, -points[:, 1]
    first = a**2 - x**2 + z**2
    root = np.sqrt(first**2 + 4.0 * x**2 * z**2)
    m = np.sqrt(np.maximum(0.5 * (root + first), 0.0))
    n = np.copysign(np.sqrt(np.maximum(0.5 * (root - first), 0.0)), x)
    safe = np.maximum(m**2 + n**2, 1e-300)
    sxx = -p0 / a * (m * (1.0 + (z**2 + n**2) / safe) - 2.0 * z)
    syy = -p0 / a * m * (1.0 - (z**2 + n**2) / safe)
    sxy = p0 / a * n * (m**2 - z**2) / safe
    return np.column_stack([sxx, syy, sxy])


def test_a_wheel_of_ones_own() -> None:
    """McEwen's closed form as a function gives the K of the built-in wheel."""
    body = rc.DislocationBody(rc.crack(0.0, 6.0, 30.0))
    wheel = rc.OwnWheel(hertz, (-6.75, 6.75))
    own = rc.passage(body, wheel, 0.2, positions=61)
    built_in = rc.passage(body, rc.Hertz(845.0, 6.75), 0.2, positions=61)
    peak = np.abs(built_in.kii_mpa_sqrt_m).max()
    # Both are the same field; sampled steps may differ by the tolerance of the load steps.
    assert np.abs(own.kii_mpa_sqrt_m - built_in.kii_mpa_sqrt_m).max() < 2e-3 * peak
    assert np.abs(own.ki_mpa_sqrt_m - built_in.ki_mpa_sqrt_m).max() < 2e-3 * peak


def test_a_residual_stress_of_ones_own() -> None:
    """Uniform tension along the rail opens a vertical crack by 1.1215 σ √(π a) while the wheel is far."""
    body = rc.DislocationBody(rc.crack(0.0, 4.0, 90.0))
    far = rc.passage(
        body,
        rc.Hertz(1.0, 1.0),
        0.0,
        residual=lambda points: np.tile([100.0, 0.0, 0.0], (len(points), 1)),
        from_mm=1e4,
        to_mm=1.1e4,
        positions=3,
    )
    assert far.ki_mpa_sqrt_m[0, 0] == pytest.approx(1.1215 * 100.0 * np.sqrt(np.pi * 4e-3), rel=0.005)


def test_functions_that_fail_are_heard() -> None:
    body = rc.DislocationBody(rc.crack(0.0, 6.0, 30.0))
    with pytest.raises(ZeroDivisionError):
        rc.passage(body, rc.OwnWheel(lambda points, xc: 1 / 0, (-1.0, 1.0)), 0.2, positions=5)
    with pytest.raises(ValueError, match="shape"):
        rc.passage(body, rc.OwnWheel(lambda points, xc: points, (-1.0, 1.0)), 0.2, positions=5)
    with pytest.raises(ValueError, match="law"):
        rc.Case(SMALL).run(law=lambda history: float("nan"))
    with pytest.raises(rc.BadInput, match="friction"):
        rc.passage(body, rc.Hertz(845.0, 6.75), [0.1, 0.2], positions=5)
    with pytest.raises(rc.BadInput, match="crack 1"):
        rc.DislocationBody([[(0.0, 1.0), (1.0, -1.0)]])


def test_the_law_and_the_criterion_of_the_case_as_functions(case: rc.Case, run: rc.Run) -> None:
    """Written as functions of the history, they give the same run."""

    def law(history: rc.History) -> float:
        opening = np.clip(history[:, 0], 0.0, None)
        delta_1, delta_2 = np.ptp(opening), np.ptp(history[:, 1])
        return float(2e-9 * (delta_1**2 + 0.772 * delta_2**2) ** (3.33 / 2.0))

    def direction(history: rc.History) -> float | None:
        kink = rc.hourlier_pineau(history)
        return None if kink is None else kink.angle_deg

    own = case.run(law=law, direction=direction)
    for column in ("tip_x_mm", "tip_y_mm", "rate_mm_per_cycle", "kink_angle_deg", "load_cycles"):
        assert own.growth[column] == pytest.approx(run.growth[column], rel=1e-9), column
    straight = case.run(direction=lambda history: 0.0)
    assert np.array_equal(straight.growth["kink_angle_deg"], np.zeros(3))
    x, y = straight.cracks()[0].T
    assert np.ptp(np.arctan2(np.diff(y), np.diff(x))) < 1e-12


def test_hourlier_and_pineau() -> None:
    # Pure mode II: the largest range of k1 is at ±70.5° for the opening criterion of an infinitesimal kink.
    shear = np.column_stack([np.zeros(3), [0.0, 10.0, 0.0]])
    kink = rc.hourlier_pineau(shear, criterion="max-k1")
    assert kink is not None and kink.angle_deg == pytest.approx(-75.5, abs=2.5)
    assert rc.hourlier_pineau(np.zeros((4, 2))) is None
    straight = rc.hourlier_pineau([[0.0, 0.0], [10.0, 0.0]])
    assert straight is not None and straight.angle_deg == pytest.approx(0.0, abs=1e-4)
    assert straight.rate_mm_per_cycle == pytest.approx(2e-9 * 10.0**3.33, rel=1e-9)
    # Under compression the friction of the kink takes from its range of k2.
    closed = np.column_stack([-20.0 + np.zeros(5), [0.0, 10.0, 0.0, -10.0, 0.0]])
    free = rc.hourlier_pineau(closed)
    rubbed = rc.hourlier_pineau(closed, kink_friction=0.3)
    assert free is not None and rubbed is not None
    assert rubbed.rate_mm_per_cycle < free.rate_mm_per_cycle
    assert rc.kink_functions(0.0) == pytest.approx(np.eye(2))


def test_shakedown() -> None:
    sections = {
        "contact": {"peak_pressure_mpa": 1100.0, "half_width_mm": 6.75, "friction": 0.1},
        "crack": [{"mouth_mm": 0.0, "length_mm": 6.0, "angle_deg": 15.0, "friction": 0.5}],
    }
    state = rc.shakedown(rc.Case(sections))
    assert state.state == "elastic shakedown" and state.passes.rows == 11
    assert np.ptp(state.profile["szz_mpa"]) > 50.0


NOT_NUMBERS = (float("nan"), float("inf"), -float("inf"), 1e308, -1e308)


@pytest.mark.parametrize("elements", [10**9, 10**6, 401, 7, 0, -1, 2**62, 2**64])
def test_elements_are_those_of_a_case(elements: int) -> None:
    with pytest.raises(rc.BadInput, match="elements"):
        rc.DislocationBody(rc.crack(0.0, 6.0, 30.0), elements=elements)


def test_bodies_have_the_limits_of_a_case() -> None:
    good = rc.crack(0.0, 6.0, 30.0)
    for value in (*NOT_NUMBERS, -1.0, 0.0):
        for engine in (rc.XfemBody, rc.DislocationBody):
            with pytest.raises(rc.BadInput, match="young_modulus_mpa"):
                engine(good, young_modulus_mpa=value)  # type: ignore[call-arg]
        with pytest.raises(rc.BadInput, match="element_size_mm"):
            rc.XfemBody(good, element_size_mm=value)
    for value in (*NOT_NUMBERS, 0.5, -0.1):
        with pytest.raises(rc.BadInput, match="poisson_ratio"):
            rc.DislocationBody(good, poisson_ratio=value)
    with pytest.raises(rc.BadInput, match="unknowns"):
        rc.XfemBody(good, element_size_mm=1e-6)
    flat, long, close = [[0.0, 0.0], [6.0, -1e-9]], [[0.0, 0.0], [1e200, -1e200]], [[1e-9, 0.0], [6.0, -3.0]]
    for cracks in (flat, long, [good, close], [good] * 300, []):
        with pytest.raises(rc.BadInput):
            rc.DislocationBody(cracks)


def test_passages_have_the_limits_of_a_case() -> None:
    body = rc.DislocationBody(rc.crack(0.0, 6.0, 30.0), elements=8)
    wheel = rc.Hertz(845.0, 6.75)
    for arguments in (
        [{"positions": count} for count in (2**62, 2**64, 100_001, 1, 0, -1)]
        + [{"max_passages": count} for count in (2**62, 0, -1, 1001)]
        + [{name: value} for name in ("from_mm", "to_mm") for value in (*NOT_NUMBERS,)]
        + [{name: value} for name in ("passage_tolerance", "step_tolerance") for value in (*NOT_NUMBERS, 0.0, -1.0)]
        + [{"friction": value} for value in (*NOT_NUMBERS, -0.1)]
    ):
        with pytest.raises(rc.BadInput):
            rc.passage(body, wheel, **{"positions": 5, **arguments})
    for value in (*NOT_NUMBERS, 1e-300):
        for wrong in (rc.Hertz(value, 6.75), rc.Hertz(845.0, value)):
            with pytest.raises(rc.BadInput):
                rc.passage(body, wrong, positions=5)
    for value in (*NOT_NUMBERS, 2.0):
        with pytest.raises(rc.BadInput):
            rc.passage(body, rc.Hertz(845.0, 6.75, value), positions=5)
    for edges in ((float("nan"), 1.0), (1.0, 1.0), tuple(range(101))):
        with pytest.raises(rc.BadInput):
            rc.passage(body, rc.OwnWheel(hertz, edges), positions=5)
    body.compliance[0, 0] = float("nan")
    with pytest.raises(rc.BadInput, match="matrix"):
        rc.passage(body, wheel, positions=5)


def test_criteria_have_the_limits_of_a_case() -> None:
    history = np.array([[0.0, -5.0], [3.0, 8.0]])
    assert rc.hourlier_pineau(history) is not None
    for name in ("c", "m", "mode_2_weight", "threshold_mpa_sqrt_m", "threshold_2_mpa_sqrt_m", "kink_friction"):
        for value in (*NOT_NUMBERS, -1.0):
            with pytest.raises(rc.BadInput, match=name):
                rc.hourlier_pineau(history, **{name: value})  # type: ignore[arg-type]
    for value in NOT_NUMBERS:
        with pytest.raises(rc.BadInput, match="history"):
            rc.hourlier_pineau([[0.0, 1.0], [value, 2.0]])
        with pytest.raises(rc.BadInput, match="angle_deg"):
            rc.kink_functions(value)
    body = rc.DislocationBody(rc.crack(0.0, 6.0, 30.0), elements=8)
    for value in NOT_NUMBERS:
        with pytest.raises(ValueError, match="stress"):
            body.sif(lambda points: np.full((len(points), 3), value))
