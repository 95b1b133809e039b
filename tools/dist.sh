#!/usr/bin/env bash
# A release, in target/dist:
#
#     tools/dist.sh                 everything
#     tools/dist.sh [PART…]         some parts of it
#
# program   railcrack-VERSION-x86_64-linux.tar.gz: the static program, the engine of pages, manual pages, completions of bash, zsh
#           and fish, licences; it is unpacked and used in a root folder that holds nothing else
# bill      railcrack-VERSION.cdx.json: a bill of materials of that program (CycloneDX 1.5), valid by the schema of that format
# wheels    the Python package for Linux on x86_64 and aarch64 (glibc 2.17 or later); the first is installed and used in an empty
#           environment, the second by QEMU, with Debian's Python for that machine, where apt-get has both
# sdist     the sources of the Python package, complete; with everything else, they are built and used in an empty environment
# site      railcrack-VERSION-site.tar.gz: the book with the explorer, and the pages of the interfaces for Rust and Python;
#           railcrack-VERSION-explorer.html: the explorer by itself
#
# SHA256SUMS has the checksums of all of them. Archives of the same sources are the same bytes. Needs Rust with rustup, a compiler of C
# for this system, Python 3 with venv and pip, and a network where cargo, rustup and pip have not yet installed what is needed. Half an
# hour on two cores.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() {
    printf 'failed: %s\n' "$*" >&2
    exit 1
}
source tools/release_tools.sh

all=(program bill sdist wheels site)
parts=("$@")
[ $# -gt 0 ] || parts=("${all[@]}")
for part in "${parts[@]}"; do
    [[ " ${all[*]} " == *" $part "* ]] || fail "$part is no part of a release; the parts are ${all[*]}"
done

version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
name=railcrack-$version
dist=$PWD/target/dist
target=x86_64-unknown-linux-musl
if tag=$(git describe --exact-match --tags 2> /dev/null) && [ "$tag" != "v$version" ]; then
    fail "these sources have the tag $tag, and the version $version"
fi
# The time of everything that is packed.
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2> /dev/null || echo 0)
export SOURCE_DATE_EPOCH
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$dist"

# The folder $2 of $1 as the archive $3.
packed() {
    tar --create --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --directory="$1" "$2" |
        gzip -9 --no-name > "$3.new"
    mv "$3.new" "$3"
}
# An empty environment of Python, with the packages that follow.
environment() {
    local folder=$1
    shift
    python3 -m venv "$folder"
    [ $# -eq 0 ] || "$folder/bin/pip" install --quiet --disable-pip-version-check "$@"
}
engine() {
    tools/web_module.sh
    export RAILCRACK_ENGINE=$PWD/target/web/$name.wasm
    # The program takes this module and no other.
    RAILCRACK_ENGINE_SHA256=$(sha256sum "$RAILCRACK_ENGINE" | cut -d ' ' -f 1)
    export RAILCRACK_ENGINE_SHA256
}
# Whether $1 computes what the program of this system computes, bit for bit.
same_run() {
    cargo build --release --locked --workspace --quiet
    rm -rf "$scratch/here" "$scratch/there"
    target/release/railcrack run cases/reference.toml --engine dislocation --steps 2 --out "$scratch/here" --quiet > /dev/null
    (cd / && "$1" run "$OLDPWD/cases/reference.toml" --engine dislocation --steps 2 --out "$scratch/there" --quiet > /dev/null)
    for table in sif growth faces; do
        cmp "$scratch/here/$table.csv" "$scratch/there/$table.csv" || fail "$1 computes something else"
    done
}

# ---- The parts. ----

# "bin" and "share" of the program in the folder $1.
lay_out() {
    local shell file share=$1/share
    mkdir -p "$1/bin" "$share/railcrack" "$share/bash-completion/completions" "$share/zsh/site-functions" \
        "$share/fish/vendor_completions.d" "$share/doc/railcrack"
    tools/static_program.sh "$1/bin/railcrack"
    cp "target/web/$name.wasm" "$share/railcrack"
    "$1/bin/railcrack" man --out "$share/man/man1" > /dev/null
    for shell in bash zsh fish; do
        case $shell in
            bash) file=bash-completion/completions/railcrack ;;
            zsh) file=zsh/site-functions/_railcrack ;;
            fish) file=fish/vendor_completions.d/railcrack.fish ;;
        esac
        "$1/bin/railcrack" completions "$shell" > "$share/$file"
        [ -s "$share/$file" ] || fail "no completions for $shell"
    done
    cp LICENSE-MIT LICENSE-APACHE CHANGELOG.md CITATION.cff "$share/doc/railcrack"
    python3 tools/bill_of_materials.py "$target" "$scratch/bill.json" "$share/doc/railcrack/third-party-licences.txt" > /dev/null
    chmod -R u=rwX,go=rX "$1"
}

# The program of the archive, in a root folder with nothing but its own files and a case.
try_program() {
    local root=$scratch/root command code=0
    mkdir -p "$root/home" "$root/tmp"
    # The command of the README, word by word.
    command=$(grep -m 1 '^mkdir .* && tar .*\.tar\.gz' README.md) || fail "README.md does not say how the archive is unpacked"
    (cd "$dist" && HOME=$root/home bash -c "$command")
    # Nothing of this system: no library, no variable, no /proc. As the user, where the system lets users do this, or sudo does it.
    local enter=("$(command -v unshare)" --root="$root")
    if [ "$(id -u)" -ne 0 ]; then
        if unshare --user --map-root-user true 2> /dev/null; then
            enter+=(--user --map-root-user)
        else
            sudo -n true || fail "the program is tried in a folder as its root, for which this system wants root or sudo"
            enter=("$(command -v sudo)" -n "${enter[@]}" --setuid "$(id -u)" --setgid "$(id -g)")
        fi
    fi
    in_root() { env -i HOME=/home "${enter[@]}" /home/.local/bin/railcrack "$@"; }
    in_root --version | grep -qx "railcrack $version" || fail "the program has another version than $version"
    in_root init /case.toml > /dev/null
    in_root run /case.toml --engine dislocation --steps 2 --quiet > /dev/null
    in_root report /case --png > /dev/null
    in_root explorer --out /explorer.html > /dev/null
    in_root verify /case > /dev/null
    head -c 8 "$root/case/plots/kii.png" | grep -q PNG || fail "the program draws no PNG files"
    # An invalid case is refused by a sentence there, too.
    in_root check /none.toml 2> "$scratch/none.txt" || code=$?
    [ "$code" -ne 0 ] && grep -q none.toml "$scratch/none.txt" || fail "a missing case is not refused"
    [ -s "$root/home/.local/share/man/man1/railcrack-run.1" ] || fail "there are no manual pages"
}

part_program() {
    local tree=$scratch/tree/$name
    engine
    lay_out "$tree"
    packed "$scratch/tree" "$name" "$dist/$name-x86_64-linux.tar.gz"
    try_program
}

part_bill() {
    local bill=$dist/$name.cdx.json
    python3 tools/bill_of_materials.py "$target" "$bill" "$scratch/licences.txt"
    release_tools
    "$tools/bin/python" - "$bill" << 'END' || fail "$bill is not valid"
import sys
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
fault = JsonStrictValidator(SchemaVersion.V1_5).validate_str(open(sys.argv[1]).read())
sys.exit(fault and str(fault))
END
}

part_sdist() {
    local sources=$dist/$name.tar.gz listed=$scratch/listed.txt crate
    release_tools
    (cd python && "$tools/bin/maturin" sdist --out "$scratch/sdist" > "$scratch/maturin.txt" 2>&1) || {
        cat "$scratch/maturin.txt"
        fail "maturin does not pack the sources"
    }
    mv "$scratch/sdist"/*.tar.gz "$sources"
    tar --list --file "$sources" > "$listed"
    grep -q "^$name/Cargo.lock$" "$listed" || fail "$sources does not have the versions of the libraries"
    for crate in railcrack railcrack-vtu railcrack-case railcrack-run railcrack-report railcrack-cli railcrack-py; do
        grep -q "^$name/crates/$crate/Cargo.toml$" "$listed" || fail "$sources does not have $crate"
    done
    # Everything that the crates include is there, and the versions of the libraries are theirs.
    rm -rf target/sources
    mkdir -p target/sources
    tar --extract --file "$sources" --directory target/sources
    (
        export CARGO_TARGET_DIR=$PWD/target
        cd "target/sources/$name" && cargo check --release --locked --quiet --package railcrack-py
    ) || fail "$sources does not compile"
    # Its build compiles all crates once more, but not the libraries of others.
    [ ${#parts[@]} -eq ${#all[@]} ] || return 0
    environment "$scratch/from-sources"
    (
        export CARGO_TARGET_DIR=$PWD/target
        cd / && "$scratch/from-sources/bin/pip" install --quiet --disable-pip-version-check "$sources"
    )
    same_run "$scratch/from-sources/bin/railcrack"
}

part_wheels() {
    local machine
    for machine in x86_64 aarch64; do
        tools/wheel.sh "$machine"
        cp "target/wheels/$machine"/*.whl "$dist"
    done
    environment "$scratch/empty" "$dist"/*x86_64.whl
    same_run "$scratch/empty/bin/railcrack"
    # 3: this system cannot try it, and the script has said so.
    tools/try_aarch64_wheel.sh "$dist"/*aarch64.whl || [ $? -eq 3 ] || fail "the wheel for aarch64"
}

part_site() {
    local site=$scratch/$name-site
    engine
    RUSTDOCFLAGS="-D warnings" cargo doc --release --no-deps --workspace --locked
    # An environment of its own: what the pages show is the package of these sources.
    [ -n "$(ls target/wheels/x86_64/*.whl 2> /dev/null)" ] || tools/wheel.sh
    environment "$scratch/pages"
    hashed "$scratch/pages/bin/pip"
    "$scratch/pages/bin/pip" install --quiet --disable-pip-version-check target/wheels/x86_64/*.whl
    "$scratch/pages/bin/python" tools/site/python_pages.py "$scratch/python-pages"
    # What runs the notebooks leaves text and pictures on the pages, no program.
    "$scratch/pages/bin/pip" install --quiet --disable-pip-version-check --constraint python/tests/requirements.txt \
        nbclient ipykernel matplotlib pandas
    "$scratch/pages/bin/python" tools/site/notebooks.py "$scratch/notebooks"
    cargo build --release --locked --workspace --quiet
    target/release/railcrack explorer --force --out "$dist/$name-explorer.html"
    "$scratch/pages/bin/python" tools/site/build.py "$site" --explorer "$dist/$name-explorer.html" --rust target/doc \
        --python "$scratch/python-pages" --notebooks "$scratch/notebooks"
    packed "$scratch" "$name-site" "$dist/$name-site.tar.gz"
}

rm -f "$dist/SHA256SUMS"
[ $# -gt 0 ] || rm -f "$dist"/*
for part in "${parts[@]}"; do
    printf '== %s\n' "$part"
    begun=$SECONDS
    "part_$part"
    printf '== %s: %s s\n' "$part" $((SECONDS - begun))
done
(
    cd "$dist"
    sha256sum -- * > SHA256SUMS.new
    mv SHA256SUMS.new SHA256SUMS
    sha256sum --check --quiet SHA256SUMS
    stat --format='%n: %s bytes' -- *
)
