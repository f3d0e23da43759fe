"""The live stream, read back by a second process: every number, and the time at which its picture was taken."""

from __future__ import annotations

import json
import subprocess
import sys
import uuid
from pathlib import Path

import numpy as np
import pylsl
import pytest

from carpus.core.calibration.result import Clicks
from carpus.core.model.hand.protocols import HAND21, joint_angle_names
from carpus.core.pipeline.lsl_stream import SampleStream, build_sample, list_channels
from tests.session.samples import compute_time, make_frame

SETTINGS = "[lab]\nKnownPeers = {127.0.0.1}\n[multicast]\nResolveScope = machine\n"
LISTENER = """
import json, sys, pylsl
found = [pylsl.resolve_byprop("source_id", each, timeout=20.0) for each in (sys.argv[1], sys.argv[1] + "-events")]
inlets = [pylsl.StreamInlet(streams[0], processing_flags=0) for streams in found]
for inlet in inlets:
    inlet.open_stream(timeout=20.0)
print("listening", flush=True)
about, one = inlets[0].info(timeout=20.0), None
labels, one = [], about.desc().child("channels").child("channel")
for _ in range(about.channel_count()):
    labels.append([one.child_value("label"), one.child_value("unit")])
    one = one.next_sibling()
samples = [inlets[0].pull_sample(timeout=20.0) for _ in range(5)]
event = inlets[1].pull_sample(timeout=20.0)
out = {"labels": labels, "samples": samples, "event": event}
print(json.dumps(out | {"type": about.type(), "rate": about.nominal_srate()}))
"""


def test_lsl_stream_is_read_by_another_process(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    settings = tmp_path / "lsl_api.cfg"
    settings.write_text(SETTINGS, encoding="utf-8")
    monkeypatch.setenv("LSLAPICFG", str(settings))
    source = f"carpus-{uuid.uuid4()}"
    monkeypatch.setattr("carpus.core.pipeline.lsl_stream.LIVE_ID", source)
    names = joint_angle_names()
    begun_s = pylsl.local_clock()
    offset_s = begun_s - compute_time(0)
    clicks = Clicks("left", HAND21, np.zeros((21, 2)))
    stream = SampleStream(clicks, 30.0, dip_free=False, clock=lambda: begun_s)
    listener = subprocess.Popen(
        [sys.executable, "-c", LISTENER, source], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        assert listener.stdout is not None
        assert listener.stdout.readline().strip() == "listening"
        assert stream.has_listener(20.0)
        frames = [make_frame(row, HAND21) for row in range(5)]
        for frame in frames:
            stream.on_frame(frame)
        stream.on_event(compute_time(2), "repetition")
        out, err = listener.communicate(timeout=60)
    finally:
        listener.kill()
        listener.wait()
    assert listener.returncode == 0, err
    read = json.loads(out)
    said = list_channels(HAND21, names)
    assert read["labels"] == [[channel.label, channel.unit] for channel in said]
    assert (read["type"], read["rate"]) == ("MoCap", 30.0)
    for row, (frame, (values, time_s)) in enumerate(zip(frames, read["samples"], strict=True)):
        assert np.allclose(values, build_sample(frame), rtol=1e-6, atol=1e-6, equal_nan=True)
        assert time_s == pytest.approx(compute_time(row) + offset_s, abs=1e-3), (
            "the time of the picture, not of sending"
        )
    flexion = [channel.label for channel in said].index("wrist_flexion")
    assert read["samples"][0][0][flexion] == pytest.approx(np.degrees(frames[0].kinematics.angles_rad[1]), rel=1e-5)
    assert read["event"][0] == ["repetition"]
    assert read["event"][1] == pytest.approx(compute_time(2) + offset_s, abs=1e-3)
