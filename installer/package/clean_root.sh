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

. installer/where_from.sh  # mirror, apt_config

ubuntu_keyring=${UBUNTU_KEYRING:-/usr/share/keyrings/ubuntu-archive-keyring.gpg}
from_where() {  # one word or line a line: options and sources of mmdebstrap for a suite
    case "$1" in
        bookworm | trixie) [ -z "$mirror" ] || printf '%s\n' "$mirror" ;;
        *)
            [ -f "$ubuntu_keyring" ] || fail "$1 needs Ubuntu's keys: apt-get install ubuntu-keyring, or UBUNTU_KEYRING=FILE"
            printf 'deb http://archive.ubuntu.com/ubuntu %s main universe\n' "$1" "$1-updates" ;;
    esac
}

# In mount and process spaces of their own: nothing is left mounted or running, however this ends.
inside() {
    local root=$1; shift
    unshare --mount --pid --fork --kill-child bash -euo pipefail -c '
        root=$1; shift
        mount -t proc proc "$root/proc"
        mount --rbind /dev "$root/dev"
        mount -t tmpfs tmpfs "$root/dev/shm"
        exec chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 "$@"
    ' inside "$root" "$@" </dev/null
}

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
    local sources keys=()
    sources=$(from_where "$suite")
    case "$suite" in bookworm | trixie) ;; *) keys=(--keyring="$ubuntu_keyring") ;; esac
    mmdebstrap "${keys[@]}" --variant=minbase --include=apt,xvfb,xauth,xdotool,imagemagick,fonts-dejavu-core,xclip,procps --aptopt="$apt_config" \
        "$suite" "$root" ${sources:+"$sources"} >"$log" 2>&1 || { tail -n 20 "$log"; return 1; }
    ! chroot "$root" sh -c 'command -v python3' || fail "there is a Python in the root"
    cp /etc/hosts "$root/etc/hosts"
    cp "$deb" "$root/srv/carpus.deb"
    cp "$extra" "$root/srv/extra.deb"
    cp "$here/in_the_root.sh" "$here/discs_on_screen.sh" "$root/srv/"
    older "$root"
    rm -rf "$out/$suite"
    mkdir -p "$root/srv/out"
    local code=0
    inside "$root" /bin/bash /srv/in_the_root.sh >>"$log" 2>&1 || code=$?
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
