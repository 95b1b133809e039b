"""Cases of typed sections."""

from __future__ import annotations

import inspect
import pickle
import re
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

import railcrack as rc
from railcrack import _sections

HERE = Path(__file__).parent
TOOL = HERE.parents[1] / "tools/python_sections.py"


def typed() -> rc.Case:
    """The small case of the other tests."""
    return rc.Case(
        title="Small case",
        contact=rc.Hertz(845.0, 6.75, friction=0.1),
        passage=rc.PassageSettings(positions=np.int64(61)),
        cracks=[rc.Crack(mouth_mm=0.0, length_mm=np.float64(6.0), angle_deg=20.0, friction=0.3)],
        growth=rc.Growth(steps=2, increment=0.05),
        solver={"engine": "dislocation"},
    )


def test_classes_dictionaries_and_text_are_the_same_case(case: rc.Case) -> None:
    assert typed() == case
    assert rc.Case({"contact": rc.Hertz(845.0, 6.75, friction=0.1)}, title="Small case", passage={"positions": 61},
                   crack=[{"mouth_mm": 0.0, "length_mm": 6.0, "angle_deg": 20.0, "friction": 0.3}],
                   growth={"steps": 2, "increment": 0.05}, solver=rc.Solver(engine="dislocation")) == case
    with pytest.raises(TypeError, match="beside a text"):
        rc.Case(case.text, growth=rc.Growth(steps=1))


def test_sections_change_a_case(case: rc.Case) -> None:
    changed = case.with_(growth=rc.Growth(steps=5), cracks={"friction": 0.1}, contact=rc.Hertz(friction=0.2))
    assert (changed.steps, case.steps) == (5, 2)
    assert changed.with_(growth={"steps": 2}, crack={"friction": 0.3}, contact={"friction": 0.1}) == case
    two = case.with_(cracks=[rc.Crack(mouth_mm=x, length_mm=3.0, angle_deg=30.0, friction=0.1) for x in (0.0, 9.0)])
    assert len(two.cracks) == 2
    assert pickle.loads(pickle.dumps(rc.Growth(steps=3))) == rc.Growth(steps=3) != rc.Growth(steps=4)
    assert repr(rc.Hertz(845.0, 6.75)) == "Hertz(peak_pressure_mpa=845.0, half_width_mm=6.75)"


def test_a_wheel_has_sections_within_it() -> None:
    wheels = [
        rc.Wheel(name=name, share=share, axle_load_t=load, contact=rc.Hertz(pressure, 6.75, friction=0.1))
        for name, share, load, pressure in [("loaded", 0.75, 22.5, 845.0), ("empty", 0.25, 6.0, 600.0)]
    ]
    crack = rc.Crack(mouth_mm=0.0, length_mm=6.0, angle_deg=20.0, friction=0.3)
    case = rc.Case(wheels=wheels, cracks=[crack], solver=rc.Solver(engine="dislocation"))
    assert "share = 0.75" in case.to_toml() and "peak_pressure_mpa = 600.0" in case.to_toml()


def test_errors_name_the_argument(case: rc.Case, tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_text(case.text)
    for changed in (case, rc.Case.read(path), typed()):
        with pytest.raises(rc.CaseError) as raised:
            changed.with_(growth={"stepz": 1})  # type: ignore[typeddict-unknown-key]
        text = str(raised.value)
        assert text.startswith("growth.stepz: ") and "steps" in text, text
        assert not re.search(r":\d+:\d+|--|case\.toml", text), text
        assert raised.value.errors[0].line is None
    with pytest.raises(rc.CaseError, match=r"^crack\[1\].friction: "):
        rc.Case(contact=rc.Hertz(845.0, 6.75, friction=0.1), cracks=[rc.Crack(friction=-1.0, length_mm=3.0, mouth_mm=0.0, angle_deg=9.0)])
    with pytest.raises(TypeError, match=r"Growth\(\) has no argument stepz: did you mean steps\?"):
        rc.Growth(stepz=1)  # type: ignore[call-arg]
    with pytest.raises(rc.CaseError, match=r"(?m)^contact.frictoin: unknown key .*`friction`"):
        rc.Study.of(case, contact={"frictoin": {"uniform": [0.0, 0.1]}})
    with pytest.raises(TypeError, match=r"^cracks: a list, \[Crack\("):
        rc.Case(contact=rc.Hertz(845.0, 6.75, friction=0.1), cracks=rc.Crack(friction=0.1))  # type: ignore[typeddict-item]
    # Text of the user keeps its lines.
    with pytest.raises(rc.CaseError, match=r"case:\d+:\d+: "):
        rc.Case(case.text.replace("steps", "stepz"))


def test_every_attribute_has_its_docstring() -> None:
    """Editors show the text below an attribute: meaning, unit, usual and accepted range, words."""
    source = inspect.getsource(_sections)
    classes = [getattr(rc, name) for name in _sections.__all__]
    for cls in classes:
        assert cls.__doc__
        body = source.split(f"\nclass {cls.__name__}(Section):\n")[1].split("\n\n\n")[0]
        for field in fields(cls):
            assert re.search(rf"    {field.name}: [^\n]*\n    \"\"\"[^\n]", body), f"{cls.__name__}.{field.name}"
        # `help` shows it, too.
        assert all(f"\n{field.name}: " in inspect.getdoc(cls) + "\n" for field in fields(cls)), cls.__name__
    source = " ".join(source.split())
    assert "usual: 50 to 4000" in source and "In MPa" in source and '"free": no traction' in source


def test_the_generated_file_is_up_to_date() -> None:
    done = subprocess.run([sys.executable, TOOL, "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_wrong_cases_fail_type_checking(tmp_path: Path) -> None:
    """Each line of `typed_wrong.py` with a comment `# error: CODE` is such an error, and no other line."""
    pytest.importorskip("mypy")
    path = HERE / "typed_wrong.py"
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file=", f"--cache-dir={tmp_path}", "--no-error-summary", str(path)]
    printed = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path).stdout
    found = {(int(line), code) for line, code in re.findall(r"typed_wrong\.py:(\d+): error: .*\[([\w-]+)\]", printed)}
    wanted = set()
    for number, line in enumerate(path.read_text().splitlines(), 1):
        wanted |= {(number, code) for code in re.findall(r"# error: ([\w-]+)", line)}
    assert found == wanted and len(wanted) > 8, printed
