# For a shell: `. scripts/target-env.sh; use_targets`. Then plain `cargo … --target thumb…` works in it with
#
#  - a rustup toolchain that has the targets: nothing is changed;
#  - Debian's rustc, cargo and rust-src (packages rustc-web, cargo-web, rust-web-src, lld) where there is no rustup, or
#    where it cannot fetch the targets: core and alloc are compiled once, half a minute for each target, into
#    target/debian-toolchain, and its bin/ is put first in PATH.
#
# Without either it says what to install and returns 1. THUMB_TARGETS names the targets. scripts/test does this itself.
# shellcheck shell=sh

THUMB_TARGETS=${THUMB_TARGETS:-thumbv6m-none-eabi thumbv7m-none-eabi thumbv7em-none-eabi thumbv7em-none-eabihf \
thumbv8m.main-none-eabi thumbv8m.main-none-eabihf}

# The targets that the toolchain in the directory $1 has no core library for.
missing_targets() {
    for target in $THUMB_TARGETS; do
        ls "$1/lib/rustlib/$target/lib"/libcore-*.rlib >/dev/null 2>&1 || printf '%s ' "$target"
    done
}

have_debian_rust() {
    [ -x /usr/bin/rustc ] && [ -x /usr/bin/cargo ] && [ -d /usr/lib/rustlib/src/rust/library ]
}

debian_toolchain() {
    # Absolute: rustc is called from other folders, too.
    mkdir -p "${CARGO_TARGET_DIR:-target}" || return
    dir=$(cd "${CARGO_TARGET_DIR:-target}" && pwd)/debian-toolchain
    host=$(/usr/bin/rustc -vV | sed -n 's/^host: //p')
    # A library works only with the compiler that made it.
    version=$(/usr/bin/rustc -vV)
    [ "$(cat "$dir/version" 2>/dev/null)" = "$version" ] || rm -rf "$dir"
    mkdir -p "$dir/bin" "$dir/sysroot/src" "$dir/lib/rustlib/$host/bin" || return
    ln -sfn "/usr/lib/rustlib/$host/lib" "$dir/lib/rustlib/$host/lib"
    ln -sf /usr/bin/cargo "$dir/bin/cargo"
    for tool in rustc rustdoc; do
        printf '#!/bin/sh\nexec /usr/bin/%s --sysroot "%s" "$@"\n' $tool "$dir" >"$dir/bin/$tool"
        chmod +x "$dir/bin/$tool"
    done
    # The targets' default linker is rust-lld, which Debian leaves out. Any lld from 14 on does; a `rust-lld` found in
    # PATH may be a proxy that would call itself.
    for lld in ld.lld ld.lld-22 ld.lld-19 ld.lld-16 ld.lld-14; do
        if lld=$(command -v "$lld"); then
            ln -sf "$lld" "$dir/lib/rustlib/$host/bin/rust-lld"
            break
        fi
    done
    cat >"$dir/sysroot/Cargo.toml" <<'END'
[package]
name = "sysroot"
version = "0.0.0"
edition = "2021"
[workspace]
END
    echo '#![no_std]' >"$dir/sysroot/src/lib.rs"
    for target in $(missing_targets "$dir"); do
        echo "compiling core and alloc for $target with Debian's rustc (once)" >&2
        # Bitcode, because the release profile optimises across crates when linking.
        (
            cd "$dir/sysroot" && env -u CARGO_BUILD_TARGET -u CARGO_TARGET_DIR \
                RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 RUSTFLAGS="-Cembed-bitcode=yes" \
                /usr/bin/cargo build --quiet --release -Zbuild-std=core,alloc --target "$target"
        ) || return
        mkdir -p "$dir/lib/rustlib/$target/lib"
        cp "$dir/sysroot/target/$target/release/deps"/lib*.rlib "$dir/lib/rustlib/$target/lib/" || return
        rm -rf "$dir/sysroot/target" "$dir/lib/rustlib/$target/lib"/libsysroot-*.rlib
    done
    printf '%s\n' "$version" >"$dir/version"
    PATH=$dir/bin:$PATH
    DEBIAN_TOOLCHAIN=$dir
    export PATH DEBIAN_TOOLCHAIN
}

use_targets() {
    missing=$(missing_targets "$(rustc --print sysroot)")
    [ -n "$missing" ] || return 0
    if have_debian_rust; then
        debian_toolchain
    else
        echo "no core library for: $missing" >&2
        echo "  rustup target add $missing" >&2
        echo "  or, on Debian: sudo apt-get install rustc-web cargo-web rust-web-src lld" >&2
        return 1
    fi
}
