"""The engine of pages: found in the package and in the environment, not beside the interpreter."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import railcrack as rc


def explorer(folder: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    environment = {name: value for name, value in os.environ.items() if name != "RAILCRACK_ENGINE"} | variables
    line = [sys.executable, "-c", "from railcrack._command import main; main()", "explorer", "--out", "page.html"]
    return subprocess.run(line, capture_output=True, text=True, cwd=folder, env=environment)


def test_the_explorer_is_there_or_says_how_to_get_it(tmp_path: Path) -> None:
    done = explorer(tmp_path)
    if done.returncode == 0:
        assert (tmp_path / "page.html").stat().st_size > 1_000_000
        return
    said = " ".join(done.stderr.split())
    share = Path(sys.prefix) / "share/railcrack"
    assert done.returncode == 2 and f"tools/web_module.sh {share}" in said, said
    assert str(Path(sys.executable).resolve().parent) not in said or Path(sys.executable).resolve().parent == Path(sys.executable).parent


def test_a_named_engine(tmp_path: Path) -> None:
    engine = tmp_path / f"railcrack-{rc.__version__}.wasm"
    engine.write_bytes(b"\0asm\x01\0\0\0")
    assert explorer(tmp_path, RAILCRACK_ENGINE=str(engine)).returncode == 0
    assert (tmp_path / "page.html").is_file()
