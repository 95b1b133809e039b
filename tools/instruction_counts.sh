#!/usr/bin/env bash
# Instructions of small runs under valgrind's callgrind, on one thread, against those in tools/instruction_counts.csv. A count does not depend on how
# busy a machine is, so a slowdown by a factor is seen. It does depend on compiler and vector unit (valgrind has AVX2, not AVX-512), hence the
# wide margin: a count may be up to twice the one noted. With --write the counts of this machine are noted instead.
set -euo pipefail
cd "$(dirname "$0")/.."

program=target/release/railcrack
noted=tools/instruction_counts.csv
margin=2
grep -qw avx2 /proc/cpuinfo || { echo "no AVX2 here: counts would be others; nothing checked" >&2; exit 0; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# A coarse version of the reference case, without fields.
sed -e 's/^positions = .*/positions = 31/' -e 's/^fields_every = .*/fields_every = 0/' \
    -e 's/^\[mesh\].*/[mesh]\nelement_size_mm = 0.4/' cases/reference.toml > "$folder/coarse.toml"
sed -e 's/^\[\[crack\]\]$/[[crack]]\nmouth_mm = 4.0\nlength_mm = 5.0\nangle_deg = 20.0\nfriction = 0.5\n\n&/' \
    "$folder/coarse.toml" > "$folder/two.toml"
runs=(
    "dislocation|run $folder/coarse.toml --engine dislocation --steps 1 --threads 1"
    "xfem|run $folder/coarse.toml --engine xfem --steps 1 --threads 1"
    "two cracks xfem|run $folder/two.toml --engine xfem --steps 0 --threads 1"
)

count() {
    local out=$folder/callgrind
    # shellcheck disable=SC2086
    valgrind --tool=callgrind --callgrind-out-file="$out" "$program" $1 --out "$folder/run" --quiet \
        > "$folder/out.txt" 2>&1 || { cat "$folder/out.txt" >&2; exit 1; }
    awk '/^(summary|totals):/ { print $2; exit }' "$out"
}

if [ "${1-}" = --write ]; then
    echo "# Instructions, by callgrind; $(rustc --version)" > "$noted"
    echo "run,instructions" >> "$noted"
fi
status=0
for run in "${runs[@]}"; do
    title=${run%%|*}
    rm -rf "$folder/run"
    now=$(count "${run#*|}")
    if [ "${1-}" = --write ]; then
        echo "$title,$now" >> "$noted"
        continue
    fi
    before=$(awk -F, -v title="$title" '$1 == title { print $2 }' "$noted")
    [ -n "$before" ] || { echo "$noted has no count for \"$title\"" >&2; exit 1; }
    ratio=$(awk -v a="$now" -v b="$before" 'BEGIN { printf "%.2f", a / b }')
    echo "$title: $now instructions, $ratio of those noted"
    if awk -v r="$ratio" -v m="$margin" 'BEGIN { exit !(r > m) }'; then
        echo "$title: more than $margin times the instructions noted in $noted" >&2
        status=1
    elif awk -v r="$ratio" 'BEGIN { exit !(r < 0.5) }'; then
        echo "$title: less than half; note the new count with tools/instruction_counts.sh --write" >&2
    fi
done
exit $status
