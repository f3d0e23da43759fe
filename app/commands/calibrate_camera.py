"""``carpus calibrate-camera``: prints the calibration board, and calibrates a camera with it."""

from __future__ import annotations

import argparse
import sys
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import (
    number_type,
    output_type,
    print_fault,
    print_message,
    progress_bar,
    report_usage_error,
)

if TYPE_CHECKING:
    from carpus.core.calibration.camera.board import ViewCollector
    from carpus.core.capture.source import FrameSource

EXAMPLE = """carpus calibrate-camera --board board.pdf
carpus calibrate-camera"""
SQUARES_MM = (5.0, 200.0)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "recording",
        type=Path,
        nargs="?",
        metavar="RECORDING",
        help="recording of the board in many positions (TUM folder, raw or .oni) (default: the live camera)",
    )
    parser.add_argument("--board", type=Path, metavar="BOARD.pdf", help="only write the board to print to this file")
    parser.add_argument("--paper", choices=("a4", "letter"), default="a4", help="paper size of the printed board")
    parser.add_argument(
        "--square-mm",
        type=number_type(*SQUARES_MM, "mm"),
        metavar="MM",
        help="measured side of a square, if the board was not printed at 100 %%",
    )
    parser.add_argument(
        "--output",
        type=output_type(".yaml", ".yml"),
        metavar="CAMERA.yaml",
        help="also write the camera file to this file",
    )
    parser.add_argument(
        "--serial", metavar="SERIAL", help="serial number of the camera, if the recording does not contain it"
    )


def run(arguments: argparse.Namespace) -> int:
    if arguments.board is not None:
        if arguments.recording is not None or arguments.output is not None:
            return report_usage_error("calibrate-camera", "--board only prints; leave out the recording and --output.")
        from carpus.core.calibration.camera.board import CHESSBOARD, create_board_sheet
        from carpus.core.model.errors import OutputExists

        if arguments.board.exists():
            raise OutputExists(arguments.board)
        from carpus.ui.report.pdf import write_sheets

        write_sheets(arguments.board, [create_board_sheet(CHESSBOARD, arguments.paper)], "Carpus camera board")
        print(f"Board: {arguments.board} ({CHESSBOARD.name()})")
        print("Print it at 100 %, check its ruler (100 mm), and glue it flat onto something stiff.")
        return 0
    return _calibrate(arguments)


def _calibrate(arguments: argparse.Namespace) -> int:
    from carpus.app.settings import load_settings
    from carpus.app.sources import open_board
    from carpus.core.calibration.camera.board import CHESSBOARD, ViewCollector
    from carpus.core.calibration.camera.calibrate import (
        calibrate_camera,
        format_calibration,
        save_calibration,
        to_stored_calibration,
        write_calibration,
    )
    from carpus.core.capture.calibrated_source import save_camera_name
    from carpus.core.model.dates import is_moment
    from carpus.core.model.errors import OutputExists

    if arguments.output is not None and arguments.output.exists():
        raise OutputExists(arguments.output)
    source = open_board(arguments.recording, print_fault)
    square_m = CHESSBOARD.square_m if arguments.square_mm is None else 1e-3 * arguments.square_mm
    gathering = ViewCollector(source.info.camera, replace(CHESSBOARD, square_m=square_m))
    try:
        _collect_views(source, gathering, is_live=arguments.recording is None)
    finally:
        source.close()
    info = source.info
    subject = str(arguments.recording or info.name)
    made = calibrate_camera(gathering.views, info.camera, subject)
    for line in format_calibration(made):
        print(line)
    if made.depth is not None and not made.depth.is_registered:
        print_message("Warning: depth and colour are misaligned. Turn on depth registration in the camera.")
    when = datetime.fromisoformat(info.recorded) if is_moment(info.recorded) else datetime.now().astimezone()
    serial = arguments.serial or info.serial
    stored = to_stored_calibration(made, serial, when, info.settings)
    if arguments.output is not None:
        print(f"Written: {write_calibration(arguments.output, made, stored)}")
    if serial:
        folder = load_settings().data_folder
        if arguments.recording is None and arguments.serial and info.is_nameless:
            serial = save_camera_name(folder, info.name, serial)
            stored = replace(stored, serial=serial)
        path = save_calibration(folder, made, stored)
        print(f"Saved for camera {serial}: {path}")
    elif arguments.output is None:
        print_message("The camera is unknown, so the calibration is not saved. Name it with --serial, or use --output.")
        return 1
    return 0


def _collect_views(source: FrameSource, gathering: ViewCollector, *, is_live: bool) -> None:
    """Collect views of the board: all of a recording, or of a camera until there are enough or Ctrl+C."""
    said = ""
    if is_live:
        print("Hold the board in view, still for a moment in each place. Ctrl+C stops.", file=sys.stderr)
    with progress_bar("looking for the board") as show, suppress(KeyboardInterrupt):
        for count, frame in enumerate(source.frames(), start=1):
            kept = gathering.add(frame)
            show(count, source.info.frame_count)
            if not is_live or not kept:
                continue
            judgement = gathering.coverage
            step = judgement.next_instruction()
            if step is None:
                break
            if step != said:
                said = step
                print(
                    f"{judgement.view_count} images, {judgement.field_count} of 24 fields. {said}.",
                    file=sys.stderr,
                )
