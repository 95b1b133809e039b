#!/usr/bin/env bash
# The scripts and the style of the reports: faults and layout by Biome, types by TypeScript. Needs Node.js with npm.
# Everything else comes into target/page-scripts, in the versions of tools/page-scripts/package-lock.json.
# With --fix, Biome lays the scripts out and corrects what it safely can. Ends with 1 where something is found.
set -euo pipefail
cd "$(dirname "$0")/.."

settings=tools/page-scripts
installed=target/page-scripts
sources=(
    crates/railcrack-report/src/assets/*.js
    crates/railcrack-report/src/assets/*.d.ts
    crates/railcrack-report/src/assets/page.css
    crates/railcrack-cli/src/commands/view/live.js
)
mode=ci
[ "${1-}" != --fix ] || mode='check --write'

command -v npm > /dev/null || {
    echo "Node.js with npm is needed" >&2
    exit 1
}
if grep -q '"resolved"' "$settings/package-lock.json"; then
    echo "package-lock.json names a registry: write it with npm install --omit-lockfile-registry-resolved" >&2
    exit 1
fi
# The lock file as it was installed; npm completes the other copy for this system.
if ! cmp -s "$settings/package-lock.json" "$installed/installed.json"; then
    rm -rf "$installed"
    mkdir -p "$installed"
    cp "$settings/package.json" "$settings/package-lock.json" "$installed"
    (cd "$installed" && npm install --ignore-scripts --no-audit --no-fund --loglevel=error)
    cp "$settings/package-lock.json" "$installed/installed.json"
fi

found=0
# shellcheck disable=SC2086 # the mode may be two words
"$installed/node_modules/.bin/biome" $mode --config-path="$settings/style.json" --error-on-warnings "${sources[@]}" || found=1
"$installed/node_modules/.bin/tsc" --project "$settings" || found=1
exit "$found"
