"""Which kernels run, and that none of another source ever does."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from carpus.core.capture.doctor import kernels_finding
from carpus.core.kernels import build, choice

ASK = (
    "from carpus.core.kernels import choice; k = choice.in_c(); print('numpy' if k is None else k.level);"
    "from carpus.core.capture.doctor import kernels_finding; print(kernels_finding().state)"
)


@pytest.mark.parametrize(
    ("asked", "levels", "state"),
    [("numpy", {"numpy"}, "warning"), ("plain", {"plain"}, "good"), ("", {"plain", "wide"}, "good")],
)
def test_the_variable_chooses(asked: str, levels: set[str], state: str) -> None:
    environment = os.environ | {choice.VARIABLE: asked}
    done = subprocess.run([sys.executable, "-c", ASK], env=environment, capture_output=True, text=True, check=True)
    level, found = done.stdout.split()
    assert level in levels
    assert found == state


def test_what_is_built_is_called_by_its_source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("about.c", "kernels.h"):  # the digest is of whatever is there, and these are compiled at once
        shutil.copy(build.HERE / name, tmp_path)
    monkeypatch.setattr(build, "HERE", tmp_path)
    first = build.digest()
    stale = tmp_path / f"kernels-0123456789ab-plain{build.SUFFIX}"
    stale.write_bytes(b"")
    (tmp_path / "about.c").write_text((tmp_path / "about.c").read_text() + "/* another one */\n")
    assert build.digest() != first
    monkeypatch.setattr(build, "levels", lambda: ("plain",))
    (built,) = build.built()
    assert built.name == f"kernels-{build.digest()}-plain{build.SUFFIX}"
    assert not stale.exists()
    renamed = built.rename(tmp_path / f"kernels-{first}-plain{build.SUFFIX}")
    with pytest.raises(OSError, match="of another source"):
        choice.Kernels(renamed, "plain")


@pytest.mark.parametrize("content", [b"", b"\x7fELF no library"])
def test_what_is_no_library_is_not_loaded(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / f"kernels-{build.digest()}-plain{build.SUFFIX}"
    path.write_bytes(content)
    with pytest.raises(OSError):
        choice.Kernels(path, "plain")


@pytest.mark.parametrize(
    "spoil", [lambda whole: whole[: len(whole) // 2], lambda whole: whole[:9000] + b"?" + whole[9001:]]
)
def test_a_library_that_is_not_whole_is_told_not_used_and_built_again(
    spoil: Callable[[bytes], bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The system would end the program with a signal."""
    for name in ("about.c", "kernels.h"):
        shutil.copy(build.HERE / name, tmp_path)
    monkeypatch.setattr(build, "HERE", tmp_path)
    monkeypatch.setattr(build, "levels", lambda: ("plain",))
    monkeypatch.setattr(choice, "levels", lambda: ("plain",))
    (built,) = build.built()
    assert kernels_finding().state == "good"
    built.write_bytes(spoil(built.read_bytes()))
    with pytest.raises(OSError, match="not whole"):
        choice.Kernels(built, "plain")
    assert choice._loaded("") is None
    finding = kernels_finding()
    assert finding.state == "warning"
    assert built.name in finding.found
    assert build.built() == [built]
    assert build.is_whole(built)
    assert kernels_finding().state == "good"


def test_without_a_compiler_all_runs_and_one_line_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for path in build.sources():
        shutil.copy(path, tmp_path)
    monkeypatch.setattr(build, "HERE", tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    assert build.main() == 0
    assert capsys.readouterr().out.count("\n") == 1
    monkeypatch.setattr(choice, "_chosen", None)
    finding = kernels_finding()
    assert finding.state == "warning"
    assert "gcc" in finding.remedy


def test_a_compiler_that_fails_is_told_and_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copy(build.HERE / "kernels.h", tmp_path)
    (tmp_path / "broken.c").write_text("this is no C\n")
    monkeypatch.setattr(build, "HERE", tmp_path)
    assert build.main() == 0
    assert "failed" in capsys.readouterr().out
    assert sorted(path.name for path in tmp_path.iterdir()) == ["broken.c", "kernels.h"]


@pytest.mark.parametrize(("status", "fault"), [(1, np.linalg.LinAlgError), (2, MemoryError), (3, ValueError)])
def test_what_a_kernel_returns_is_raised_as_what_it_is(status: int, fault: type[Exception]) -> None:
    """No memory is no matter of the matrix."""
    with pytest.raises(fault):
        choice._called(lambda *_: status, "double one")(1.0)
