"""``carpus verify``: checks that a session or recording is complete and unchanged."""

from __future__ import annotations

import argparse
from pathlib import Path

from carpus.app.command_line import print_fault, progress_bar
from carpus.app.session_commands import find_data_folder, log_session_action
from carpus.core.model.errors import CarpusFault, DamagedFramesExcluded, RecordingDamaged, RecordingMissing
from carpus.core.session.reader import read_outline, verify

EXAMPLE = "carpus verify session.h5"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "file",
        type=Path,
        metavar="FILE",
        help="session (.h5) or recording (TUM folder, .oni, RealSense or raw); the file is not changed",
    )


def run(arguments: argparse.Namespace) -> int:
    path: Path = arguments.file
    if not path.exists():
        raise RecordingMissing(path)
    if path.suffix in {".h5", ".part"}:
        found = verify(path)
        if find_data_folder(path) is not None:
            log_session_action("opened", path, read_outline(path).header.session_id)
        if found.has_checksum:
            print(f"Complete and unchanged since it was finished: {path} ({found.frames} frames).")
        else:
            print(f"Complete: {path} ({found.frames} frames). It has no checksum, so changes cannot be detected.")
        return 0
    # decode every image; a recording has checksums of its own at most
    from carpus.app.sources import open_recording

    told: list[CarpusFault] = []
    source = open_recording(path, need_depth=False, notice=told.append)
    frames = 0
    try:
        with progress_bar("reading") as progress:
            for frame in source.frames():
                frames = frame.index + 1
                progress(frames, source.info.frame_count)
    finally:
        source.close()
    damage = [fault for fault in told if isinstance(fault, (DamagedFramesExcluded, RecordingDamaged))]
    for fault in damage:
        print_fault(fault)
    if damage:
        return 1
    if source.info.settings.get("complete", "").startswith("no"):
        print(f"Cut short, complete up to there: {path} ({frames} frames).")
    else:
        print(f"Complete: {path} ({frames} frames).")
    return 0
