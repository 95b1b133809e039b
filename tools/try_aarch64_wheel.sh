#!/usr/bin/env bash
# The wheel for aarch64 on this machine: tools/try_aarch64_wheel.sh WHEEL
#
# Debian's Python for aarch64 is unpacked into a scratch folder and run by QEMU, the wheel and numpy beside it. The
# package computes the reference case by both engines, and the results are compared with those of the command of this
# system. Needs apt-get and dpkg-deb, and a network; QEMU is installed where it is not there. Ends with 3, and a
# sentence, where one of the programs cannot be had.
set -euo pipefail
wheel=$(realpath "$1")
cd "$(dirname "$0")/.."
fail() {
    printf 'failed: %s\n' "$*" >&2
    exit 1
}
source tools/system_packages.sh
command -v qemu-aarch64-static > /dev/null || install_packages qemu-user-static || true
for program in qemu-aarch64-static apt-get dpkg-deb; do
    command -v "$program" > /dev/null || {
        echo "the wheel for aarch64 was not tried: $program is not there, and apt-get cannot install it"
        exit 3
    }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
root=$scratch/root
site=$root/site

# Lists and packages of another architecture, in folders of their own: those of this system stay as they are.
mkdir -p "$scratch/lists/partial" "$scratch/cache/archives/partial" "$site"
: > "$scratch/status"
cat > "$scratch/apt.conf" << END
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "";
Dir::State::lists "$scratch/lists";
Dir::State::status "$scratch/status";
Dir::Cache "$scratch/cache";
END
APT_CONFIG=$scratch/apt.conf apt-get update -qq
# numpy needs the library of C++.
APT_CONFIG=$scratch/apt.conf apt-get install -qq -y --download-only --no-install-recommends python3-minimal libpython3-stdlib libstdc++6 > /dev/null
for package in "$scratch"/cache/archives/*.deb; do
    dpkg-deb --extract "$package" "$root"
done
interpreter=$(echo "$root"/usr/bin/python3.[0-9]*)
python() { qemu-aarch64-static -L "$root" -E PYTHONPATH="$site" -E PYTHONHOME="$root/usr" "$interpreter" "$@"; }

python3 -m venv "$scratch/tools"
"$scratch/tools/bin/pip" download --quiet --disable-pip-version-check --only-binary :all: --no-deps \
    --platform manylinux2014_aarch64 --platform manylinux_2_28_aarch64 --python-version "${interpreter##*python}" --dest "$scratch/wheels" 'numpy>=1.23' 'tomli-w>=1.1'
for package in "$scratch"/wheels/*.whl "$wheel"; do
    python3 -m zipfile --extract "$package" "$site"
done

[ "$(python -c 'import platform; print(platform.machine())')" = aarch64 ] || fail "Python for aarch64 does not run"
cargo build --release --locked --workspace --quiet
for engine in dislocation xfem; do
    target/release/railcrack run cases/reference.toml --engine "$engine" --steps 2 --out "$scratch/here-$engine" --quiet > /dev/null
    python -c 'import sys; from railcrack._command import main; sys.exit(main())' \
        run "$PWD/cases/reference.toml" --engine "$engine" --steps 2 --out "$scratch/there-$engine" --quiet > /dev/null ||
        fail "$wheel does not run"
    # Another processor fuses and vectorises other operations.
    target/release/railcrack compare "$scratch/here-$engine" "$scratch/there-$engine" --out "$scratch/compared-$engine" --tolerance 1e-6 --quiet \
        > "$scratch/compared.txt" || {
        cat "$scratch/compared.txt"
        fail "$wheel computes something else"
    }
done
printf '%s: computes what this system computes, to 1e-6\n' "$(basename "$wheel")"
