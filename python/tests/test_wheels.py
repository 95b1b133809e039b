"""Tables of wheels as data frames."""

import numpy as np
import pandas as pd
import pytest

import railcrack as rc


def frame() -> pd.DataFrame:
    return pd.DataFrame(
        {
            "wheel": [11, 12, 13],
            "normal_kn": [85.0, 70.0, 85.0],
            "y_rail_mm": [4.0, 6.0, -30.0],
            "creepage_x": [8e-4, -5e-4, 0.0],
            "creepage_y": [0.0, 1e-3, 0.0],
            "spin_per_mm": [0.0, 2e-4, 0.0],
            "mu": [0.3, 0.25, 0.3],
            "a_mm": [6.0, 6.5, 6.0],
            "b_mm": [5.0, 4.0, 5.0],
        }
    )


def case(table: pd.DataFrame, sign: str = "contact") -> rc.Case:
    return rc.Case(
        {
            "wheel": [{"table": table, "creepage_sign": sign}],
            "crack": [{"mouth_mm": 0.0, "length_mm": 5.0, "angle_deg": 25.0, "friction": 0.2, "lateral_mm": 5.0}],
            "passage": {"positions": 41},
            "growth": {"steps": 0},
            "solver": {"engine": "dislocation"},
        }
    )


def test_a_data_frame_of_wheels_comes_back_with_what_they_do() -> None:
    wheels = case(frame()).wheels()
    joined = frame().merge(wheels.to_pandas(), on="wheel")
    assert list(joined["wheel"]) == [11, 12, 13]
    force = joined["fx_kn"].to_numpy()
    assert force[0] < 0.0 < force[1] and force[2] == 0.0
    assert joined["growth_share"].sum() == pytest.approx(1.0)
    # 35 mm beside the crack.
    assert 0.0 < joined["growth_share"][2] < 0.01 * joined["growth_share"][0]
    # 85 kN on 6 × 5 mm: 3 N/(2π a b).
    assert joined["p0_mpa"][0] == pytest.approx(1.5 * 85e3 / (np.pi * 30.0))


def test_an_index_with_a_name_is_a_column() -> None:
    np.testing.assert_array_equal(case(frame().set_index("wheel")).wheels().fx_kn, case(frame()).wheels().fx_kn)


def test_vehicle_signs_are_opposite_and_a_wrong_row_is_named() -> None:
    table = frame()
    opposite = table.assign(**{name: -table[name] for name in ("creepage_x", "creepage_y", "spin_per_mm")})
    same = case(opposite, "vehicle").wheels()
    np.testing.assert_array_equal(same.fx_kn, case(table).wheels().fx_kn)
    with pytest.raises(rc.CaseError, match="row 2: `normal_kn = -1.0`|row 2: `normal_kn = -1`"):
        case(table.assign(normal_kn=[85.0, -1.0, 85.0]))
