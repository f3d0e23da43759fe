"""Whether the lengths and angles of a session are sure, by the checks of its camera about that time: the one place that
decides it, for list, review, report, progress and tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime, timedelta
from functools import lru_cache
from pathlib import Path

from carpus.core.cameras_folder import CAMERAS
from carpus.core.check_card.chart import CardCheck, chart_path, read_checks
from carpus.core.results.camera_said import CameraSaid, camera_said
from carpus.core.results.figures import SessionFigures
from carpus.core.session.values import Session

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


def with_trust(figures: SessionFigures, data_folder: Path | None) -> SessionFigures:
    """The same figures with what the checks say of their camera."""
    if figures.simulated:
        return figures
    camera = with_checks(figures.camera, figures.when, data_folder)
    return figures if camera == figures.camera else replace(figures, camera=camera)


def folder_with_checks(path: Path) -> Path | None:
    """The data folder, of those in which a file lies, that knows cameras."""
    return next((folder for folder in path.absolute().parents if (folder / CAMERAS).is_dir()), None)
