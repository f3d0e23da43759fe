"""``carpus doctor``: checks this computer and names a remedy for each finding."""

from __future__ import annotations

import argparse
from datetime import UTC, datetime
from itertools import chain
from pathlib import Path

from carpus.app.command_line import add_examples, describe_camera_kinds, parse_camera_address
from carpus.app.settings import Settings, load_settings
from carpus.core.calibration.card.checks import examine_cameras
from carpus.core.capture.doctor import examine
from carpus.core.model.errors import CarpusFault
from carpus.core.model.fault_text import format_fault_line
from carpus.core.platform.version import __version__

_MARK = {"good": "ok     ", "warning": "look   ", "bad": "missing"}


def add_doctor_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus doctor --camera realsense")
    parser.add_argument(
        "--data-folder", type=Path, metavar="FOLDER", help="data folder to check (default: from the settings)"
    )
    parser.add_argument(
        "--camera",
        type=parse_camera_address,
        metavar="KIND[:WHICH]",
        help=f"camera to check: {describe_camera_kinds()} (default: the first that is plugged in)",
    )
    parser.add_argument(
        "--for-support",
        action="store_true",
        help="leave out folder names, to send the result to support. Patient data are never included",
    )


def run_doctor(arguments: argparse.Namespace) -> int:
    worst, settings = 0, Settings()
    try:
        settings = load_settings()
    except CarpusFault as fault:
        print(f"{_MARK['bad']}  Settings: {format_fault_line(fault)}")
        worst = 1
    folder = arguments.data_folder or settings.data_folder
    said = (lambda text: without_folders(text, folder)) if arguments.for_support else str
    if arguments.for_support:
        print(f"Carpus {__version__}, {datetime.now(UTC):%Y-%m-%d}")
    wanted = settings.camera.uri if arguments.camera is None else arguments.camera
    for finding in chain(examine(folder, camera_uri=wanted or None), examine_cameras(folder, datetime.now(UTC))):
        print(f"{_MARK[finding.state]}  {finding.name}: {said(finding.observation)}")
        if finding.remedy:
            print(f"         {said(finding.remedy)}")
        worst = max(worst, finding.state == "bad")
    return worst


def without_folders(text: str, data_folder: Path) -> str:
    """Replace folder names in a line of the doctor: they often contain a person's name.

    >>> without_folders("/users/ada/data/a: full", Path("/users/ada/data"))
    '(data folder)/a: full'
    """
    places = {str(data_folder): "(data folder)", str(data_folder.parent): "(its folder)", str(Path.home()): "~"}
    for place in sorted(places, key=len, reverse=True):
        if len(place) > 1:
            text = text.replace(place, places[place])
    return text
