# Functions for the scripts that build for other systems, sourced by them. What pip installs for that is in target/wheel-tools.
#
#     need_target TARGET              the standard library of Rust for TARGET
#     release_tools                   maturin, zig and auditwheel, in the folder $tools
#     zig_compiler NAME TARGET        prints the path of a compiler of C for TARGET, as zig calls it

need_target() {
    rustup target list --installed | grep -qx "$1" && return
    rustup target add "$1" || { printf 'failed: rustup cannot install the target %s: is there a network?\n' "$1" >&2; exit 1; }
}

release_tools() {
    tools=$PWD/target/wheel-tools
    export ZIG_GLOBAL_CACHE_DIR=$PWD/target/zig
    [ -x "$tools/bin/auditwheel" ] && "$tools/bin/python" -c '' && return
    rm -rf "$tools"
    python3 -m venv "$tools"
    "$tools/bin/pip" install --quiet --disable-pip-version-check maturin==1.16.0 ziglang==0.17.1 auditwheel==6.8.2 ||
        { printf 'failed: pip cannot install maturin, zig and auditwheel: is there a network?\n' >&2; exit 1; }
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
