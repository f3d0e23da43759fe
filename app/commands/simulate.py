"""``carpus simulate``: a synthetic recording with ground truth."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Collection
from dataclasses import fields
from pathlib import Path
from typing import Literal, get_args, get_origin, get_type_hints

from carpus.app.command_line import add_examples, count_type, number_type, progress_bar
from carpus.core.model.depth_sensor import SENSORS
from carpus.core.model.hand.protocols import protocol_names
from carpus.core.model.names import describe_known_names
from carpus.core.simulation.motions import MOTIONS
from carpus.core.simulation.spec import ACCESSORIES, HABITS, NONE, RecordingSpec

whole_number = count_type(-(2**31), 2**31 - 1)


def parse_number_or_drawn(text: str) -> float | None:
    """Parse a number, or None for ``drawn``: a value drawn for each person."""
    if text == "drawn":
        return None
    try:
        return number_type()(text)
    except argparse.ArgumentTypeError as cause:
        raise argparse.ArgumentTypeError(f"{cause}, and not “drawn”") from None


_METAVARS = {
    "mm": "MM",
    "deg": "DEGREES",
    "m": "METRES",
    "px": "PIXELS",
    "hz": "HZ",
    "share": "SHARE",
    "seconds": "SECONDS",
    "habit": "HABIT+...",
    "worn": "WORN+...",
}
"""Placeholders of values by the last word of an option; N for others."""


def names_type(known: Collection[str]) -> Callable[[str], str]:
    """Return an argparse type for known names with + between."""

    def read(text: str) -> str:
        for name in filter(None, text.split("+")):
            if name not in known:
                raise argparse.ArgumentTypeError(f"Unknown name “{name}”; {describe_known_names(name, known)}")
        return text

    return read


_CHOICES = {"protocol": protocol_names(), "motion": tuple(sorted(MOTIONS)), "sensor": tuple(SENSORS)}
_TYPES: dict[str, Callable[[str], object]] = {
    "skin_glide_mm": parse_number_or_drawn,
    "cupping": parse_number_or_drawn,
    "habit": names_type((NONE, *HABITS)),
    "worn": names_type((NONE, *ACCESSORIES)),
}
"""Values that the type of their field does not tell."""

_OPTIONS = {
    "protocol": "marker set: 6 markers on the back of the hand, or 21 on the whole hand",
    "motion": "exercise that the hand does",
    "hand": "right or left hand",
    "seed": "random seed; each seed gives another patient, room and day",
    "seconds": "length of the recording",
    "fps": "frames per second",
    "speed-hz": "repetitions per second",
    "range-share": "fraction of the full range of motion",
    "repetitions": "number of repetitions, after which the hand stays still",
    "tremor-deg": "amplitude of the tremor",
    "dip": "DIP flexion follows PIP flexion (coupled), or is independent (free)",
    "hand-length-mm": "length of the hand, for example 130 for a child and 200 for a tall man",
    "skin-glide-mm": "how far the skin slides over an MCP joint flexed by 90 degrees; drawn: random",
    "cupping": "how much the ring and little metacarpals flex in a grip, 0 to 1; drawn: random",
    "habit": f"habits of the patient, joined by +: {', '.join(HABITS)}",
    "anatomy": "wide: more variation in palm shape, marker height and marker placement",
    "worn": f"what the hand wears, joined by +: {', '.join(ACCESSORIES)}",
    "pen-marks": "number of blue pen marks on the skin",
    "skin-tone": "skin tone, 0 (light) to 5 (dark)",
    "light": "light in the room; drawn: random",
    "sleeve": "sleeve of the patient; drawn: random",
    "distance-m": "distance from camera to hand",
    "yaw-deg": "rotation of the hand in the image plane",
    "tilt-deg": "tilt of the hand towards the camera",
    "tilt-heading-deg": "direction of the tilt: 0 moves a side of the hand nearer to the camera, -90 the fingertips",
    "false-blobs": "average number of false blue spots per frame",
    "hidden-share": "fraction of the time in which each marker is covered, 0 to 1",
    "dropped-share": "fraction of the frames that are missing, 0 to 1",
    "click-error-px": "error of the clicks on the markers",
    "sensor": "depth camera to simulate",
    "depth-scale-error": "largest scale error of the depth, as a fraction",
}
"""What the fields of the specification mean; they give type and default."""
_SWITCHES = {
    "pain-limited": "the hand does not reach its full range of motion",
    "object-passes": "an object passes between hand and camera",
    "leaves-picture": "the hand leaves the view and returns",
    "no-skin-offsets": "place the joint centres in the markers, as the published method assumes",
}


def add_simulate_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus simulate --output out/demo --protocol wrist6")
    defaults = {field.name: field.default for field in fields(RecordingSpec)}
    hints = get_type_hints(RecordingSpec)
    parser.add_argument(
        "--output",
        type=Path,
        required=True,
        metavar="FOLDER",
        help="new folder for the recording; an existing folder is never overwritten",
    )
    for name, words in _OPTIONS.items():
        field = name.replace("-", "_")
        default, hint = defaults[field], hints[field]
        shown = words if default is None else f"{words} (default {default})"
        choices = get_args(hint) if get_origin(hint) is Literal else _CHOICES.get(field)
        if choices is not None:
            parser.add_argument(f"--{name}", choices=choices, default=default, help=shown)
            continue
        read = _TYPES.get(field) or (number_type() if float in (hint, *get_args(hint)) else whole_number)
        metavar = _METAVARS.get(name.rpartition("-")[2], "N")
        parser.add_argument(f"--{name}", type=read, metavar=metavar, default=default, help=shown)
    for name, words in _SWITCHES.items():
        parser.add_argument(f"--{name}", action="store_true", help=words)


def build_spec(arguments: argparse.Namespace) -> RecordingSpec:
    """Build the specification of a recording from the options."""
    values = {name: getattr(arguments, name) for name in (option.replace("-", "_") for option in _OPTIONS)}
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
