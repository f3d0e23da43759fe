#!/usr/bin/env bash
# `make package-test`: the .deb in clean roots that have neither Python nor this repository: installed, started, a
# practice session to its PDF, an .oni played, a session opened by its file, upgraded, removed. Needs root and mmdebstrap.
# usage: installer/package/clean_root.sh [SUITE...]      (bookworm; noble is Ubuntu 24.04, from its own mirror, which
#        needs Ubuntu's keys: the package ubuntu-keyring, or UBUNTU_KEYRING=FILE)
#
# The real X server, keyboard and mouse (Xvfb, xdotool) are this machine's or the root's; the program sees only its root.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

say() { printf 'package-test: %s\n' "$*"; }
fail() { printf 'package-test: %s\n' "$@" >&2; exit 1; }
[ "$(id -u)" = 0 ] || fail "a clean root is entered by chroot, which only root may: sudo make package-test"
command -v mmdebstrap >/dev/null || fail "mmdebstrap is missing: apt-get install mmdebstrap"
deb=$(ls -t dist/carpus_*.deb 2>/dev/null | head -n 1 || true)
extra=$(ls -t dist/carpus-cameras-extra_*.deb 2>/dev/null | head -n 1 || true)
[ -n "$deb" ] && [ -n "$extra" ] || fail "there is no package yet: make package"

here=$PWD/installer/package
out=$PWD/build/package-test
roots=$(mktemp -d "${TMPDIR:-/var/tmp}/package-roots.XXXXXX")
trap 'rm -rf "$roots"' EXIT
mkdir -p "$out"

. installer/clean_roots.sh  # new_root, inside

# An older version of the same package, made of nothing but its name: what a clinic has before.
older() {
    local root=$1 built=$roots/older
    rm -rf "$built"
    mkdir -p "$built/DEBIAN" "$built/opt/carpus/parts"
    dpkg-deb --field "$deb" | sed -E 's/^Version: .*/Version: 0.0.9/; /^Depends: /d' >"$built/DEBIAN/control"
    echo old >"$built/opt/carpus/parts/of-the-old-version"
    dpkg-deb --root-owner-group --build "$built" "$root/srv/older.deb" >/dev/null
}

try() {
    local suite=$1 root=$roots/$1 log=$out/$1.log
    say "$suite: a root without Python (the whole log: $log)"
    new_root "$suite" "$root" "$log" \
        apt,xvfb,xauth,xdotool,imagemagick,fonts-dejavu-core,xclip,procps || return 1
    ! chroot "$root" sh -c 'command -v python3' || fail "there is a Python in the root"
    cp "$deb" "$root/srv/carpus.deb"
    cp "$extra" "$root/srv/extra.deb"
    cp "$here/in_the_root.sh" "$here/discs_on_screen.sh" "$root/srv/"
    older "$root"
    .venv/bin/python -m tests.capture.oni_writer "$root/srv/oni" && chmod -R a+rX "$root/srv/oni"
    rm -rf "$out/$suite"
    mkdir -p "$root/srv/out"
    local code=0
    inside "$root" PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 /bin/bash /srv/in_the_root.sh >>"$log" 2>&1 || code=$?
    mkdir -p "$out/$suite" && cp -r "$root/srv/out/." "$out/$suite/"
    grep '^in the root: ' "$log" || true
    [ "$code" = 0 ] || { tail -n 25 "$log"; say "$suite: FAILED"; return 1; }
    say "$suite: passed; pictures and the report: $out/$suite"
    rm -rf "$root"
}

[ $# -gt 0 ] || set -- bookworm
failed=""
for suite; do try "$suite" || failed+=" $suite"; done
[ -z "$failed" ] || fail "failed in:$failed"
