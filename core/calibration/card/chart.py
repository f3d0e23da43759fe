"""The checks of one camera over time, and whether the newest is as usual: a control chart in a file that only grows."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Literal

import numpy as np

from carpus.core.calibration.card.card import (
    MOST_ANGLE_DEG,
    MOST_LENGTH_MM,
    MOST_SCALE,
    CardReading,
    within_angles,
    within_lengths,
)
from carpus.core.dates import is_moment
from carpus.core.durable import private
from carpus.core.errors import OutputNotWritable
from carpus.core.names import CAMERAS, file_stem
from carpus.core.phrase import Phrase, phrase

SUFFIX = ".checks.jsonl"
USUAL_OF = 7
"""The first checks after a calibration say what is usual."""
FEWEST_USUAL = 4
"""With fewer nobody knows what is usual."""
_BAND_SD, _LEAST_SD = 3.0, (0.1, 0.1, 0.0005)
"""Width of the usual band, and the least standard deviation believed (degrees, millimetres, share)."""
IN_A_ROW = 8
"""As many on one side of the usual mean are a drift."""
OLD_DAYS = 7.0

Verdict = Literal["right", "unusual", "out"]


@dataclass(frozen=True, slots=True)
class CardCheck:
    """One line of the file. ``calibrated`` names the calibration that was used, empty without one; ``most_angle_deg``
    and ``most_length_mm`` the limits of its camera's sensor."""

    when: str
    serial: str
    angle_error_deg: float
    length_error_mm: float
    scale: float
    measured: tuple[float, ...]
    sd: tuple[float, ...]
    calibrated: str = ""
    most_angle_deg: float = MOST_ANGLE_DEG
    most_length_mm: float = MOST_LENGTH_MM

    @property
    def values(self) -> tuple[float, float, float]:
        """What is followed: largest errors of angles and lengths, and the scale."""
        return (self.angle_error_deg, self.length_error_mm, self.scale)

    @property
    def angles_hold(self) -> bool:
        return within_angles(self.angle_error_deg, self.most_angle_deg)

    @property
    def lengths_hold(self) -> bool:
        return within_lengths(self.length_error_mm, self.scale, self.most_length_mm)


@dataclass(frozen=True, slots=True)
class Usual:
    """Lowest and highest usual value of each followed figure (3, 2), and their means (3,)."""

    band: np.ndarray
    mean: np.ndarray


def check_of(reading: CardReading, serial: str, when: str, calibrated: str) -> CardCheck:
    """A reading as it is kept."""
    return CardCheck(
        when,
        serial,
        reading.angle_error_deg,
        reading.length_error_mm,
        reading.scale,
        tuple(map(float, reading.measured)),
        tuple(map(float, reading.sd)),
        calibrated,
        reading.most_angle_deg,
        reading.most_length_mm,
    )


def chart_path(data_folder: Path, serial: str) -> Path:
    """Where the checks of a camera are."""
    return data_folder / CAMERAS / f"{file_stem(serial)}{SUFFIX}"


def read_checks(path: Path) -> list[CardCheck]:
    """All checks in order of time; a torn or strange line is passed over, as the others are still true."""
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return []
    found = [check for line in lines if (check := _check(line)) is not None]
    return sorted(found, key=lambda check: datetime.fromisoformat(check.when))


def before(checks: Sequence[CardCheck], check: CardCheck) -> list[CardCheck]:
    """Those made before another one."""
    moment = datetime.fromisoformat(check.when)
    return [one for one in checks if datetime.fromisoformat(one.when) < moment]


def add_check(path: Path, check: CardCheck) -> None:
    """Append one check and bring it to the disk. Raises :class:`OutputNotWritable`."""
    content = {name: getattr(check, name) for name in CardCheck.__dataclass_fields__}
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with open(path, "ab", opener=private) as file:
            torn = file.tell() > 0 and not _ends_a_line(path)
            file.write(("\n" if torn else "").encode() + json.dumps(content).encode() + b"\n")
            file.flush()
            os.fsync(file.fileno())
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


def usual_of(earlier: Sequence[CardCheck], calibrated: str) -> Usual | None:
    """What is usual with this calibration, of its first checks within the limits; None while too few are known."""
    good = [one.values for one in earlier if one.calibrated == calibrated and one.angles_hold and one.lengths_hold]
    if len(good) < FEWEST_USUAL:
        return None
    first = np.array(good[:USUAL_OF])
    mean = first.mean(axis=0)
    reach = _BAND_SD * np.maximum(first.std(axis=0, ddof=1), _LEAST_SD)
    return Usual(np.column_stack((mean - reach, mean + reach)), mean)


def verdict_of(earlier: Sequence[CardCheck], check: CardCheck) -> Verdict:
    """Out of the fixed limits, outside what is usual or drifting, or right. An error smaller than usual is no fault."""
    if not (check.angles_hold and check.lengths_hold):
        return "out"
    usual = usual_of(earlier, check.calibrated)
    if usual is None:
        return "right"
    values = np.array(check.values)
    if (values > usual.band[:, 1]).any() or values[2] < usual.band[2, 0]:
        return "unusual"
    alike = [one for one in earlier if one.calibrated == check.calibrated][USUAL_OF:]
    row = np.array([one.values for one in [*alike, check]][-IN_A_ROW:])
    above, below = row > usual.mean, row < usual.mean
    drifts = len(row) == IN_A_ROW and bool(above.all(axis=0).any() or below[:, 2].all())
    return "unusual" if drifts else "right"


def sentence_of(check: CardCheck, verdict: Verdict) -> Phrase:
    """What a check says, for people."""
    figures = {
        "angle": f"{check.angle_error_deg:.1f}",
        "length": f"{check.length_error_mm:.1f}",
        "most_angle": f"{check.most_angle_deg:.1f}",
        "most_length": f"{check.most_length_mm:.1f}",
    }
    if verdict == "right":
        return phrase(
            "The camera measures right: {angle}° and {length} mm off at most; the limits are {most_angle}° and "
            "{most_length} mm.",
            **figures,
        )
    if verdict == "unusual":
        return phrase(
            "The camera measures otherwise than usual: {angle}° and {length} mm off at most; the limits are "
            "{most_angle}° and {most_length} mm. Check once more.",
            **figures,
        )
    angles = phrase("angles are {angle}° off", angle=figures["angle"])
    share = 100.0 * (check.scale - 1.0)
    off = {"share": f"{abs(share):.1f}", "length": figures["length"]}
    lengths = phrase("all lengths are {share} % too short, the worst by {length} mm", **off)
    if share > 0:
        lengths = phrase("all lengths are {share} % too long, the worst by {length} mm", **off)
    what = angles if check.lengths_hold else lengths
    if not check.lengths_hold and not check.angles_hold:
        what = phrase("{one}; {other}", one=lengths, other=angles)
    return phrase(
        "The camera is out: {what} (the limits are {most_angle}° and {most_length} mm, all lengths {most_share} %).",
        what=what,
        most_angle=figures["most_angle"],
        most_length=figures["most_length"],
        most_share=f"{100.0 * MOST_SCALE:.1f}",
    )


def _check(line: str) -> CardCheck | None:
    try:
        content = json.loads(line)
        angle, length, scale = (float(content[name]) for name in ("angle_error_deg", "length_error_mm", "scale"))
        measured, sd = (tuple(map(float, content[name])) for name in ("measured", "sd"))
        when, serial, calibrated = (str(content[name]) for name in ("when", "serial", "calibrated"))
        most = (content.get("most_angle_deg", MOST_ANGLE_DEG), content.get("most_length_mm", MOST_LENGTH_MM))
        most_angle_deg, most_length_mm = map(float, most)
    except (ValueError, KeyError, TypeError, OverflowError, RecursionError):
        return None
    if not is_moment(when) or not all(map(math.isfinite, (angle, length, scale, most_angle_deg, most_length_mm))):
        return None
    return CardCheck(when, serial, angle, length, scale, measured, sd, calibrated, most_angle_deg, most_length_mm)


def _ends_a_line(path: Path) -> bool:
    with path.open("rb") as file:
        file.seek(-1, os.SEEK_END)
        return file.read(1) == b"\n"
