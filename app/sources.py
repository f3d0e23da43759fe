"""Opens whatever recording a path names; the one place that knows all kinds."""

from __future__ import annotations

from pathlib import Path

from carpus.core.capture.notice import Notice, ignore
from carpus.core.capture.source import FrameSource
from carpus.core.errors import RecordingMissing, RecordingUnreadable

COLOR_LIST, RECORDING_FILE = "rgb.txt", "recording.oni"


def open_recording(
    path: Path,
    *,
    need_depth: bool = True,
    registered: bool | None = None,
    leave_out_damaged: bool = False,
    data_folder: Path | None = None,
    notice: Notice = ignore,
) -> FrameSource:
    """A TUM folder, an .oni file or a raw recording as a source. The readers are loaded when needed.

    ``registered``: whether depth lies on colour in an .oni file that does not say so itself, None when nobody knows.
    ``leave_out_damaged``: a missing or damaged picture of a folder is left out, counted and told, not a fault.
    ``data_folder``: what is kept there of the camera is used where the recording brings no intrinsics of its own.
    """
    source = _opened(path, need_depth, registered, leave_out_damaged, notice)
    if data_folder is None:
        return source
    from carpus.core.capture.calibrated import with_stored_calibration

    return with_stored_calibration(source, data_folder)


def _opened(
    path: Path, need_depth: bool, registered: bool | None, leave_out_damaged: bool, notice: Notice
) -> FrameSource:
    if not path.exists():
        raise RecordingMissing(path)
    rendered = path / RECORDING_FILE
    if path.is_dir() and rendered.is_file() and not (path / COLOR_LIST).exists():
        path = rendered  # what "carpus simulate --format oni" makes
    if path.is_dir():
        from carpus.core.capture.tum import TumFolder

        return TumFolder(path, need_depth=need_depth, read_ahead=8, leave_out_damaged=leave_out_damaged, notice=notice)
    if path.suffix.lower() == ".oni":
        from carpus.core.capture.oni_source import OniSource

        return OniSource(path, registered=registered, notice=notice)
    from carpus.core.capture.raw import RawRecording, is_raw_recording

    if is_raw_recording(path):
        return RawRecording(path, notice=notice)
    raise RecordingUnreadable(path, "neither a TUM folder, an .oni file nor a raw recording")
