"""Opens whatever recording a path names; the one place that knows all kinds."""

from __future__ import annotations

from pathlib import Path

from core.capture.notice import Notice, ignore
from core.capture.source import FrameSource
from core.errors import RecordingMissing, RecordingUnreadable

COLOR_LIST, RECORDING_FILE = "rgb.txt", "recording.oni"


def open_recording(
    path: Path,
    *,
    need_depth: bool = True,
    registered: bool | None = None,
    leave_out_damaged: bool = False,
    notice: Notice = ignore,
) -> FrameSource:
    """A TUM folder, an .oni file or a raw recording as a source. The readers are loaded when needed.

    ``registered``: whether depth lies on colour in an .oni file that does not say so itself, None when nobody knows.
    ``leave_out_damaged``: a missing or damaged picture of a folder is left out, counted and told, not a fault.
    """
    if not path.exists():
        raise RecordingMissing(path)
    rendered = path / RECORDING_FILE
    if path.is_dir() and rendered.is_file() and not (path / COLOR_LIST).exists():
        path = rendered  # what "carpus simulate --format oni" makes
    if path.is_dir():
        from core.capture.tum import TumFolder

        return TumFolder(path, need_depth=need_depth, read_ahead=8, leave_out_damaged=leave_out_damaged, notice=notice)
    if path.suffix.lower() == ".oni":
        from core.capture.oni_source import OniSource

        return OniSource(path, registered=registered, notice=notice)
    from core.capture.raw import RawRecording, is_raw_recording

    if is_raw_recording(path):
        return RawRecording(path, notice=notice)
    raise RecordingUnreadable(path, "neither a TUM folder, an .oni file nor a raw recording")
