"""Growth of rolling-contact-fatigue cracks in rails.

>>> import railcrack as rc
>>> case = rc.Case(
...     contact=rc.Hertz(wheel_load_kn=85.0, wheel_radius_mm=460.0, rail_head_radius_mm=300.0, friction=0.1),
...     cracks=[rc.Crack(mouth_mm=0.0, length_mm=4.0, angle_deg=25.0, friction=0.3)],
... )
>>> run = case.run(progress=True)
>>> run.life, run.verdict
>>> run.growth.to_pandas()

Lengths are in mm, stresses in MPa, stress intensity factors in MPa√m, angles in degrees; x is along
the rail, y upwards, the rail is y ≤ 0. Terms and sign conventions are those of the manual.
"""

import sys
from pathlib import Path

from . import _railcrack, errors
from ._case import Case, Check, History, Run
from ._decision import InspectionInterval, Life, Reason, Verdict
from ._grid import FieldGrid
from ._parts import (
    Body,
    DislocationBody,
    Kink,
    OwnWheel,
    Passage,
    Shakedown,
    XfemBody,
    crack,
    hourlier_pineau,
    kink_functions,
    passage,
    shakedown,
)
from ._progress import Step
from ._sections import (
    Calibration,
    Carter,
    Contact,
    ContactTable,
    Crack,
    Fluid,
    Fracture,
    Growth,
    Hertz,
    Inspection,
    Maintenance,
    Mesh,
    Output,
    PassageSettings,
    PlasticStress,
    Rail,
    ResidualStress,
    Rolling,
    Scatter,
    ShakedownSettings,
    Solver,
    Temperature,
    Track,
    Traffic,
    Wheel,
)
from ._study import Study
from ._table import Table
from .errors import (
    BadInput,
    CaseError,
    Fault,
    FolderError,
    Interrupted,
    NotConverged,
    RailcrackError,
    StudyIncomplete,
)

__version__: str = _railcrack.version()
# The engine of pages comes with the package, or lies in the environment, which the process does not know.
_railcrack.engine_folders([Path(__file__).parent, Path(sys.prefix) / "share/railcrack"])

__all__ = [
    "BadInput",
    "Body",
    "Calibration",
    "Carter",
    "Case",
    "CaseError",
    "Check",
    "Contact",
    "ContactTable",
    "Crack",
    "DislocationBody",
    "Fault",
    "FieldGrid",
    "Fluid",
    "FolderError",
    "Fracture",
    "Growth",
    "Hertz",
    "History",
    "Inspection",
    "InspectionInterval",
    "Interrupted",
    "Kink",
    "Life",
    "Maintenance",
    "Mesh",
    "NotConverged",
    "Output",
    "OwnWheel",
    "Passage",
    "PassageSettings",
    "PlasticStress",
    "Rail",
    "RailcrackError",
    "Reason",
    "ResidualStress",
    "Rolling",
    "Run",
    "Scatter",
    "Shakedown",
    "ShakedownSettings",
    "Solver",
    "Step",
    "Study",
    "StudyIncomplete",
    "Table",
    "Temperature",
    "Track",
    "Traffic",
    "Verdict",
    "Wheel",
    "XfemBody",
    "crack",
    "errors",
    "hourlier_pineau",
    "kink_functions",
    "passage",
    "shakedown",
]
