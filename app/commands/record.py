"""``carpus record``: records raw colour and depth from the camera."""

from __future__ import annotations

import argparse
import contextlib
import time
import uuid
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from carpus.app.command_line import (
    add_examples,
    describe_camera_kinds,
    describe_wrong_suffix,
    number_type,
    parse_camera_address,
    print_fault,
    progress_bar,
    report_usage_error,
)
from carpus.app.settings import load_settings
from carpus.app.sources import open_named_camera, open_recording
from carpus.core.capture.calibrated_source import with_stored_calibration
from carpus.core.capture.files.raw import RawWriter
from carpus.core.capture.files.tum import TumWriter
from carpus.core.capture.source import FrameSource, find_recording_date
from carpus.core.model.dates import to_iso
from carpus.core.model.errors import CarpusFault, OutputExists
from carpus.core.model.types import Frame
from carpus.core.pipeline.recording import Recorder

MAX_RECORDING_S = 86400.0
MAX_WAITING_FRAMES = 90
"""Three seconds of frames may wait for a slow disk."""


def add_record_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus record --output out/hand.carpusraw --seconds 30")
    parser.add_argument(
        "--output", type=Path, required=True, metavar="RECORDING", help="new file (raw) or folder (tum)"
    )
    parser.add_argument(
        "--seconds",
        type=number_type(0.1, MAX_RECORDING_S),
        metavar="SECONDS",
        help="stop after this time (default: when you press Ctrl+C)",
    )
    parser.add_argument(
        "--format", choices=("raw", "tum"), default="raw", help="format of the recording (default: raw)"
    )
    parser.add_argument(
        "--lossless",
        action="store_true",
        help="also store colour without loss (raw only; files are three times as large)",
    )
    parser.add_argument(
        "--from", dest="origin", type=Path, metavar="RECORDING", help="play this recording in place of the camera"
    )
    parser.add_argument(
        "--camera",
        type=parse_camera_address,
        metavar="KIND[:WHICH]",
        help=f"camera to use: {describe_camera_kinds()} (default: from the settings, or the first that is plugged in)",
    )


def run_record(arguments: argparse.Namespace) -> int:
    if arguments.lossless and arguments.format != "raw":
        return report_usage_error("record", "--lossless is for --format raw; a TUM folder is without loss already.")
    wrong = describe_wrong_suffix(arguments.output, (".carpusraw",))
    if arguments.format == "raw" and wrong:
        return report_usage_error("record", f"{wrong}.")
    if arguments.output.exists():
        raise OutputExists(arguments.output)
    if arguments.origin is not None:
        source = open_recording(arguments.origin, notice=print_fault)
    else:
        settings = load_settings()
        source = open_named_camera(settings, print_fault, arguments.camera)
        print(f"Camera: {source.info.name}")
        if arguments.format == "tum":
            # A folder of pictures cannot say which camera it came from; a raw recording can, and stays as it came.
            source = with_stored_calibration(source, settings.data_folder)

    def open_writer() -> RawWriter | TumWriter:
        if arguments.format == "raw":
            return RawWriter(arguments.output, said, lossless=arguments.lossless)
        return TumWriter(arguments.output, said)

    live = arguments.origin is None
    when = find_recording_date(source.info, float("nan"), arguments.origin)
    said = replace(source.info, recorded=when.time if when else "")
    if live:
        said = replace(source.info, recorded=to_iso(datetime.now().astimezone()), recording_id=str(uuid.uuid4()))

    # The disk has a thread of its own: a slow moment of it must not hold up the camera.
    # Its fault is raised when the recording is finished.
    recorder: Recorder[RawWriter | TumWriter, Frame] = Recorder(
        "pictures", open_writer, lambda writer, frame: writer.append_frame(frame), MAX_WAITING_FRAMES, lambda _: None
    )
    total = None if arguments.seconds is None else max(1, round(arguments.seconds * source.info.nominal_fps))
    try:
        recorder.start()
        count, missed = _record_frames(source, recorder, total, live=live)
    finally:
        source.close()
        try:
            recorder.finish()
        except CarpusFault:
            if recorder.write_count and arguments.output.exists():
                print(f"Cut short: {arguments.output}; what was recorded before can be read.")
            raise
    print(f"Recording: {arguments.output}\nFrames: {count}, missing {missed}")
    return 0


def _record_frames(
    source: FrameSource, recorder: Recorder[RawWriter | TumWriter, Frame], total: int | None, *, live: bool
) -> tuple[int, int]:
    """Record until the source ends, ``total`` is reached or Ctrl+C; return frames and missing frames."""
    count, missed = 0, 0
    with progress_bar("recording") as show, contextlib.suppress(KeyboardInterrupt):
        for frame in source.frames():
            while not live and recorder.queue_length >= MAX_WAITING_FRAMES - 1 and recorder.fault is None:
                time.sleep(0.002)  # a file can wait for the disk
            if recorder.fault is not None:
                break
            recorder.submit(frame)
            count, missed = count + 1, missed + frame.dropped_before
            show(count, total)
            if total is not None and count >= total:
                break
    return count, missed
