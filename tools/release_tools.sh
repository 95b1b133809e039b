# Functions for the scripts that build for other systems, sourced by them. What pip installs for that is in target/wheel-tools.
#
#     need_target TARGET              the standard library of Rust for TARGET
#     release_tools                   the packages of tools/release-tools.txt by their hashes, in the folder $tools
#     hashed PIP                      installs these packages by the program PIP
#     zig_compiler NAME TARGET        prints the path of a compiler of C for TARGET, as zig calls it

need_target() {
    rustup target list --installed | grep -qx "$1" && return
    rustup target add "$1" || { printf 'failed: rustup cannot install the target %s: is there a network?\n' "$1" >&2; exit 1; }
}

release_tools() {
    tools=$PWD/target/wheel-tools
    export ZIG_GLOBAL_CACHE_DIR=$PWD/target/zig
    # The list that it has, so that a new one is installed.
    cmp -s tools/release-tools.txt "$tools/list.txt" && "$tools/bin/python" -c '' && return
    rm -rf "$tools"
    python3 -m venv "$tools"
    hashed "$tools/bin/pip"
    cp tools/release-tools.txt "$tools/list.txt"
}

hashed() {
    "$1" install --quiet --disable-pip-version-check --require-hashes --only-binary :all: -r tools/release-tools.txt ||
        { printf 'failed: pip cannot install the packages of tools/release-tools.txt: is there a network?\n' >&2; exit 1; }
}

# Cargo calls targets by more words than zig, which takes its own alone.
zig_compiler() {
    local compiler=$PWD/target/zig/$1
    mkdir -p target/zig
    cat > "$compiler.new" << END
#!/bin/sh
for argument do
    shift
    case \$argument in --target=*) ;; *) set -- "\$@" "\$argument" ;; esac
done
exec "$tools/bin/python" -m ziglang cc -target $2 "\$@"
END
    chmod +x "$compiler.new"
    # A compiler that is newer than what it made makes it again.
    if cmp -s "$compiler.new" "$compiler"; then rm "$compiler.new"; else mv "$compiler.new" "$compiler"; fi
    printf '%s\n' "$compiler"
}
