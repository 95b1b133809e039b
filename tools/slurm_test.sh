#!/usr/bin/env bash
# A study as an array of jobs on a real Slurm of one node: slurm_test.sh RAILCRACK. As root; needs slurm-wlm and munge.
set -euo pipefail
railcrack=$(realpath "$1")
here=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
ended() {
    for daemon in d ctld; do
        [ -s "$work/state/$daemon.pid" ] && kill "$(cat "$work/state/$daemon.pid")" 2> /dev/null
    done
    # The daemons may still be writing; what they leave does not fail the test.
    for _ in 1 2 3 4 5; do
        rm -rf "$work" 2> /dev/null && break
        sleep 1
    done
    return 0
}
trap ended EXIT
"$here/slurm_one.sh" "$work/state"
cd "$work"
PATH=$(dirname "$railcrack"):$PATH
# Study and job of the book.
book=$here/../docs/how-to/cluster.md
block() { awk -v first="$1" '/^```/ { if (on && text ~ first) { printf "%s", text; exit } on = !on; text = ""; next } on { text = text $0 "\n" }' "$book"; }
block '# study.toml' > study.toml
block '# part.sh' > part.sh
chmod +x part.sh
wait_for() { while squeue -h | grep -q .; do sleep 0.2; done; }
sbatch --quiet --cpus-per-task=1 --mem=400M part.sh
wait_for
railcrack sweep study.toml --out whole --quiet
for file in summary.csv runs.parquet growth.parquet sif.parquet; do
    cmp "results/$file" "whole/$file" || { cat slurm-*.out; exit 1; }
done
# A job whose time is nearly up is told so, keeps what it has, and a later one goes on.
sed 's/^steps = 2/steps = 40/' study.toml > long.toml
sed 's/study.toml --out results/long.toml --out long/' part.sh > long.sh
sbatch --quiet --cpus-per-task=1 --mem=400M long.sh
sleep 2
scancel --signal=TERM --full --user=root || true
wait_for
sbatch --quiet --cpus-per-task=1 --mem=400M long.sh
wait_for
railcrack sweep long.toml --out long-whole --quiet
cmp long/summary.csv long-whole/summary.csv || { cat slurm-*.out; exit 1; }
echo "slurm: arrays, signals and resumption come to the same tables"
