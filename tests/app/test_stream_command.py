"""``carpus track --stream``, heard by another process; and that nothing goes out unless a person chose it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from carpus.app.__main__ import main
from carpus.app.settings import StreamSettings, keep_preferences, load_settings
from carpus.core.session.reader import read_session
from tests.rendered import FLEXION, Rendered

SETTINGS = "[lab]\nKnownPeers = {127.0.0.1}\nSessionID = stream-command\n[multicast]\nResolveScope = machine\n"
LISTENER = """
import json, pylsl
found = pylsl.resolve_byprop("source_id", "carpus-live", timeout=60.0)
inlet = pylsl.StreamInlet(found[0], processing_flags=0)
inlet.open_stream(timeout=20.0)
samples = [inlet.pull_sample(timeout=20.0) for _ in range(24)]
print(json.dumps(samples))
"""


def test_another_process_hears_what_is_tracked_at_the_times_of_the_pictures(rendered: Rendered, tmp_path: Path) -> None:
    folder, output = rendered(FLEXION), tmp_path / "session.h5"
    (tmp_path / "lsl_api.cfg").write_text(SETTINGS, encoding="utf-8")
    environment = {**os.environ, "LSLAPICFG": str(tmp_path / "lsl_api.cfg")}
    listener = subprocess.Popen(
        [sys.executable, "-c", LISTENER], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
    )
    command = ["track", str(folder), "--calibration", str(folder / "calibration.json"), "--output", str(output)]
    try:
        done = subprocess.run(
            [sys.executable, "-m", "carpus", *command, "--stream", "--no-smooth"],
            env=environment, capture_output=True, text=True, timeout=120,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        assert "nobody listens" not in done.stderr
        out, err = listener.communicate(timeout=60)
    finally:
        listener.kill()
        listener.wait()
    assert listener.returncode == 0, err
    samples, session = json.loads(out), read_session(output)
    assert len(session) == len(samples) == 24
    heard = np.array([values[1:4] for values, _ in samples])
    assert np.allclose(heard, np.degrees(session.motion.angles_rad), atol=1e-4)
    times_s = np.array([time_s for _, time_s in samples])
    assert np.allclose(times_s - times_s[0], session.timestamp_s - session.timestamp_s[0], atol=1e-4)


def test_a_stream_is_of_one_recording(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["track", str(tmp_path), str(tmp_path), "--output", str(tmp_path / "out"), "--stream"]) == 2
    assert "one recording" in capsys.readouterr().err


def test_nothing_goes_out_unless_chosen_and_the_choice_is_kept(tmp_path: Path) -> None:
    settings = load_settings(tmp_path)
    assert not settings.stream.on
    keep_preferences(replace(settings, stream=StreamSettings(True)), tmp_path)
    assert load_settings(tmp_path).stream.on
