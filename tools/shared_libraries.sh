#!/usr/bin/env bash
# Whether all builds of the workspace share one compilation of the libraries. Cargo compiles a library once per set of its features,
# and what is asked of it depends on the crates that are built together. Fails where `cargo test --release --workspace`,
# `--features png`, `cargo install` or the tests of one crate need a library with other features than `cargo build --release`.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C

# "name version [features]" of all libraries that a build compiles.
libraries() {
    cargo tree --prefix none --no-dedupe --format '{p} [{f}]' "$@" 2> "$lists/errors" > "$lists/tree" || {
        cat "$lists/errors" >&2
        exit 1
    }
    sed -e 's/ (\*)$//' -e '/^$/d' -e '/^railcrack/d' "$lists/tree" | sort -u
}

lists=$(mktemp -d)
trap 'rm -rf "$lists"' EXIT
libraries --edges normal,build > "$lists/ordinary"

code=0
# $1: what somebody calls; the rest: arguments of `cargo tree` that have the same libraries. What only this build has is not compared.
compare() {
    local build=$1
    shift
    libraries "$@" > "$lists/other"
    comm -13 "$lists/ordinary" "$lists/other" |
        awk 'NR == FNR { ordinary[$1 $2]; next } ($1 $2) in ordinary' "$lists/ordinary" - > "$lists/differing"
    if [ -s "$lists/differing" ]; then
        printf '%s compiles with other features than cargo build --release:\n' "$build" >&2
        cat "$lists/differing" >&2
        code=1
    fi
}

compare "cargo build --release --workspace" --workspace --edges normal,build
compare "cargo test --release --workspace" --workspace --edges normal,build,dev
compare "cargo build --release --features png" --workspace --edges normal,build --features png
for crate in crates/* paper-of-2014; do
    compare "cargo build --release --package ${crate##*/}" --package "${crate##*/}" --edges normal,build
done
compare "cargo install --path crates/railcrack-cli --features png" --package railcrack-cli --edges normal,build --features png
exit "$code"
