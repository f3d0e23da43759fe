"""Opens recordings of all kinds, and plans the inputs and outputs of a batch."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.core.capture.source import FrameSource, NoticeHandler, ignore_notice
from carpus.core.model.errors import IntrinsicsAssumed, RecordingMissing, RecordingUnreadable
from carpus.core.model.phrase import phrase

if TYPE_CHECKING:
    from carpus.app.settings import Settings

COLOR_LIST = "rgb.txt"
REALSENSE_SUFFIX = ".db3"
FILE_SUFFIXES = (".oni", ".carpusraw", REALSENSE_SUFFIX)
"""Suffixes of recordings in one file; a raw recording is recognized by its content."""


def open_recording(
    path: Path,
    *,
    need_depth: bool = True,
    registered: bool | None = None,
    leave_out_damaged: bool = False,
    data_folder: Path | None = None,
    notice: NoticeHandler = ignore_notice,
) -> FrameSource:
    """Open a recording of any kind; its reader is imported only then.

    ``registered`` tells whether depth is registered to colour in an .oni file that does not say so. With
    ``leave_out_damaged`` missing or damaged images are counted and reported instead of raising a fault.
    ``data_folder`` has stored calibrations, for recordings without intrinsics.
    """
    if not path.exists():
        raise RecordingMissing(path)
    source: FrameSource
    if path.is_dir():
        from carpus.core.capture.files.tum import TumFolder

        source = TumFolder(path, requires_depth=need_depth, skip_damaged=leave_out_damaged, notice=notice)
    elif path.suffix.lower() == ".oni":
        from carpus.core.capture.files.oni_source import OniSource

        source = OniSource(path, registered=registered, notice=notice)
    elif path.suffix.lower() == REALSENSE_SUFFIX:
        from carpus.core.capture.files.realsense_recording import RealSenseRecording

        source = RealSenseRecording(path)
    else:
        from carpus.core.capture.files.raw import RawRecording, is_raw_recording

        if not is_raw_recording(path):
            raise RecordingUnreadable(path, phrase("not in a recording format that Carpus can read"))
        source = RawRecording(path, notice=notice)
    if data_folder is None:
        return source
    from carpus.core.capture.calibrated_source import with_stored_calibration

    return with_stored_calibration(source, data_folder)


def open_named_camera(settings: Settings, notice: NoticeHandler, uri: str | None = None) -> FrameSource:
    """Open a live camera, that of the settings without ``uri``, with the name it was given."""
    from carpus.core.capture.calibrated_source import with_given_name
    from carpus.core.capture.devices.cameras import open_camera

    address = settings.camera.uri if uri is None else uri
    return with_given_name(open_camera(address, notice=notice), settings.data_folder)


_INTRINSICS = {"default": "the usual values of the Xtion", "driver": "the driver's field of view"}


def warn_assumed_intrinsics(source: FrameSource, path: Path, notice: NoticeHandler) -> None:
    """Notify that the intrinsics of a recording were not measured."""
    origin = source.info.camera.origin
    if origin in _INTRINSICS:
        notice(IntrinsicsAssumed(path, _INTRINSICS[origin]))


CLICKS_FILE = "calibration.json"
"""Clicks of a recording folder; those of ``NAME.oni`` are in ``NAME.calibration.json`` beside it."""
SESSION_SUFFIX = ".h5"


@dataclass(frozen=True, slots=True)
class TrackingInput:
    """One recording or session to track.

    ``clicks`` is None for a session; ``session`` is the file to write, and ``name`` its relative path for tables.
    Subject, exercise and ``facts``, the further columns of the tables, are those of a study's list.
    """

    recording: Path
    clicks: Path | None
    session: Path
    name: str
    subject_id: str = ""
    exercise: str = ""
    facts: tuple[str, ...] = ()


def is_recording(path: Path) -> bool:
    """Tell one recording or session from a folder of many."""
    if path.is_dir():
        return (path / COLOR_LIST).exists()
    return path.suffix.lower() in (*FILE_SUFFIXES, SESSION_SUFFIX)


def is_batch(named: Sequence[Path], output: Path) -> bool:
    """Tell whether the output is a folder of sessions rather than one session."""
    if len(named) > 1 or output.is_dir():
        return True
    return output.suffix != SESSION_SUFFIX and named[0].is_dir() and not is_recording(named[0])


def find_recordings(folder: Path, excluded: Path) -> Iterator[Path]:
    """Yield the recordings below a folder, sorted by name, except those in ``excluded``.

    Sessions are results and are tracked again only if they are named.
    """
    for path in sorted(folder.iterdir()):
        if path.name.startswith(".") or (path.is_dir() and path.resolve() == excluded.resolve()):
            continue
        if is_recording(path):
            if path.suffix.lower() != SESSION_SUFFIX:
                yield path
        elif path.is_dir():
            yield from find_recordings(path, excluded)


def plan_inputs(named: Sequence[Path], output: Path) -> list[TrackingInput]:
    """List all recordings to track, each once, with their session files under ``output``.

    A path that is no folder of recordings counts as one recording; its fault is reported later.
    """
    found: dict[Path, Path] = {}
    base = Path(os.path.commonpath([path.resolve().parent for path in named]))
    for path in named:
        if path.is_dir() and not is_recording(path):
            if len(named) == 1:
                base = path.resolve()
            found |= {each.resolve(): each for each in find_recordings(path, output) if each.resolve() not in found}
        else:
            found.setdefault(path.resolve(), path)
    names = {
        real: real.relative_to(base) if real.is_dir() else real.relative_to(base).with_suffix("") for real in found
    }
    taken = Counter(names.values())
    out = []
    for real, path in found.items():
        name = names[real] if taken[names[real]] == 1 else real.relative_to(base)
        session = name.with_name(name.name + SESSION_SUFFIX)
        out.append(
            TrackingInput(path.absolute(), find_clicks_file(path.absolute()), output / session, session.as_posix())
        )
    return out


def find_clicks_file(recording: Path) -> Path | None:
    """Return the file of a recording's clicks; None for a session, which contains them."""
    if recording.is_dir():
        return recording / CLICKS_FILE
    if recording.suffix.lower() == SESSION_SUFFIX:
        return None
    return recording.with_name(f"{recording.stem}.{CLICKS_FILE}")
