"""``carpus calibrate-camera`` and ``carpus check-card``: a camera before a printed board or card."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from contextlib import closing, suppress
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import (
    add_examples,
    number_type,
    output_type,
    print_fault,
    print_message,
    progress_bar,
    report_usage_error,
)
from carpus.core.model.rounding import format_rounded

if TYPE_CHECKING:
    from carpus.core.calibration.camera.board import ViewCollector
    from carpus.core.calibration.card.card import CardReading
    from carpus.core.capture.source import FrameSource
    from carpus.core.model.types import Frame

SQUARES_MM = (5.0, 200.0)


def add_calibrate_camera_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus calibrate-camera --board board.pdf", "carpus calibrate-camera")
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


def run_calibrate_camera(arguments: argparse.Namespace) -> int:
    if arguments.board is not None:
        if arguments.recording is not None or arguments.output is not None:
            return report_usage_error("calibrate-camera", "--board only prints; leave out the recording and --output.")
        from carpus.core.calibration.camera.board import CHESSBOARD, create_board_sheet
        from carpus.ui.report.sheet import write_sheets

        write_sheets(arguments.board, [create_board_sheet(CHESSBOARD, arguments.paper)], "Carpus camera board")
        print(f"Board: {arguments.board} ({CHESSBOARD.name()})")
        print("Print it at 100 %, check its ruler (100 mm), and glue it flat onto something stiff.")
        return 0
    return _calibrate(arguments)


def _calibrate(arguments: argparse.Namespace) -> int:
    from carpus.app.settings import load_settings
    from carpus.app.sources import open_named_camera, open_recording
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
    square_m = CHESSBOARD.square_m if arguments.square_mm is None else 1e-3 * arguments.square_mm
    if arguments.recording is None:
        source = open_named_camera(load_settings(), print_fault)
    else:
        source = open_recording(arguments.recording, need_depth=False, leave_out_damaged=True, notice=print_fault)
    with closing(source):
        info = source.info
        gathering = ViewCollector(info.camera, replace(CHESSBOARD, square_m=square_m))
        _collect_views(source, gathering, is_live=arguments.recording is None)
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


def add_check_card_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus check-card --card card.pdf", "carpus check-card")
    parser.add_argument(
        "recording",
        type=Path,
        nargs="?",
        metavar="RECORDING",
        help="recording of the card lying still (TUM folder, raw or .oni) (default: the live camera)",
    )
    parser.add_argument("--card", type=Path, metavar="CARD.pdf", help="only write the card to print to this file")
    parser.add_argument("--paper", choices=("a4", "letter"), default="a4", help="paper size of the printed card")
    parser.add_argument(
        "--serial", metavar="SERIAL", help="serial number of the camera, if the recording does not contain it"
    )


def run_check_card(arguments: argparse.Namespace) -> int:
    if arguments.card is not None:
        if arguments.recording is not None:
            return report_usage_error("check-card", "--card only prints; leave out the recording.")
        from carpus.core.calibration.card.card import card_sheets
        from carpus.ui.report.sheet import write_sheets

        write_sheets(arguments.card, card_sheets(arguments.paper), "Carpus check card")
        print(f"Card: {arguments.card} (two pages: print at 100 % and check the rulers)")
        return 0
    return _check_camera(arguments)


def _check_camera(arguments: argparse.Namespace) -> int:
    from carpus.app.settings import load_settings
    from carpus.app.sources import open_named_camera, open_recording
    from carpus.core.calibration.card.card import verdict_sentence
    from carpus.core.calibration.card.checks import CardCheck, add_check, checks_path, read_checks
    from carpus.core.calibration.card.measure import measure_card
    from carpus.core.capture.calibrated_source import save_camera_name, with_stored_calibration
    from carpus.core.model.dates import is_moment, to_iso

    settings = load_settings()
    data_folder = settings.data_folder
    if arguments.recording is None:
        source = with_stored_calibration(open_named_camera(settings, print_fault), data_folder)
    else:
        source = open_recording(
            arguments.recording, leave_out_damaged=True, notice=print_fault, data_folder=data_folder
        )
    with closing(source):
        info = source.info
        reading = measure_card(_count_frames(source), info.camera, str(arguments.recording or info.name))
    when = info.recorded if is_moment(info.recorded) else to_iso(datetime.now().astimezone())
    serial = arguments.serial or info.serial
    if arguments.recording is None and arguments.serial and info.is_nameless:
        serial = save_camera_name(data_folder, info.name, serial)
    path = checks_path(data_folder, serial)
    _print_figures(reading)
    print(verdict_sentence(reading))
    if not reading.is_within_tolerance:
        print_message(
            "warning: check once more (card flat, 60 cm, its ruler 100 mm), then calibrate the camera; still "
            "out: do not measure with it."
        )
    if serial and any(one.checked_at == when for one in read_checks(path)):
        print(f"Already saved for camera {serial}: {path}")
    elif serial:
        add_check(path, CardCheck(when, serial, reading, info.settings.get("calibrated", "")))
        print(f"Saved for camera {serial}: {path}")
    else:
        print_message("the camera is unknown, so the check is not saved; name it with --serial.")
    return 0 if reading.is_within_tolerance else 1


def _print_figures(reading: CardReading) -> None:
    from carpus.core.calibration.card.card import DIMENSIONS

    for figure, measured, sd, off in zip(DIMENSIONS, reading.measured, reading.sd, reading.errors, strict=True):
        unit = "°" if figure.kind == "angle" else " mm"
        print(f"{figure.name:<20} {measured:7.2f} ± {format_rounded(sd, 2)}{unit}, off by {off:+.2f}{unit}")
    share = 100.0 * (reading.scale - 1.0)
    print(
        f"{'All distances':<20} {share:+.2f} %; {reading.frames_used} frames, "
        f"{format_rounded(reading.distance_m * 100)} cm away"
    )


def _count_frames(source: FrameSource) -> Iterator[Frame]:
    """Yield the frames under a progress bar."""
    with progress_bar("looking at the card") as show:
        for count, frame in enumerate(source.frames(), start=1):
            show(count, source.info.frame_count)
            yield frame
