"""``carpus record``: raw colour and depth from the camera to disk."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import Protocol

from app.commands.progress import bar
from core.errors import CarpusFault, OutputExists
from core.types import Frame
from core.words import one_sentence

NAME = "record"
HELP = "Record raw colour and depth from the camera."


class _Writer(Protocol):
    def append_frame(self, frame: Frame) -> None: ...
    def close(self) -> None: ...
    def abandon(self) -> None: ...
    def discard(self) -> None: ...


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--output", type=Path, required=True, metavar="RECORDING", help="file (raw) or folder (tum)")
    parser.add_argument("--seconds", type=float, metavar="N", help="stop after this long; else with Ctrl+C")
    parser.add_argument("--format", choices=("raw", "tum"), default="raw")
    parser.add_argument(
        "--lossless", action="store_true", help="colour without loss too (raw only; three times the size)"
    )
    parser.add_argument(
        "--from", dest="origin", type=Path, metavar="FILE.oni", help="play this file as if it were the camera"
    )


def run(arguments: argparse.Namespace) -> int:
    from core.capture.raw import RawWriter
    from core.capture.raw_tum import TumWriter

    if arguments.output.exists():
        raise OutputExists(arguments.output)
    notice = _tell
    if arguments.origin is not None:
        from app.sources import open_recording

        source = open_recording(arguments.origin, notice=notice)
    else:
        from core.capture.xtion import XtionSource

        source = XtionSource(notice=notice)
    count, missed = 0, 0
    try:
        writer: _Writer
        if arguments.format == "raw":
            writer = RawWriter(arguments.output, source.info, lossless=arguments.lossless)
        else:
            writer = TumWriter(arguments.output, source.info)
        begun = time.monotonic()
        total = None if arguments.seconds is None else int(arguments.seconds * source.info.nominal_fps)
        try:
            with bar("recording") as show:
                for frame in source.frames():
                    writer.append_frame(frame)
                    count, missed = count + 1, missed + frame.dropped_before
                    show(count, total)
                    if total is not None and (count >= total or time.monotonic() - begun > 2 * arguments.seconds + 5):
                        break
        except KeyboardInterrupt:
            pass
        except BaseException:
            writer.abandon() if count else writer.discard()
            raise
        writer.close() if count else writer.discard()
    finally:
        source.close()
    print(f"Recording: {arguments.output}\nFrames: {count}, missing {missed}")
    return 0


def _tell(fault: CarpusFault) -> None:
    print(f"carpus: {one_sentence(fault)}", file=sys.stderr)
