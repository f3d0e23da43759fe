"""``carpus info`` and ``carpus verify``: one recording or session, what it holds and whether it is whole."""

from __future__ import annotations

import argparse
from contextlib import closing
from pathlib import Path

from carpus.app.command_line import add_examples, print_fault, progress_bar
from carpus.app.session_commands import find_data_folder, log_session_action, read_choices
from carpus.app.sources import open_recording
from carpus.core.model.errors import CarpusFault, DamagedFramesExcluded, RecordingDamaged, RecordingMissing
from carpus.core.session.reader import read_outline, read_session, verify


def add_info_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus info session.h5")
    parser.add_argument(
        "file", type=Path, metavar="FILE", help="session (.h5) or recording (TUM folder, .oni, RealSense or raw)"
    )
    parser.add_argument("--json", action="store_true", help="print only the settings of a session, as JSON")


def run_info(arguments: argparse.Namespace) -> int:
    from carpus.core.capture.files.tum import TumFolder
    from carpus.core.results.session_summary import recording_summary, session_summary, source_summary

    path: Path = arguments.file
    if not path.exists():
        raise RecordingMissing(path)
    if path.suffix in {".h5", ".part"}:
        session = read_session(path)
        log_session_action("opened", path, session.header.session_id)
        lines = [session.header.parameters] if arguments.json else session_summary(session, read_choices(path))
    else:
        with closing(open_recording(path, need_depth=False, leave_out_damaged=True, notice=print_fault)) as source:
            if isinstance(source, TumFolder):
                lines = recording_summary(path, source)
            else:
                lines = source_summary(path, source.info)
    print("\n".join(lines))
    return 0


def add_verify_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus verify session.h5")
    parser.add_argument(
        "file",
        type=Path,
        metavar="FILE",
        help="session (.h5) or recording (TUM folder, .oni, RealSense or raw); the file is not changed",
    )


def run_verify(arguments: argparse.Namespace) -> int:
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
    told: list[CarpusFault] = []
    frames = 0
    with closing(open_recording(path, need_depth=False, notice=told.append)) as source, progress_bar("reading") as show:
        for frame in source.frames():
            frames = frame.index + 1
            show(frames, source.info.frame_count)
    damage = [fault for fault in told if isinstance(fault, (DamagedFramesExcluded, RecordingDamaged))]
    for fault in damage:
        print_fault(fault)
    if damage:
        return 1
    is_cut = source.info.settings.get("complete", "").startswith("no")
    print(f"{'Cut short, complete up to there' if is_cut else 'Complete'}: {path} ({frames} frames).")
    return 0
