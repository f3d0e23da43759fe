"""What is tracked in four short recordings, as numbers: ``python -m tests.compiled.golden_tracks`` writes them anew.

Only a change that is meant to move the hand may do so; any other is held to them.
"""

from __future__ import annotations

import zlib
from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np

from carpus.core.calibration.calibrate import calibrate_hand
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.types import FloatArray, Frame
from carpus.core.pipeline.track import TrackSettings, build_pipeline, noise_from_neutral
from carpus.core.simulation.recording import CLICKS_FILE, render_cached
from carpus.core.simulation.spec import RecordingSpec
from tests.rendered import LEFT_DEVIATION, WHOLE_HAND

PLACE = Path(__file__).with_name("golden_tracks.npz")
SPECS: dict[str, RecordingSpec] = {"wrist": LEFT_DEVIATION, "hand": WHOLE_HAND}
IN_TROUBLE = " in trouble"
"""As recorded, and with pictures damaged, gone, without depth, with discs doubled and hidden."""
CASES = tuple(name + trouble for name in SPECS for trouble in ("", IN_TROUBLE))
MOST_FRAMES = 32


def trouble_frame(frame: Frame, clicks_px: FloatArray) -> Frame:
    """Every third picture with a disc once more where there is none, and the next disc behind what lies beside it."""
    if frame.index < 16 or frame.index % 3 or frame.depth_raw is None:  # those before are of the calibration
        return frame
    color, depth = frame.color_rgb.copy(), frame.depth_raw.copy()
    first = frame.index // 3
    disc, hidden = (np.rint(clicks_px[(first + k) % len(clicks_px)]).astype(int) for k in (0, 1))
    for source, target in ((disc, disc + (45, 40)), (hidden + (30, 0), hidden)):
        of, to = ((slice(v - 9, v + 9), slice(u - 9, u + 9)) for u, v in (source, target))
        color[to], depth[to] = frame.color_rgb[of], frame.depth_raw[of]
    return replace(frame, color_rgb=color, depth_raw=depth)


def damage_frames(frames: list[Frame], clicks_px: FloatArray) -> list[Frame]:
    """Some pictures without depth, some gone, one of nothing, some with false discs and a hidden one."""
    dark = np.zeros_like(frames[0].color_rgb)
    kept = [trouble_frame(frame, clicks_px) for frame in frames if not 25 <= frame.index < 28]
    kept = [replace(frame, depth_raw=None) if frame.index % 11 == 10 else frame for frame in kept]
    return [replace(frame, color_rgb=dark) if frame.index == 23 else frame for frame in kept]


def track_recording(folder: Path, *, in_trouble: bool) -> dict[str, np.ndarray]:
    """Status, readings and test statistic of each frame, and the angles looked back at; and a sum of the pictures."""
    clicks = read_clicks(folder / CLICKS_FILE)
    frames = list(islice(TumFolder(folder).frames(), MOST_FRAMES))
    seen = zlib.crc32(b"".join(frame.color_rgb.tobytes() + _bytes(frame) for frame in frames))
    if in_trouble:
        frames = damage_frames(frames, clicks.pixel)
    camera, settings = TumFolder(folder).info.camera, TrackSettings()
    opening = [frame for frame in frames if frame.timestamp_s - frames[0].timestamp_s <= settings.calibration.still_s]
    outcome = calibrate_hand(clicks, opening, camera, settings.calibration, settings.detection, None)
    ends_s = opening[max(outcome.capture_frames, 1) - 1].timestamp_s
    pipeline = build_pipeline(outcome, camera, settings, noise_from_neutral(outcome.noise, ends_s, settings.tracker))
    found = [pipeline(frame) for frame in frames if frame.timestamp_s > ends_s]
    moments = [frame.kinematics for frame in found]
    back = pipeline.tracker.smooth()
    return {
        "pictures": np.array(seen, dtype=np.uint32),
        "status": np.array([list(type(frame.status)).index(frame.status) for frame in found], dtype=np.uint8),
        "nis": np.float32([frame.nis for frame in found]),
        "position_m": np.float32([moment.position_m for moment in moments]),
        "velocity_m_s": np.float32([moment.velocity_m_s for moment in moments]),
        "angles_rad": np.float32([moment.angles_rad for moment in moments]),
        "angles_sd_rad": np.float32([moment.angles_sd_rad for moment in moments]),
        "angular_velocity_rad_s": np.float32([moment.angular_velocity_rad_s for moment in moments]),
        "joint_angles_rad": np.float32([moment.joint_angles_rad for moment in moments]),
        "joint_angles_sd_rad": np.float32([moment.joint_angles_sd_rad for moment in moments]),
        "joint_velocity_rad_s": np.float32([moment.joint_velocity_rad_s for moment in moments]),
        "joint_position_m": np.float32([moment.joint_position_m for moment in moments]),
        "back_angles_rad": np.float32([moment.angles_rad for moment in back]),
        "back_joint_angles_rad": np.float32([moment.joint_angles_rad for moment in back]),
    }


def _bytes(frame: Frame) -> bytes:
    return b"" if frame.depth_raw is None else frame.depth_raw.tobytes()


def main() -> None:
    """Write the file."""
    out = {}
    for case in CASES:
        folder = render_cached(SPECS[case.removesuffix(IN_TROUBLE)])
        out |= {
            f"{case}/{key}": value
            for key, value in track_recording(folder, in_trouble=case.endswith(IN_TROUBLE)).items()
        }
    np.savez_compressed(PLACE, **out)
    print(f"{PLACE.name}: {PLACE.stat().st_size} bytes")


if __name__ == "__main__":
    main()
