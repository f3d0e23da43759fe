"""``carpus simulate``: a synthetic recording with ground truth."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Collection
from dataclasses import fields
from pathlib import Path
from typing import Any

from carpus.app.command_line import add_examples, count_type, number_type, progress_bar
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

_OPTIONS: tuple[tuple[str, dict[str, Any]], ...] = (
    (
        "protocol",
        {"choices": protocol_names(), "help": "marker set: 6 markers on the back of the hand, or 21 on the whole hand"},
    ),
    ("motion", {"choices": tuple(sorted(MOTIONS)), "help": "exercise that the hand does"}),
    ("hand", {"choices": ("right", "left"), "help": "right or left hand"}),
    ("seed", {"type": whole_number, "help": "random seed; each seed gives another patient, room and day"}),
    ("seconds", {"type": number_type(), "metavar": "SECONDS", "help": "length of the recording"}),
    ("fps", {"type": number_type(), "help": "frames per second"}),
    ("speed-hz", {"type": number_type(), "help": "repetitions per second"}),
    ("range-share", {"type": number_type(), "help": "fraction of the full range of motion"}),
    ("repetitions", {"type": whole_number, "help": "number of repetitions, after which the hand stays still"}),
    ("tremor-deg", {"type": number_type(), "help": "amplitude of the tremor"}),
    (
        "dip",
        {"choices": ("coupled", "free"), "help": "DIP flexion follows PIP flexion (coupled), or is independent (free)"},
    ),
    (
        "hand-length-mm",
        {"type": number_type(), "help": "length of the hand, for example 130 for a child and 200 for a tall man"},
    ),
    (
        "skin-glide-mm",
        {
            "type": parse_number_or_drawn,
            "help": "how far the skin slides over an MCP joint flexed by 90 degrees; drawn: random",
        },
    ),
    (
        "cupping",
        {
            "type": parse_number_or_drawn,
            "help": "how much the ring and little metacarpals flex in a grip, 0 to 1; drawn: random",
        },
    ),
    (
        "habit",
        {
            "type": names_type((NONE, *HABITS)),
            "metavar": "HABIT+...",
            "help": f"habits of the patient, joined by +: {', '.join(HABITS)}",
        },
    ),
    (
        "anatomy",
        {
            "choices": ("usual", "wide"),
            "help": "wide: more variation in palm shape, marker height and marker placement",
        },
    ),
    (
        "worn",
        {
            "type": names_type((NONE, *ACCESSORIES)),
            "metavar": "WORN+...",
            "help": f"what the hand wears, joined by +: {', '.join(ACCESSORIES)}",
        },
    ),
    ("pen-marks", {"type": whole_number, "help": "number of blue pen marks on the skin"}),
    ("skin-tone", {"type": whole_number, "help": "skin tone, 0 (light) to 5 (dark)"}),
    ("light", {"choices": ("drawn", "bright", "normal", "dim"), "help": "light in the room; drawn: random"}),
    (
        "sleeve",
        {
            "choices": ("drawn", "none", "grey", "white", "blue", "jeans"),
            "help": "sleeve of the patient; drawn: random",
        },
    ),
    ("distance-m", {"type": number_type(), "help": "distance from camera to hand"}),
    ("yaw-deg", {"type": number_type(), "help": "rotation of the hand in the image plane"}),
    ("tilt-deg", {"type": number_type(), "help": "tilt of the hand towards the camera"}),
    (
        "tilt-heading-deg",
        {
            "type": number_type(),
            "help": "direction of the tilt: 0 moves a side of the hand nearer to the camera, -90 the fingertips",
        },
    ),
    ("false-blobs", {"type": number_type(), "help": "average number of false blue spots per frame"}),
    ("hidden-share", {"type": number_type(), "help": "fraction of the time in which each marker is covered, 0 to 1"}),
    ("dropped-share", {"type": number_type(), "help": "fraction of the frames that are missing, 0 to 1"}),
    ("click-error-px", {"type": number_type(), "help": "error of the clicks on the markers"}),
    ("sensor", {"choices": tuple(SENSORS), "help": "depth camera to simulate"}),
    ("depth-scale-error", {"type": number_type(), "help": "largest scale error of the depth, as a fraction"}),
)
_SWITCHES = {
    "pain-limited": "the hand does not reach its full range of motion",
    "object-passes": "an object passes between hand and camera",
    "leaves-picture": "the hand leaves the view and returns",
    "no-skin-offsets": "place the joint centres in the markers, as the published method assumes",
}


def add_simulate_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus simulate --output out/demo --protocol wrist6")
    defaults = {field.name: field.default for field in fields(RecordingSpec)}
    parser.add_argument(
        "--output",
        type=Path,
        required=True,
        metavar="FOLDER",
        help="new folder for the recording; an existing folder is never overwritten",
    )
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


def run_simulate(arguments: argparse.Namespace) -> int:
    from carpus.core.simulation.recording import simulate

    with progress_bar("rendering") as progress:
        simulate(build_spec(arguments), arguments.output, progress)
    print(f"Recording: {arguments.output}")
    return 0
