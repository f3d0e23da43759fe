"""What the screen of the check card is told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from carpus.core.calibration.card.chart import CardCheck, Verdict
from carpus.core.types import FloatArray


@dataclass(frozen=True, slots=True)
class CameraChecks:
    """One camera: its name, number (empty where nobody knows), all its ``checks``, oldest first, with what is said of
    the newest, and how many days ago that was; ``recalibrated``: calibrated since."""

    camera: str
    serial: str
    checks: Sequence[CardCheck] = ()
    verdict: Verdict | None = None
    days: float = float("nan")
    calibrated: str = ""
    recalibrated: bool = False
    simulated: bool = False

    @property
    def newest(self) -> CardCheck | None:
        return self.checks[-1] if self.checks else None


@dataclass(frozen=True, slots=True)
class CardProgress:
    """How far a check is: ``pixel`` of the discs (6, 2), None while they are not all seen; how many ``blue`` discs are;
    ``seconds`` of steady pictures; ``moved`` the card lies elsewhere and all began again."""

    pixel: FloatArray | None
    blue: int
    seconds: float
    moved: bool = False
