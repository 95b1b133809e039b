#!/usr/bin/env bash
# The Python package as a wheel for Linux systems of any age (manylinux2014, x86_64), in target/wheels:
#
#     tools/wheel.sh
#
# Needs Rust, and Python 3 with venv and pip. All is built as by `pip install ./python`, but for the last step: zig
# links the extension against the symbols of glibc 2.17 (2012). The wheel is examined by auditwheel, installed into
# a fresh environment, and a run of it compared with that of the command of this system, bit for bit.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() {
    printf 'failed: %s\n' "$*" >&2
    exit 1
}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

tools=$PWD/target/wheel-tools
if ! [ -x "$tools/bin/auditwheel" ]; then
    python3 -m venv "$tools"
    "$tools/bin/pip" install --quiet --disable-pip-version-check maturin==1.16.0 ziglang==0.17.1 auditwheel==6.8.2
fi
linker=$PWD/target/zig-linker
printf '#!/bin/sh\nexec "%s" -m ziglang cc -target x86_64-linux-gnu.2.17 "$@"\n' "$tools/bin/python" > "$linker"
chmod +x "$linker"
export ZIG_GLOBAL_CACHE_DIR=$PWD/target/zig
rm -rf target/wheels
# The flags are of the last crate alone, so that the others are those of the workspace. The linker that comes with
# Rust is not for zig.
(
    cd python
    PATH=$tools/bin:$PATH maturin build --quiet --release --locked --compatibility manylinux2014 --out ../target/wheels \
        -- -C linker="$linker" -C linker-features=-lld
)
wheel=$(echo target/wheels/*.whl)
"$tools/bin/auditwheel" show "$wheel" > "$scratch/shown.txt"
tr '\n' ' ' < "$scratch/shown.txt" | grep -q 'following platform tag: *"manylinux_2_17_x86_64"' ||
    fail "$wheel is no manylinux2014"

python3 -m venv "$scratch/fresh"
"$scratch/fresh/bin/pip" install --quiet --disable-pip-version-check "$wheel"
cargo build --release --locked --workspace --quiet
run() { "$1" run cases/reference.toml --engine dislocation --steps 2 --out "$scratch/$2" --quiet > /dev/null; }
run target/release/railcrack here
run "$scratch/fresh/bin/railcrack" there
for table in sif growth faces; do
    cmp "$scratch/here/$table.csv" "$scratch/there/$table.csv" || fail "$wheel computes something else"
done
printf '%s: %s bytes\n' "$wheel" "$(stat -c %s "$wheel")"
