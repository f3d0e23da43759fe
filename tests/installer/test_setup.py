"""The set-up of a fresh machine says how far it is."""

from __future__ import annotations

import subprocess
from pathlib import Path

SETUP = Path(__file__).parents[2] / "installer" / "setup.sh"


def test_passing_silent_tool_writes_a_line_every_few_seconds() -> None:
    script = f"""
set -euo pipefail
eval "$(sed -n '/^passing()/,/^}}/p' {SETUP})"
tool() {{ echo "Get:1 first"; sleep 9; echo "noise"; printf 'Setting up second'; return 3; }}
tool | passing "^(Get|Setting up)" apt-get
"""
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=60, check=False)
    lines = done.stdout.splitlines()
    assert done.returncode == 3, "the tool's own end is kept"
    assert len(lines) >= 2
    assert all(line.startswith("setup: apt-get, step 1, ") for line in lines)
    assert "Get:1 first" in lines[-1]
