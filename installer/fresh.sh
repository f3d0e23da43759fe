#!/usr/bin/env bash
# The README's two commands on a machine that has nothing: `make run` and `make test` in clean roots of Debian and
# Ubuntu, with an empty environment. Needs root, git and mmdebstrap; takes the last commit, not what is uncommitted.
# usage: installer/fresh.sh [SUITE...]      (bookworm and trixie: Debian 12 and 13; noble is Ubuntu 24.04, which needs
#        Ubuntu's keys: the package ubuntu-keyring, or UBUNTU_KEYRING=FILE; TARGETS=run tries the first command alone)
#
# How packages are reached is this machine's matter: its proxies, certificates and pip settings go along, nothing else.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf 'fresh: %s\n' "$*"; }
fail() { printf 'fresh: %s\n' "$@" >&2; exit 1; }

[ "$(id -u)" = 0 ] || fail "a clean root is entered by chroot, which only root may: sudo make fresh"
command -v mmdebstrap >/dev/null || fail "mmdebstrap is missing: apt-get install mmdebstrap"
[ -z "$(git status --porcelain)" ] || say "what is uncommitted is not tried"

checkout=$PWD
logs=$checkout/build/fresh
roots=$(mktemp -d "${TMPDIR:-/var/tmp}/fresh-roots.XXXXXX")
trap 'rm -rf "$roots"' EXIT
mkdir -p "$logs"

. installer/clean_roots.sh  # new_root, inside

# --- how pip reaches its packages -----------------------------------------------------------------
# Files, folders and variables of this machine's pip become one /etc/pip.conf inside; what it names goes along.
settle_pip() {
    python3 - "$1" <<'PYTHON'
import ast
import shutil
import subprocess
import sys
from pathlib import Path

root = Path(sys.argv[1])
listed = subprocess.run([sys.executable, "-m", "pip", "config", "list"], capture_output=True, text=True).stdout
settings = {}
for line in listed.splitlines():
    key, _, value = line.partition("=")
    settings[key.rpartition(".")[2]] = ast.literal_eval(value)
lines = ["[global]"]
for key, value in settings.items():
    words = value.split()
    for place, word in enumerate(words):
        path = Path(word.removeprefix("file://"))
        if path.is_absolute() and path.is_file():
            # In a folder of its own: packages of the root write to the usual places.
            kept = Path("etc/pip.files") / path.name
            (root / kept).parent.mkdir(exist_ok=True)
            shutil.copyfile(path, root / kept)
            words[place] = f"/{kept}"
        elif path.is_absolute() and path.is_dir():
            print(path.parent if path.name == "simple" else path)  # the pages of an index name files beside it
    lines.append(f"{key} = " + "\n    ".join(words))
(root / "etc/pip.conf").write_text("\n".join(lines) + "\n")
PYTHON
}

# --- one root ---------------------------------------------------------------------------------------
try() {
    local suite=$1 root=$roots/$1 log=$logs/$1.log start words=""
    say "$suite: a root with python3, git and make (the whole log: $log)"
    new_root "$suite" "$root" "$log" python3,git,make || return 1
    settle_pip "$root" >"$root/.folders"
    git clone --quiet --no-hardlinks "file://$checkout" "$root/srv/carpus"
    for target in ${TARGETS:-run test}; do
        start=$SECONDS
        inside "$root" /bin/sh -c "cd /srv/carpus && exec make $target" >>"$log" 2>&1 \
            || { tail -n 60 "$log"; say "$suite: make $target FAILED"; return 1; }
        words+=", make $target $(((SECONDS - start) / 60)) min $(((SECONDS - start) % 60)) s"
    done
    grep -E '^[0-9]+ passed|^=+ .*passed' "$log" | tail -n 1
    say "$(. "$root/etc/os-release"; echo "$PRETTY_NAME"), $(chroot "$root" python3 --version)$words: passed"
    rm -rf "$root"
}

[ $# -gt 0 ] || set -- bookworm trixie
failed=""
for suite; do try "$suite" || failed+=" $suite"; done
[ -z "$failed" ] || fail "failed in:$failed"
