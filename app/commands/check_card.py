"""``carpus check-card``: measures how far off a camera is with 30 seconds of a printed card."""

from __future__ import annotations

import argparse
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import print_fault, print_message, progress_bar, report_usage_error
from carpus.core.model.rounding import format_rounded

if TYPE_CHECKING:
    from collections.abc import Iterator

    from carpus.core.calibration.card.card import CardReading
    from carpus.core.capture.source import FrameSource
    from carpus.core.model.types import Frame

EXAMPLE = """carpus check-card --card card.pdf
carpus check-card"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
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


def run(arguments: argparse.Namespace) -> int:
    if arguments.card is not None:
        if arguments.recording is not None:
            return report_usage_error("check-card", "--card only prints; leave out the recording.")
        from carpus.core.model.errors import OutputExists

        if arguments.card.exists():
            raise OutputExists(arguments.card)
        from carpus.core.calibration.card.card import card_sheets
        from carpus.ui.report.pdf import write_sheets

        write_sheets(arguments.card, card_sheets(arguments.paper), "Carpus check card")
        print(f"Card: {arguments.card} (two pages: print at 100 % and check the rulers)")
        return 0
    return _check_camera(arguments)


def _check_camera(arguments: argparse.Namespace) -> int:
    from carpus.app.settings import load_settings
    from carpus.app.sources import open_card
    from carpus.core.calibration.card.card import verdict_sentence
    from carpus.core.calibration.card.checks import CardCheck, add_check, checks_path, read_checks
    from carpus.core.calibration.card.measure import measure_card
    from carpus.core.capture.calibrated_source import save_camera_name
    from carpus.core.model.dates import is_moment, to_iso

    settings = load_settings()
    data_folder = settings.data_folder
    source = open_card(arguments.recording, settings, print_fault)
    info = source.info
    try:
        reading = measure_card(_count_frames(source), info.camera, str(arguments.recording or info.name))
    finally:
        source.close()
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
