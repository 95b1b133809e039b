#!/usr/bin/env bash
# Coverage-guided fuzzing of the readers (fuzz/): tools/fuzz.sh SECONDS [TARGET …], a run of SECONDS
# for each target, all of them without names. It begins with the seeds in fuzz/corpus/TARGET and with
# what earlier runs on this machine found, in target/fuzz/work. Fails where an input ends the program
# or takes longer than 10 s; that input is in fuzz/found. It needs a C++ compiler for libFuzzer and
# the stable compiler of Rust for the rest.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=$1
shift
[ $# -gt 0 ] || set -- case study inputs study_inputs results packed parquet checkpoint request vtu

host=$(rustc -vV | sed -n 's/^host: //p')
# With --target, the instrumentation is not that of build scripts and macros.
export RUSTFLAGS="--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
-Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
-Cllvm-args=-sanitizer-coverage-trace-compares"
cargo build --release --locked --manifest-path fuzz/Cargo.toml --target-dir target/fuzz --target "$host"

mkdir -p fuzz/found
found=no
for target in "$@"; do
    program=target/fuzz/$host/release/$target
    corpus=fuzz/corpus/$target
    work=target/fuzz/work/$target
    report=target/fuzz/$target.txt
    mkdir -p "$work"
    # New inputs go into the first folder.
    "$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=4096 -max_len=16384 \
        -artifact_prefix="fuzz/found/$target-" -print_final_stats=1 "$work" "$corpus" > "$report" 2>&1 || {
        found=yes
        tail -n 40 "$report"
    }
    printf '%s: %s executions from %s seeds\n' "$target" \
        "$(sed -n 's/^stat::number_of_executed_units: *//p' "$report" | head -n 1)" \
        "$(find "$corpus" -type f | wc -l)"
done
rm -rf /dev/shm/railcrack-fuzz-*
[ "$found" = no ]
