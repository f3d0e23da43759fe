"""``carpus simulate``: a synthetic patient before a synthetic camera, with the truth beside it."""

from __future__ import annotations

import argparse
from dataclasses import fields
from pathlib import Path
from typing import Any

from carpus.app.commands.progress import bar
from carpus.core.depth_sensor import SENSORS
from carpus.core.hand.protocols import protocol_names
from carpus.core.simulation.motions import MOTIONS
from carpus.core.simulation.spec import HABITS, WORN, RecordingSpec


def number_or_drawn(text: str) -> float | None:
    """A number, or None for ``drawn``: each person's own."""
    try:
        return None if text == "drawn" else float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"a number or drawn, not {text}") from None


_OPTIONS: tuple[tuple[str, dict[str, Any]], ...] = (
    ("protocol", {"choices": protocol_names(), "help": "6 discs on the palm or 21 on the hand"}),
    ("motion", {"choices": tuple(sorted(MOTIONS)), "help": "the exercise"}),
    ("hand", {"choices": ("right", "left")}),
    ("seed", {"type": int, "help": "another seed is another patient, room and day"}),
    ("seconds", {"type": float}),
    ("fps", {"type": float, "help": "pictures a second"}),
    ("speed-hz", {"type": float, "help": "repetitions a second"}),
    ("range-share", {"type": float, "help": "share of the exercise's full range"}),
    ("repetitions", {"type": int, "help": "stop moving after so many"}),
    ("tremor-deg", {"type": float}),
    ("dip", {"choices": ("coupled", "free"), "help": "end joints bound to the middle joints, or free"}),
    ("hand-length-mm", {"type": float, "help": "130 a child, 200 a tall man"}),
    ("skin-glide-mm", {"type": number_or_drawn, "help": "how far skin glides over a knuckle bent by 90, or drawn"}),
    (
        "cupping",
        {"type": number_or_drawn, "help": "how far ring and little metacarpal flex in a grip, 0 to 1, or drawn"},
    ),
    ("habit", {"help": f"with + between: {', '.join(HABITS)}"}),
    ("anatomy", {"choices": ("usual", "wide"), "help": "wide: other disc heights, palms, discs stuck off"}),
    ("worn", {"help": f"with + between: {', '.join(WORN)}"}),
    ("pen-marks", {"type": int, "help": "blue dots of a pen on the skin"}),
    ("skin-tone", {"type": int, "help": "0 light to 5 dark"}),
    ("skin-movement-mm", {"type": float, "help": "how far the WRIST disc slides on the bone"}),
    ("light", {"choices": ("drawn", "bright", "normal", "dim")}),
    ("sleeve", {"choices": ("drawn", "none", "grey", "white", "blue", "jeans")}),
    ("distance-m", {"type": float, "help": "camera to hand"}),
    ("yaw-deg", {"type": float}),
    ("tilt-deg", {"type": float}),
    ("tilt-heading-deg", {"type": float, "help": "0: a side of the hand nearer, -90: its tips"}),
    ("false-blobs", {"type": float, "help": "false blue blobs in each picture, on average"}),
    ("hidden-share", {"type": float, "help": "share of the time each disc is covered"}),
    ("dropped-share", {"type": float, "help": "share of the frames that is missing"}),
    ("click-error-px", {"type": float}),
    ("sensor", {"choices": tuple(SENSORS), "help": "whose depth it is"}),
    ("depth-scale-error", {"type": float, "help": "largest scale error of the depth"}),
)
_SWITCHES = {
    "pain-limited": "strokes stop short",
    "object-passes": "something passes between hand and camera",
    "leaves-picture": "the hand leaves the picture and returns",
    "no-skin-offsets": "joint centres in the discs, as the papers assume",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    defaults = {field.name: field.default for field in fields(RecordingSpec)}
    parser.add_argument("--output", type=Path, required=True, metavar="FOLDER")
    parser.add_argument("--format", choices=("tum", "oni"), default="tum")
    for name, options in _OPTIONS:
        default = defaults[name.replace("-", "_")]
        words = options.get("help", "")
        shown = f"{words} (default {default})".strip() if default is not None else words
        parser.add_argument(f"--{name}", default=default, **{**options, "help": shown})
    for name, words in _SWITCHES.items():
        parser.add_argument(f"--{name}", action="store_true", help=words)


def spec_from(arguments: argparse.Namespace) -> RecordingSpec:
    """The recording that the options describe."""
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

    with bar("rendering") as progress:
        if arguments.format == "tum":
            simulate(spec_from(arguments), arguments.output, progress)
        else:
            from carpus.core.simulation.oni import simulate_oni

            simulate_oni(spec_from(arguments), arguments.output, progress)
    print(f"Recording: {arguments.output}")
    return 0
