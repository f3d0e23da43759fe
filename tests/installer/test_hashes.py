"""What set-up installs: every pin has hashes, and a pin without stops it."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LOCKS = ("requirements.lock", "requirements-dev.lock", "requirements-alone.lock", "requirements-build.lock")


def pins(text: str) -> set[str]:
    return {f"{name}=={version}" for name, version in re.findall(r"(?m)^([\w.-]+)(?:\[.*?\])?==([^\s;\\]+)", text)}


def with_hashes(folder: Path, *locks: str) -> subprocess.CompletedProcess[str]:
    command = [str(folder / "installer/with_hashes.sh"), *locks]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("lock", LOCKS)
def test_pins_all_have_hashes(lock: str) -> None:
    done = with_hashes(ROOT, lock)
    assert (done.returncode, done.stderr) == (0, "")
    assert pins(done.stdout) == pins((ROOT / lock).read_text(encoding="utf-8"))
    blocks = re.split(r"(?m)^(?=\S)", done.stdout)[1:]
    assert all("--hash=sha256:" in block for block in blocks)
    assert "://" not in done.stdout, "it names no host"


def test_pin_without_hash_stops_set_up(tmp_path: Path) -> None:
    (tmp_path / "installer").mkdir()
    for name in ("with_hashes.sh", "hashes.lock"):
        shutil.copy(ROOT / "installer" / name, tmp_path / "installer" / name)
    lock = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    (tmp_path / "r.lock").write_text(f"{lock}nobody-pinned-this==1.0\n")
    done = with_hashes(tmp_path, "r.lock")
    assert done.returncode == 1
    assert "nobody-pinned-this==1.0" in done.stderr


def test_set_up_installs_nothing_else() -> None:
    script = (ROOT / "installer/setup.sh").read_text(encoding="utf-8")
    installs = [
        line for line in script.splitlines() if re.search(r"(^install|pip install) ", line) and "()" not in line
    ]
    assert len(installs) == 2
    assert all("--require-hashes" in line or "--no-build-isolation -e ." in line for line in installs)
