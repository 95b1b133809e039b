#!/usr/bin/env bash
# The Python package as a wheel for this system, macOS or Windows, in target/wheels/here:
#
#     tools/wheel_here.sh
#
# Needs Rust with rustup, Python 3 with venv and pip, and bash. The wheel is installed into a fresh environment, where a small case is run.
# For Linux there is tools/wheel.sh, whose wheels serve systems of any age.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch" python/railcrack/railcrack-*.wasm' EXIT

python=$(command -v python3 || command -v python)
tools/web_module.sh python/railcrack
rm -rf target/wheels/here
"$python" -m pip wheel --quiet --no-deps --wheel-dir target/wheels/here ./python
"$python" -m venv "$scratch/fresh"
fresh=$scratch/fresh/bin
[ -d "$fresh" ] || fresh=$scratch/fresh/Scripts
"$fresh/python" -m pip install --quiet --disable-pip-version-check target/wheels/here/*.whl
"$fresh/railcrack" run cases/reference.toml --engine dislocation --steps 2 --out "$scratch/run" --quiet
"$fresh/railcrack" verify "$scratch/run"
"$fresh/railcrack" explorer --out "$scratch/explorer.html"
"$fresh/python" - "$scratch/run" << 'END'
import sys
import railcrack as rc
there = rc.Run.open(sys.argv[1])
here = there.case.run()
assert abs(here.sif.kii_mpa_sqrt_m - there.sif.kii_mpa_sqrt_m).max() == 0.0
END
ls target/wheels/here
