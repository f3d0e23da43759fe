"""Clicks file: JSON with hand, protocol and one pixel for each marker."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from carpus.core.calibration.result import ALL_STRAIGHT, Clicks
from carpus.core.model.errors import ClickOutsideImage, ClicksUnreadable, OutputExists, ProtocolUnknown
from carpus.core.model.hand.exercises import EXERCISES
from carpus.core.model.hand.protocols import get_protocol
from carpus.core.model.names import describe_known_names
from carpus.core.model.phrase import phrase
from carpus.core.platform.durable import open_private, write_fault

_MAX_BYTES = 1_000_000
"""Clicks take some hundred bytes; a larger file is another one, or endless."""
_MAX_PIXEL_PX = 1e9
"""Excludes NaN, infinity and integers too long for a float."""


def read_clicks(path: Path, width_px: int | None = None, height_px: int | None = None) -> Clicks:
    """Read clicks from a file; with the size of the first frame each must lie inside it.

    Raises :class:`ClicksUnreadable`, :class:`ProtocolUnknown` or :class:`ClickOutsideImage`.
    """
    content = _read_json_object(path)
    side: Any = content.get("hand")
    if side not in ("right", "left"):
        raise ClicksUnreadable(
            path, phrase("hand is {json}, but right or left is expected", json=json.dumps(side)[:40])
        )
    name = str(content.get("protocol", ""))[:40]
    try:
        protocol = get_protocol(name)
    except ProtocolUnknown as cause:
        raise ProtocolUnknown(name, f"{path}: {cause.detail}") from cause
    markers, names = content.get("markers"), protocol.markers
    if not isinstance(markers, dict):
        raise ClicksUnreadable(path, phrase("no markers"))
    for problem, some in (("no click for", set(names) - set(markers)), ("unknown marker", set(markers) - set(names))):
        if some:
            raise ClicksUnreadable(path, f"{problem} {', '.join(sorted(some))[:200]}")
    pixel = np.array([_parse_pixel(path, marker, markers[marker]) for marker in names])
    straight = content.get("straight_fingers")
    is_list = isinstance(straight, list) and len(straight) == len(ALL_STRAIGHT)
    if straight is not None and not (is_list and all(isinstance(each, bool) for each in straight)):
        raise ClicksUnreadable(
            path, phrase("straight_fingers must be five values, true or false, from thumb to little finger")
        )
    exercise, known = str(content.get("exercise", ""))[:40], [one.id for one in EXERCISES]
    if exercise and exercise not in known:
        raise ClicksUnreadable(path, f"exercise {exercise}; {describe_known_names(exercise, known)}")
    clicks = Clicks(side, protocol, pixel, tuple(straight or ()), exercise)
    if width_px is not None and height_px is not None:
        check_clicks_inside(clicks, width_px, height_px)
    return clicks


def write_clicks(path: Path, clicks: Clicks) -> None:
    """Write a clicks file; an existing one is not replaced (:class:`OutputExists`)."""
    markers = dict(zip(clicks.protocol.markers, clicks.pixel.tolist(), strict=True))
    content: dict[str, Any] = {"hand": clicks.side, "protocol": clicks.protocol.name, "markers": markers}
    if clicks.straight_fingers:
        content["straight_fingers"] = list(clicks.straight_fingers)
    if clicks.exercise:
        content["exercise"] = clicks.exercise
    text = json.dumps(content, indent=1)
    try:
        with open(path, "x", encoding="utf-8", opener=open_private) as file:
            file.write(text + "\n")
    except FileExistsError as cause:
        raise OutputExists(path) from cause
    except OSError as cause:
        raise write_fault(path, cause) from cause


def check_clicks_inside(clicks: Clicks, width_px: int, height_px: int) -> None:
    """Raise :class:`ClickOutsideImage` for the first click outside; the image begins half a pixel before 0."""
    for name, (u, v) in zip(clicks.protocol.markers, clicks.pixel.tolist(), strict=True):
        if not (-0.5 <= u < width_px - 0.5 and -0.5 <= v < height_px - 0.5):
            size = {"width_px": width_px, "height_px": height_px}
            words = phrase("{u}, {v} in a frame of {width_px} x {height_px} pixels", u=f"{u:g}", v=f"{v:g}", **size)
            raise ClickOutsideImage(name, words)


def _read_json_object(path: Path) -> dict[str, Any]:
    def to_dict(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        names = [name for name, _ in pairs]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:  # of which JSON would silently take the second
            raise ClicksUnreadable(path, phrase("{cause} appears twice", cause=twice))
        return dict(pairs)

    try:
        with path.open("rb") as file:
            data = file.read(_MAX_BYTES + 1)
        if len(data) > _MAX_BYTES:
            raise ClicksUnreadable(path, phrase("too long for a file of clicks"))
        content = json.loads(data.decode("utf-8-sig"), object_pairs_hook=to_dict)
    except FileNotFoundError as cause:
        raise ClicksUnreadable(path, phrase("file not found")) from cause
    except OSError as cause:
        raise ClicksUnreadable(path, cause.strerror or phrase("cannot be opened")) from cause
    except UnicodeDecodeError as cause:
        raise ClicksUnreadable(path, phrase("not a text file")) from cause
    except json.JSONDecodeError as cause:
        raise ClicksUnreadable(path, phrase("not JSON, line {lineno}", lineno=cause.lineno)) from cause
    except (ValueError, RecursionError) as cause:
        raise ClicksUnreadable(path, phrase("not JSON")) from cause
    if not isinstance(content, dict):
        raise ClicksUnreadable(path, phrase("not an object with hand, protocol and markers"))
    return content


def _parse_pixel(path: Path, name: str, value: Any) -> tuple[float, float]:
    def is_number(one: Any) -> bool:
        return isinstance(one, (int, float)) and not isinstance(one, bool) and abs(one) < _MAX_PIXEL_PX

    if isinstance(value, list) and len(value) == 2 and all(map(is_number, value)):
        return float(value[0]), float(value[1])
    found = json.dumps(value)[:40]
    raise ClicksUnreadable(
        path, phrase("{name} is {json}, but two pixel coordinates are expected", name=name, json=found)
    )
