#!/usr/bin/env bash
# Makes this checkout ready to run (`setup.sh run`) or to run and test (`setup.sh test`).
# Installs missing system libraries by apt, creates .venv, installs the locked packages and Carpus itself.
# A stamp in .venv makes every later call return at once until a lock, pyproject.toml or this script changes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

export PATH  # where nobody set one, bash has its own and keeps it to itself; Python finds itself by it

purpose=${1:-run}
case "$purpose" in
    run) lock=requirements.lock ;;
    test) lock=requirements-dev.lock ;;
    *) echo "usage: installer/setup.sh [run|test]" >&2; exit 2 ;;
esac

say() { printf 'setup: %s\n' "$*"; }
fail() { printf 'setup: %s\n' "$@" >&2; exit 1; }

# --- done before? -------------------------------------------------------------------------------
mark() { { pwd; cat "$1" requirements-alone.lock requirements-build.lock installer/hashes.lock pyproject.toml setup.py installer/setup.sh; } | sha256sum | cut -d' ' -f1; }
ready() { [ -x .venv/bin/carpus ] && [ "$(cat ".venv/.ready-for-$1" 2>/dev/null)" = "$(mark "$2")" ]; }
is_compiled() {  # whether every module of core/compiled is there, and none of another source
    local source
    for source in core/compiled/[!_]*.py; do
        [ "${source%.py}.abi3.so" -nt "$source" ] || return 1
    done
}
compile() { .venv/bin/python setup.py -q build_ext --inplace || fail "core/compiled could not be built; a C compiler is needed (Debian: gcc libc6-dev)."; }
if ready "$purpose" "$lock" || { [ "$purpose" = run ] && ready test requirements-dev.lock; }; then
    is_compiled || compile
    exit 0
fi

# --- Python -------------------------------------------------------------------------------------
python=""
for candidate in ${PYTHON:-python3 python3.13 python3.12 python3.11}; do
    if "$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
        python=$candidate
        break
    fi
done
[ -n "$python" ] || fail "Python 3.11 or newer is needed and was not found." \
    "Install it (Debian 12, Ubuntu 24.04 and later: apt-get install python3 python3-venv) or name it: make run PYTHON=/path/to/python3"

# --- system libraries -----------------------------------------------------------------------------
# "what is looked for" "Debian package that brings it". Libraries are looked for by name, not by package, so that
# renamed packages (t64) and other distributions are recognised too.
libraries="
libGL.so.1 libgl1
libEGL.so.1 libegl1
libglib-2.0.so.0 libglib2.0-0
libdbus-1.so.3 libdbus-1-3
libfontconfig.so.1 libfontconfig1
libgssapi_krb5.so.2 libgssapi-krb5-2
libX11-xcb.so.1 libx11-xcb1
libxkbcommon.so.0 libxkbcommon0
libxkbcommon-x11.so.0 libxkbcommon-x11-0
libxcb-cursor.so.0 libxcb-cursor0
libxcb-icccm.so.4 libxcb-icccm4
libxcb-image.so.0 libxcb-image0
libxcb-keysyms.so.1 libxcb-keysyms1
libxcb-randr.so.0 libxcb-randr0
libxcb-render-util.so.0 libxcb-render-util0
libxcb-shape.so.0 libxcb-shape0
libxcb-sync.so.1 libxcb-sync1
libxcb-xfixes.so.0 libxcb-xfixes0
libxcb-xkb.so.1 libxcb-xkb1
libOpenNI2.so.0 libopenni2-0
"
programs="
cc gcc libc6-dev
"
[ "$purpose" = run ] || programs+="
pdftotext poppler-utils
Xvfb xvfb
xdotool xdotool
age age
desktop-file-validate desktop-file-utils
update-mime-database shared-mime-info
apt-ftparchive apt-utils
dpkg-parsechangelog dpkg-dev
appstreamcli appstream
"

missing_packages() {
    local known name package
    known=$(PATH="$PATH:/sbin:/usr/sbin" ldconfig -p 2>/dev/null || true)
    while read -r name package; do
        [ -z "$name" ] || grep -qF "$name " <<<"$known" || echo "$package"
    done <<<"$libraries"
    while read -r name package; do
        [ -z "$name" ] || command -v "$name" >/dev/null || echo "$package"
    done <<<"$programs"
    "$python" -c 'import ensurepip, venv' 2>/dev/null || echo python3-venv
    # The tests start a server of their own: its programs lie beside the path, and nothing of it need run.
    [ "$purpose" = run ] || ls /usr/lib/postgresql/*/bin/initdb >/dev/null 2>&1 || command -v initdb >/dev/null || echo postgresql
}

# Long work moves: on a terminal each step of a tool in one line, elsewhere a line every few seconds, also while the tool
# itself is silent. Read by the shell: some awk (mawk) hold back what they read from a pipe.
passing() {
    local pattern=$1 name=$2 count=0 step="" line printed=0 terminal="" code
    [ -t 1 ] && terminal=1
    SECONDS=0
    while true; do
        code=0
        IFS= read -r -t 2 line || code=$?
        if [ "$code" = 0 ]; then
            [[ $line =~ $pattern ]] || continue
            count=$((count + 1)) step=$line
        elif [ "$code" -le 128 ]; then  # the end; more than 128: silent for two seconds
            break
        fi
        if [ -n "$terminal" ]; then
            printf '\rsetup: %s, step %d, %d s: %-60.60s' "$name" "$count" "$SECONDS" "$step"
        elif [ "$SECONDS" -ge "$printed" ]; then
            printf 'setup: %s, step %d, %d s: %.60s\n' "$name" "$count" "$SECONDS" "$step"
            printed=$((SECONDS + 5))
        fi
    done
    if [ -n "$terminal" ] && [ "$count" -gt 0 ]; then echo; fi
}

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }

missing=$(missing_packages | sort -u | tr '\n' ' ')
if [ -n "$missing" ]; then
    if command -v apt-get >/dev/null && { [ "$(id -u)" = 0 ] || command -v sudo >/dev/null; }; then
        say "installing system packages by apt-get: $missing"
        export DEBIAN_FRONTEND=noninteractive
        as_root apt-get update -qq || say "the list of packages could not be renewed; going on with the old one"
        case " $missing " in *" postgresql "*)
            as_root mkdir -p /etc/postgresql-common/createcluster.d
            echo "create_main_cluster = false" | as_root tee /etc/postgresql-common/createcluster.d/carpus.conf >/dev/null ;;
        esac
        # shellcheck disable=SC2086  # a list of words
        as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing \
            | passing "^(Get|Unpacking|Setting up)" "apt-get" || say "apt-get did not install everything"
        hash -r
        missing=$(missing_packages | sort -u | tr '\n' ' ')
    fi
    case " $missing " in
        "  ") ;;
        *" python3-venv "*)
            fail "these system packages are missing: $missing" "Without python3-venv no environment can be made. Install them and start again." ;;
        *)
            [ "$purpose" = run ] || fail "the tests need these system packages: $missing" "Install them and start again."
            say "these system packages are missing: $missing"
            say "going on: tracking files works without them; the window or a live camera may not, and without a compiler Carpus cannot be built" ;;
    esac
fi

# --- the environment ------------------------------------------------------------------------------
if ! .venv/bin/python -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
    say "creating .venv with $("$python" --version)"
    "$python" -m venv --clear .venv
fi
rm -f .venv/.ready-for-*
install() { .venv/bin/python -m pip install --disable-pip-version-check --progress-bar off "$@" | passing "^(Collecting|Processing|Downloading|Installing)" pip; }
# Each file must have a hash of installer/hashes.lock; what builds Carpus itself is among them.
locks=("$lock" requirements-build.lock)
[ "$purpose" = run ] || locks+=(requirements-alone.lock)
installer/with_hashes.sh "${locks[@]}" >.venv/locked.txt || fail "nothing was installed."
say "installing the packages of $lock ($(grep -c == .venv/locked.txt) of them, about a minute)"
install --require-hashes --no-deps -r .venv/locked.txt
say "building Carpus"
.venv/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e . ||
    fail "Carpus could not be built; a C compiler is needed (Debian: gcc libc6-dev)."
mark "$lock" >".venv/.ready-for-$purpose"
say "ready: .venv/bin/carpus starts it (. .venv/bin/activate, then: carpus)"
