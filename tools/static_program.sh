#!/usr/bin/env bash
# The command as a static program, for Linux systems of any age:
#
#     tools/static_program.sh [FILE]     (target/static/railcrack without it)
#
# It is linked with musl, needs no library of the system, and is compared with the command of this system on
# a case. Needs Rust with rustup; no C is compiled. All libraries are built for one more target, so that the
# checks leave it out: five minutes on two cores.
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

rustup target add "$target"
cargo build --release --locked --target "$target" -p railcrack-cli --bin railcrack
mkdir -p "$(dirname "$program")"
strip -o "$program" "target/$target/release/railcrack"
if readelf --program-headers "$program" | grep -q INTERP; then fail "$program is not static"; fi

cargo build --release --locked -p railcrack-cli --bin railcrack
railcrack=target/release/railcrack
run() { "$1" run cases/reference.toml --engine dislocation --steps 4 --out "$scratch/$2" --quiet > /dev/null; }
run "$railcrack" here
run "$program" static
# Two libraries of mathematics differ in last digits.
"$railcrack" compare "$scratch/here" "$scratch/static" --out "$scratch/compared" --tolerance 1e-6 --quiet > "$scratch/compared.txt" ||
    fail "$program computes something else"
printf '%s: %s bytes\n' "$program" "$(stat -c %s "$program")"
