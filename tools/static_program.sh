#!/usr/bin/env bash
# The command as a static program, for Linux systems of any age:
#
#     tools/static_program.sh [FILE]     (target/static/railcrack without it)
#
# It is linked with musl and mimalloc by zig, needs no library of the system, draws PNG files, and is compared with the command of this
# system on a case. Needs Rust with rustup, and Python 3 with venv and pip for zig. All libraries are built for one more target: five
# minutes on two cores.
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-target/static/railcrack}
target=x86_64-unknown-linux-musl
fail() {
    printf 'failed: %s\n' "$*" >&2
    exit 1
}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
source tools/release_tools.sh

need_target "$target"
release_tools
compiler=$(zig_compiler cc-x86_64-linux-musl x86_64-linux-musl)
# Linked with the musl of zig, which copies memory in a fifth to two fifths of the time of the one that comes with Rust.
CC_x86_64_unknown_linux_musl=$compiler cargo rustc --release --locked --target "$target" -p railcrack-cli --bin railcrack \
    --features png -- -C "linker=$compiler" -C link-self-contained=no -C target-feature=+crt-static
mkdir -p "$(dirname "$program")"
strip -o "$program" "target/$target/release/railcrack"
if readelf --program-headers "$program" | grep -q INTERP; then fail "$program is not static"; fi

cargo build --release --locked --workspace
railcrack=target/release/railcrack
run() { "$1" run cases/reference.toml --engine dislocation --steps 4 --out "$scratch/$2" --quiet > /dev/null; }
run "$railcrack" here
run "$program" static
# Two libraries of mathematics differ in last digits.
"$railcrack" compare "$scratch/here" "$scratch/static" --out "$scratch/compared" --tolerance 1e-6 --quiet > "$scratch/compared.txt" ||
    fail "$program computes something else"
printf '%s: %s bytes\n' "$program" "$(stat -c %s "$program")"
