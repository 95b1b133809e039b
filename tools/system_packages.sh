# Functions for the scripts that need programs of the system, sourced by them. They call `fail` of the script.
#
#     install_packages PACKAGE…            packages of Debian, by root or sudo; false where they cannot be installed
#     need_program PROGRAM PACKAGE…        PROGRAM, of these packages where it is not there yet

install_packages() {
    command -v apt-get > /dev/null || return 1
    as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi; }
    # Another apt-get may be at work.
    as_root apt-get -o DPkg::Lock::Timeout=300 update -qq &&
        as_root env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 install -y -qq --no-install-recommends "$@" > /dev/null
}

need_program() {
    local program=$1
    shift
    command -v "$program" > /dev/null || install_packages "$@" || fail "$program is needed, and apt-get cannot install it"
}
