"""``carpus simulate``: a synthetic recording with ground truth."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Collection
from dataclasses import fields
from pathlib import Path
from typing import Any

from carpus.app.command_line import count_type, number_type, progress_bar
from carpus.core.model.depth_sensor import SENSORS
from carpus.core.model.hand.protocols import protocol_names
from carpus.core.model.names import describe_known_names
from carpus.core.simulation.motions import MOTIONS
from carpus.core.simulation.spec import ACCESSORIES, HABITS, NONE, RecordingSpec


def parse_number_or_drawn(text: str) -> float | None:
    """Parse a number, or None for ``drawn``: a value drawn for each person."""
    if text == "drawn":
        return None
    try:
        return number_type()(text)
    except argparse.ArgumentTypeError as cause:
        raise argparse.ArgumentTypeError(f"{cause}, and not “drawn”") from None


_METAVARS = {"mm": "MM", "deg": "DEGREES", "m": "METRES", "px": "PIXELS", "hz": "HZ", "share": "SHARE"}
"""Placeholders of values by the last word of an option; N for others."""


def names_type(known: Collection[str]) -> Callable[[str], str]:
    """Return an argparse type for known names with + between."""

    def read(text: str) -> str:
        for name in filter(None, text.split("+")):
            if name not in known:
                raise argparse.ArgumentTypeError(f"Unknown name “{name}”; {describe_known_names(name, known)}")
        return text

    return read


whole_number = count_type(-(2**31), 2**31 - 1)
EXAMPLE = "carpus simulate --output out/demo --protocol wrist6"

_OPTIONS: tuple[tuple[str, dict[str, Any]], ...] = (
    ("protocol", {"choices": protocol_names(), "help": "6 markers on the palm or 21 on the hand"}),
    ("motion", {"choices": tuple(sorted(MOTIONS)), "help": "the exercise"}),
    ("hand", {"choices": ("right", "left"), "help": "which hand"}),
    ("seed", {"type": whole_number, "help": "another seed is another patient, room and day"}),
    ("seconds", {"type": number_type(), "metavar": "SECONDS", "help": "how long"}),
    ("fps", {"type": number_type(), "help": "frames per second"}),
    ("speed-hz", {"type": number_type(), "help": "repetitions a second"}),
    ("range-share", {"type": number_type(), "help": "share of the exercise's full range"}),
    ("repetitions", {"type": whole_number, "help": "stop moving after so many"}),
    ("tremor-deg", {"type": number_type(), "help": "how far the hand trembles"}),
    ("dip", {"choices": ("coupled", "free"), "help": "DIP joints coupled to the PIP joints, or free"}),
    ("hand-length-mm", {"type": number_type(), "help": "130 a child, 200 a tall man"}),
    (
        "skin-glide-mm",
        {"type": parse_number_or_drawn, "help": "how far skin glides over a knuckle bent by 90, or drawn"},
    ),
    (
        "cupping",
        {"type": parse_number_or_drawn, "help": "how far ring and little metacarpal flex in a grip, 0 to 1, or drawn"},
    ),
    (
        "habit",
        {"type": names_type((NONE, *HABITS)), "metavar": "HABIT+...", "help": f"with + between: {', '.join(HABITS)}"},
    ),
    ("anatomy", {"choices": ("usual", "wide"), "help": "wide: other marker heights and palms, markers placed off"}),
    (
        "worn",
        {
            "type": names_type((NONE, *ACCESSORIES)),
            "metavar": "WORN+...",
            "help": f"with + between: {', '.join(ACCESSORIES)}",
        },
    ),
    ("pen-marks", {"type": whole_number, "help": "blue dots of a pen on the skin"}),
    ("skin-tone", {"type": whole_number, "help": "0 light to 5 dark"}),
    ("light", {"choices": ("drawn", "bright", "normal", "dim"), "help": "of the room"}),
    ("sleeve", {"choices": ("drawn", "none", "grey", "white", "blue", "jeans"), "help": "of the clothes"}),
    ("distance-m", {"type": number_type(), "help": "camera to hand"}),
    ("yaw-deg", {"type": number_type(), "help": "how far the hand is turned in the frame"}),
    ("tilt-deg", {"type": number_type(), "help": "how far the hand is tilted to the camera"}),
    ("tilt-heading-deg", {"type": number_type(), "help": "0: a side of the hand nearer, -90: its tips"}),
    ("false-blobs", {"type": number_type(), "help": "false blue blobs in each frame, on average"}),
    ("hidden-share", {"type": number_type(), "help": "share of the time each marker is covered"}),
    ("dropped-share", {"type": number_type(), "help": "share of the frames that is missing"}),
    ("click-error-px", {"type": number_type(), "help": "how far clicks are off their markers"}),
    ("sensor", {"choices": tuple(SENSORS), "help": "whose depth it is"}),
    ("depth-scale-error", {"type": number_type(), "help": "largest scale error of the depth"}),
)
_SWITCHES = {
    "pain-limited": "movements stop short",
    "object-passes": "something passes between hand and camera",
    "leaves-picture": "the hand leaves the view and returns",
    "no-skin-offsets": "joint centres in the markers, as the papers assume",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    defaults = {field.name: field.default for field in fields(RecordingSpec)}
    parser.add_argument("--output", type=Path, required=True, metavar="FOLDER", help="made new, never overwritten")
    for name, options in _OPTIONS:
        default = defaults[name.replace("-", "_")]
        words = options.get("help", "")
        shown = f"{words} (default {default})".strip() if default is not None else words
        told = {**options, "help": shown}
        if "choices" not in options:
            told.setdefault("metavar", _METAVARS.get(name.rpartition("-")[2], "N"))
        parser.add_argument(f"--{name}", default=default, **told)
    for name, words in _SWITCHES.items():
        parser.add_argument(f"--{name}", action="store_true", help=words)


def build_spec(arguments: argparse.Namespace) -> RecordingSpec:
    """Build the specification of a recording from the options."""
    values = {name.replace("-", "_"): getattr(arguments, name.replace("-", "_")) for name, _ in _OPTIONS}
    return RecordingSpec(
        **values,
        pain_limited=arguments.pain_limited,
        object_passes=arguments.object_passes,
        leaves_picture=arguments.leaves_picture,
        skin_offsets=not arguments.no_skin_offsets,
    )


def run(arguments: argparse.Namespace) -> int:
    from carpus.core.simulation.recording import simulate

    with progress_bar("rendering") as progress:
        simulate(build_spec(arguments), arguments.output, progress)
    print(f"Recording: {arguments.output}")
    return 0
