#!/usr/bin/env bash
# The engine of the pages as a WebAssembly module, in target/web/railcrack-VERSION.wasm, and where it is given in FOLDER:
#
#     tools/web_module.sh [FOLDER]
#
# Needs Rust with rustup, which brings the target. It is compiled below target/web, so that nothing that other builds made is
# compiled again.
set -euo pipefail
folder=${1:+$(mkdir -p "$1" && cd "$1" && pwd)}
cd "$(dirname "$0")/.."

target=wasm32-unknown-unknown
rustup target list --installed | grep -q "^$target$" || rustup target add "$target"
# The stack of a page is 1 MB by default; the module itself says what it needs.
cargo rustc --quiet --locked --profile web --target "$target" --target-dir target/web --package railcrack-web --lib \
    --crate-type cdylib -- -C link-arg=-zstack-size=4194304
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
module=target/web/railcrack-$version.wasm
cp "target/web/$target/web/railcrack_web.wasm" "$module"
[ -z "$folder" ] || cp "$module" "$folder"
printf '%s: %s bytes\n' "${folder:-target/web}/railcrack-$version.wasm" "$(wc -c < "$module" | tr -d " ")"
