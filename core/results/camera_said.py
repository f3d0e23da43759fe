"""What a session says of the camera it was measured with, and whether its lengths and angles are sure by the checks of
that camera about that time: the one place that decides it, for list, review, report, progress and tables."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from functools import lru_cache
from pathlib import Path

from carpus.core.calibration.card.chart import CardCheck, chart_path, read_checks
from carpus.core.dates import is_moment
from carpus.core.names import CAMERAS
from carpus.core.provenance import said_in
from carpus.core.session.values import Session


@dataclass(frozen=True, slots=True)
class CameraSaid:
    """``serial`` number, empty where nobody knows which camera it was; ``calibrated`` when with a board (ISO 8601),
    empty for not; ``age_days`` how old the calibration was when the hand moved, NaN without one. Not in the file but of
    the camera's checks: whether ``lengths`` or ``angles`` are not sure, since a check near the session was out."""

    serial: str = ""
    calibrated: str = ""
    age_days: float = math.nan
    lengths_not_sure: bool = False
    angles_not_sure: bool = False

    @property
    def not_sure(self) -> str:
        """``lengths``, ``angles`` or ``lengths, angles``, as tables say it; empty where nothing speaks against it."""
        said = (("lengths", self.lengths_not_sure), ("angles", self.angles_not_sure))
        return ", ".join(name for name, is_so in said if is_so)


UNKNOWN_CAMERA = CameraSaid()


def camera_said(parameters: str) -> CameraSaid:
    """What the parameters of a session say.

    >>> said = '{"source": {"serial": "77", "calibrated": "2026-11-20T09:00+00:00", "calibration_age_days": "5"}}'
    >>> camera_said(said) == CameraSaid("77", "2026-11-20T09:00+00:00", 5.0)
    True
    """
    source = said_in(parameters, "source")
    calibrated = str(source.get("calibrated") or "")
    try:
        age_days = float(str(source.get("calibration_age_days")))
    except ValueError:
        age_days = math.nan
    serial = str(source.get("serial") or "")
    return CameraSaid(serial, calibrated, age_days) if is_moment(calibrated) else CameraSaid(serial)


CHECKED_AGAIN = timedelta(hours=1)
"""A check that is followed by another so soon was checked once more, as the program asks: the later one stands,
unless it says the same. What was out twice was out, also where a third check was right."""


def unsure_of(checks: Sequence[CardCheck], recorded: datetime, calibrated: str) -> tuple[bool, bool]:
    """Whether lengths and angles of a session are not sure: the first check after it, with the same calibration, or the
    last one before it was out of its limits. ``checks`` in order of time."""
    alike = _standing([one for one in checks if one.calibrated == calibrated])
    before = [one for one in alike if datetime.fromisoformat(one.when) <= recorded][-1:]
    after = [one for one in alike if datetime.fromisoformat(one.when) > recorded][:1]
    near = [*before, *after]
    return any(not one.lengths_hold for one in near), any(not one.angles_hold for one in near)


def _standing(checks: Sequence[CardCheck]) -> list[CardCheck]:
    """Those that were not checked once more with another result."""
    when = [datetime.fromisoformat(one.when) for one in checks]
    holds = [(one.lengths_hold, one.angles_hold) for one in checks]
    last = len(checks) - 1
    return [
        one
        for k, one in enumerate(checks)
        if k == last or when[k + 1] - when[k] > CHECKED_AGAIN or holds[k + 1] == holds[k]
    ]


def with_checks(camera: CameraSaid, when: datetime, data_folder: Path | None) -> CameraSaid:
    """The same with what the checks in a data folder say of a session of that time; of nobody's camera nothing."""
    if data_folder is None or not camera.serial:
        return camera
    checks = [one for one in _known_checks(chart_path(data_folder, camera.serial)) if one.serial == camera.serial]
    lengths, angles = unsure_of(checks, when, camera.calibrated)
    return replace(camera, lengths_not_sure=lengths, angles_not_sure=angles)


def _known_checks(path: Path) -> tuple[CardCheck, ...]:
    """Read once as long as the file stays: a list asks for each of its sessions."""
    try:
        now = path.stat()
    except OSError:
        return ()
    return _read_once(path, now.st_mtime_ns, now.st_size)


@lru_cache(maxsize=8)
def _read_once(path: Path, changed_ns: int, size: int) -> tuple[CardCheck, ...]:
    return tuple(read_checks(path))


def camera_of(session: Session, data_folder: Path | None = None) -> CameraSaid:
    """What is known of the camera of a stored session: what its file says, and the checks of the data folder, without
    one of that in which the file lies. A simulated session has no camera that could be out."""
    header = session.header
    said = camera_said(header.parameters)
    if header.simulated:
        return said
    return with_checks(said, header.when, data_folder or folder_with_checks(session.path))


def folder_with_checks(path: Path) -> Path | None:
    """The data folder, of those in which a file lies, that knows cameras."""
    return next((folder for folder in path.absolute().parents if (folder / CAMERAS).is_dir()), None)
