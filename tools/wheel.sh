#!/usr/bin/env bash
# The Python package as a wheel for Linux systems of any age (manylinux2014), in target/wheels:
#
#     tools/wheel.sh [aarch64]     (x86_64 without it)
#
# Needs Rust, and Python 3 with venv and pip. All is built as by `pip install ./python`, but for the last step: zig
# links the extension against the symbols of glibc 2.17 (2012). The wheel is examined by auditwheel, installed into
# a fresh environment, and a run of it compared with that of the command of this system, bit for bit. For aarch64,
# which needs rustup, all libraries are built once more, and the wheel is examined only.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() {
    printf 'failed: %s\n' "$*" >&2
    exit 1
}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

machine=${1:-x86_64}
case $machine in x86_64 | aarch64) ;; *) fail "$machine: must be x86_64 or aarch64" ;; esac
source tools/release_tools.sh
release_tools
if [ "$machine" = x86_64 ]; then
    linker=$(zig_compiler cc-x86_64-linux-gnu.2.17 x86_64-linux-gnu.2.17)
    # The flags are of the last crate alone, so that the others are those of the workspace. The linker that comes
    # with Rust is not for zig.
    how=(-- -C "linker=$linker" -C linker-features=-lld)
else
    need_target "$machine-unknown-linux-gnu"
    how=(--zig --target "$machine-unknown-linux-gnu")
fi
rm -rf "target/wheels/$machine"
# The engine of pages comes with the package.
tools/web_module.sh python/railcrack
trap 'rm -rf "$scratch" python/railcrack/railcrack-*.wasm' EXIT
(
    cd python
    PATH=$tools/bin:$PATH maturin build --quiet --release --locked --compatibility manylinux2014 \
        --out "../target/wheels/$machine" "${how[@]}"
)
wheel=$(echo "target/wheels/$machine"/*.whl)
"$tools/bin/auditwheel" show "$wheel" > "$scratch/shown.txt"
tr '\n' ' ' < "$scratch/shown.txt" | grep -q "following platform tag: *\"manylinux_2_17_$machine\"" ||
    fail "$wheel is no manylinux2014"
printf '%s: %s bytes\n' "$wheel" "$(stat -c %s "$wheel")"
[ "$machine" = x86_64 ] || exit 0

python3 -m venv "$scratch/fresh"
"$scratch/fresh/bin/pip" install --quiet --disable-pip-version-check "$wheel"
cargo build --release --locked --workspace --quiet
run() { "$1" run cases/reference.toml --engine dislocation --steps 2 --out "$scratch/$2" --quiet > /dev/null; }
run target/release/railcrack here
run "$scratch/fresh/bin/railcrack" there
for table in sif growth faces; do
    cmp "$scratch/here/$table.csv" "$scratch/there/$table.csv" || fail "$wheel computes something else"
done
