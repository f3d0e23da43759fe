"""Opens whatever recording a path names; the one place that knows all kinds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from carpus.core.capture.source import FrameSource, Notice, ignore
from carpus.core.errors import RecordingMissing, RecordingUnreadable
from carpus.core.phrase import phrase

COLOR_LIST, RECORDING_FILE = "rgb.txt", "recording.oni"
REALSENSE_SUFFIXES = (".db3", ".bag")
KINECT_SUFFIX = ".mkv"
FILE_SUFFIXES = (".oni", ".carpusraw", *REALSENSE_SUFFIXES, KINECT_SUFFIX)
"""What recordings that are one file are called; a raw recording is known whatever its name."""


def open_recording(
    path: Path,
    *,
    need_depth: bool = True,
    registered: bool | None = None,
    leave_out_damaged: bool = False,
    data_folder: Path | None = None,
    notice: Notice = ignore,
) -> FrameSource:
    """A folder or file of any kind in :data:`RECORDINGS` as a source. The readers are loaded when needed.

    ``registered``: whether depth lies on colour in an .oni file that does not say so itself, None when nobody knows.
    ``leave_out_damaged``: a missing or damaged picture of a folder is left out, counted and told, not a fault.
    ``data_folder``: what is kept there of the camera is used where the recording brings no intrinsics of its own.
    """
    source = _opened(path, _How(need_depth, registered, leave_out_damaged, notice))
    if data_folder is None:
        return source
    from carpus.core.capture.calibrated import with_stored_calibration

    return with_stored_calibration(source, data_folder)


@dataclass(frozen=True, slots=True)
class _How:
    """As in :func:`open_recording`."""

    need_depth: bool
    registered: bool | None
    leave_out_damaged: bool
    notice: Notice


def _tum_folder(path: Path, how: _How) -> FrameSource:
    from carpus.core.capture.files.tum import TumFolder

    return TumFolder(
        path, need_depth=how.need_depth, read_ahead=8, leave_out_damaged=how.leave_out_damaged, notice=how.notice
    )


def _is_oni(path: Path) -> bool:
    return path.suffix.lower() == ".oni"


def _oni(path: Path, how: _How) -> FrameSource:
    from carpus.core.capture.files.oni_source import OniSource

    return OniSource(path, registered=how.registered, notice=how.notice)


def _is_raw(path: Path) -> bool:
    from carpus.core.capture.files.raw import is_raw_recording

    return is_raw_recording(path)


def _raw(path: Path, how: _How) -> FrameSource:
    from carpus.core.capture.files.raw import RawRecording

    return RawRecording(path, notice=how.notice)


def _is_realsense(path: Path) -> bool:
    return path.suffix.lower() in REALSENSE_SUFFIXES


def _realsense(path: Path, _how: _How) -> FrameSource:
    from carpus.core.capture.files.realsense_recording import RealSenseRecording

    return RealSenseRecording(path)


def _is_kinect(path: Path) -> bool:
    return path.suffix.lower() == KINECT_SUFFIX


def _kinect(path: Path, how: _How) -> FrameSource:
    from carpus.core.capture.files.kinect_recording import KinectRecording

    return KinectRecording(path, notice=how.notice)


RECORDINGS: tuple[tuple[Callable[[Path], bool], Callable[[Path, _How], FrameSource]], ...] = (
    (Path.is_dir, _tum_folder),
    (_is_oni, _oni),
    (_is_realsense, _realsense),
    (_is_kinect, _kinect),
    (_is_raw, _raw),
)
"""Every kind: whether a path is of it, and how it is opened; the first that is it counts."""


def _opened(path: Path, how: _How) -> FrameSource:
    if not path.exists():
        raise RecordingMissing(path)
    rendered = path / RECORDING_FILE
    if path.is_dir() and rendered.is_file() and not (path / COLOR_LIST).exists():
        path = rendered  # what "carpus simulate --format oni" makes
    for is_it, opened in RECORDINGS:
        if is_it(path):
            return opened(path, how)
    raise RecordingUnreadable(path, phrase("no recording of a form that Carpus knows"))
