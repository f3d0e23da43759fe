"""Of what, by what: hashes that another program computes alike, and a revision that git knows."""

from __future__ import annotations

import hashlib
import json
import subprocess
from pathlib import Path

import pytest

from carpus.app.__main__ import main
from carpus.core.platform.provenance import sha256_of_recording, sha256_of_settings, source_revision
from carpus.core.session.reader import read_session
from tests.rendered import FLEXION, Rendered

ROOT = Path(__file__).parents[1]


def test_source_revision_matches_git() -> None:
    asked = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "HEAD"], capture_output=True, text=True, check=False)
    if asked.returncode:
        assert source_revision() == "", "no checkout, and nothing told"
    else:
        assert source_revision() == asked.stdout.strip()


def test_recording_hash_covers_lists_and_frames_only(tmp_path: Path) -> None:
    (tmp_path / "rgb").mkdir()
    contents = {"rgb/1.png": b"one", "rgb/2.png": b"two"}
    contents["rgb.txt"] = b"# colour\n1.0 rgb/1.png\n2.0 rgb/2.png\n"
    for name, content in contents.items():
        (tmp_path / name).write_bytes(content)
    lines = "".join(f"{hashlib.sha256(contents[name]).hexdigest()} {name}\n" for name in sorted(contents))
    wanted = hashlib.sha256(lines.encode()).hexdigest()
    assert sha256_of_recording(tmp_path) == wanted
    (tmp_path / "truth.h5").write_bytes(b"beside it")
    assert sha256_of_recording(tmp_path) == wanted
    (tmp_path / "rgb" / "2.png").write_bytes(b"Two")
    assert sha256_of_recording(tmp_path) != wanted
    assert sha256_of_recording(tmp_path / "rgb" / "1.png") == hashlib.sha256(b"one").hexdigest()


def test_session_states_provenance(rendered: Rendered, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder, output = rendered(FLEXION), tmp_path / "s.h5"
    track = ["track", str(folder), "--calibration", str(folder / "calibration.json"), "--output", str(output)]
    assert main(track) == 0
    told = json.loads(read_session(output).header.parameters)
    assert told["source"]["sha256"] == sha256_of_recording(folder)
    assert told["provenance"]["settings_sha256"] == sha256_of_settings(told["settings"])
    assert told["provenance"]["revision"] == source_revision()
    capsys.readouterr()
    assert main(["info", str(output)]) == 0
    assert told["source"]["sha256"] in capsys.readouterr().out
