"""Growth of rolling-contact-fatigue cracks in rails.

>>> import railcrack as rc
>>> case = rc.Case.read("rail-curve.toml").with_(growth={"steps": 5})
>>> run = case.run(progress=True)
>>> run.growth.to_pandas()
>>> run.plot.paths()

Lengths are in mm, stresses in MPa, stress intensity factors in MPa√m, angles in degrees; x is along
the rail, y upwards, the rail is y ≤ 0. Terms and sign conventions are those of the manual.
"""

from . import errors
from ._case import Case, Check, History, Run
from ._grid import FieldGrid
from ._parts import (
    Body,
    DislocationBody,
    Hertz,
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
from ._railcrack import version as _version
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

__version__ = _version()

__all__ = [
    "BadInput",
    "Body",
    "Case",
    "CaseError",
    "Check",
    "DislocationBody",
    "Fault",
    "FieldGrid",
    "FolderError",
    "Hertz",
    "History",
    "Interrupted",
    "Kink",
    "NotConverged",
    "OwnWheel",
    "Passage",
    "RailcrackError",
    "Run",
    "Shakedown",
    "Step",
    "Study",
    "StudyIncomplete",
    "Table",
    "XfemBody",
    "crack",
    "errors",
    "hourlier_pineau",
    "kink_functions",
    "passage",
    "shakedown",
]
