#!/usr/bin/env bash
# Pins the newest versions that pyproject.toml allows. Run with the lowest Python supported (3.11): its pins have
# wheels for every newer one too. `installer/lock.sh hashes` leaves the pins and only looks their hashes up.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

python=${PYTHON:-python3.11}
tools=build/lock-tools
[ -x "$tools/bin/pip-compile" ] || { "$python" -m venv "$tools" && "$tools/bin/pip" install --quiet pip-tools uv; }
export CUSTOM_COMPILE_COMMAND="make lock"
pin() {
    "$tools/bin/pip-compile" --quiet --upgrade --strip-extras --annotation-style=line --no-emit-index-url \
        --no-emit-find-links --no-emit-trusted-host --no-emit-options "$@" pyproject.toml
}
lowest=3.11
with_hashes() {  # of the pins of some locks, each with the hash of every file of it, into the last
    "$tools/bin/uv" pip compile --quiet --generate-hashes --no-header --no-annotate --universal --python-version "$lowest" \
        --no-deps --native-tls "${@:1:$#-1}" --output-file "${@: -1}"
}
if [ "${1:-}" != hashes ]; then
    pin --output-file requirements.lock
    pin --group test --group dev --constraint requirements.lock --output-file requirements-dev.lock
fi
with_hashes requirements-dev.lock requirements-alone.lock requirements-build.lock installer/hashes.lock
with_hashes requirements.lock installer/package/tools.lock installer/package/cameras.lock installer/package/hashes.lock
lowest=3.12 with_hashes requirements-docs.lock requirements-docs.lock  # one of its tools wants 3.11.5
