#!/usr/bin/env bash
# Pins the newest versions that pyproject.toml allows. Run with the lowest Python supported (3.11): its pins have
# wheels for every newer one too.
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
pin --output-file requirements.lock
hashes() {
    "$tools/bin/uv" pip compile --quiet --generate-hashes --no-header --no-annotate --universal --python-version 3.11 \
        --no-deps --native-tls requirements.lock installer/package/tools.lock --output-file installer/package/hashes.lock
}
pin --extra test --extra dev --constraint requirements.lock --output-file requirements-dev.lock
hashes
