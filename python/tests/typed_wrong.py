"""Cases that a type checker refuses, each with its error, and cases that it accepts; never executed."""

import numpy as np

import railcrack as rc

case = rc.Case(contact=rc.Hertz(845.0, 6.75, friction=0.1), cracks=[rc.Crack(length_mm=6.0, friction=0.3)])

# Accepted.
rc.Case({"contact": {"peak_pressure_mpa": 845.0}})
rc.Case("title = \"text\"")
rc.Case(wheels=[{"share": 1.0, "contact": rc.Carter(traction=-0.5)}], cracks=[{"length_mm": np.float64(3.0), "friction": 0.1}])
case.with_(growth={"steps": 5}, crack={"friction": 0.2}, traffic=None, solver=rc.Solver(engine="space"))
case.with_(cracks=[rc.Crack(points_mm=np.zeros((3, 2)), friction=0.1)], growth={"critical_length_mm": None})

# Refused.
case.with_(growth={"stepz": 1})  # error: arg-type
case.with_(groth={"steps": 1})  # error: call-arg
case.with_(growth={"steps": "many"})  # error: arg-type
case.with_(solver={"engine": "xfm"})  # error: arg-type
rc.Growth(stepz=1)  # error: call-arg
rc.Growth(law="pariss")  # error: arg-type
rc.Crack(length_mm=6.0)  # error: call-arg
rc.Carter(creepage_x=0.1)  # error: call-arg
rc.Case(contact=rc.Growth())  # error: arg-type
rc.Case(cracks=rc.Crack(friction=0.1))  # error: arg-type

# Results.
run = case.run()
level: str = run.life  # error: assignment
if run.inspection is not None and run.verdict is not None:
    interval: float | None = run.inspection.interval_mgt
    level = run.verdict.level
run.inspection.interval_mgt  # error: union-attr
