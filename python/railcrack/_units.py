"""Units of columns, as pint reads them."""

from __future__ import annotations

# The longest suffix counts.
_UNITS = {
    "mpa_sqrt_m": "MPa m^(1/2)",
    "mm_per_cycle": "mm/cycle",
    "mm_per_mgt": "mm/Mt",
    "mm_per_10_mgt": "mm/(10 Mt)",
    "n_per_mm": "N/mm",
    "mpa_mm": "MPa mm",
    "mpa": "MPa",
    "mm2": "mm^2",
    "mm4": "mm^4",
    "per_mm": "1/mm",
    "mm": "mm",
    "um": "micrometer",
    "place_m": "m",
    "kn": "kN",
    "tgamma_n": "N",
    "angle_deg": "degree",
    "deg": "degree",
    "mgt": "Mt",
    "tonnes": "Mt",
    "load_t": "t",
    "per_year": "Mt/year",
    "months": "month",
    "percent": "percent",
    "wall_s": "s",
    "body_s": "s",
    "contact_s": "s",
    "growth_s": "s",
    "output_s": "s",
    "memory_mb": "MB",
    "load_cycles": "cycle",
    "cycles_error": "cycle",
}


def unit_of(column: str) -> str:
    """The unit of a column by the suffix of its name: `ki_mpa_sqrt_m` is in `MPa m^(1/2)`; empty
    without a unit."""
    endings = [ending for ending in _UNITS if column == ending or column.endswith("_" + ending)]
    return _UNITS[max(endings, key=len)] if endings else ""
