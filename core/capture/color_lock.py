"""Holds exposure and white balance of a camera that does not tell what its automatics have chosen.

Automatics are switched off, then values are looked for at which the pictures look as before.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from carpus.core.capture.capture_messages import ExposureSet
from carpus.core.capture.capture_process import Outlet
from carpus.core.capture.color_hold import ColorHold, Step, seen_colors


@dataclass(frozen=True, slots=True)
class Control:
    """A value that can be set, and between which it can be; the unit is the camera's own."""

    value: float
    least: float
    most: float


class ColorControls(Protocol):
    """What a driver can set of its colour camera."""

    def follow(self, on: bool) -> tuple[bool, bool]:
        """Switch automatic exposure and white balance on or off; which of both took it."""
        ...

    def exposure(self) -> Control | None:
        """None where it cannot be set."""
        ...

    def balance(self) -> Control | None:
        """Colour temperature in kelvin; None where it cannot be set."""
        ...

    def put(self, step: Step) -> None:
        """Set both to the nearest that the camera takes."""
        ...


class ColorLock:
    """Follows the light, or holds; that a hold is done is reported to the owner of the capture process."""

    def __init__(self, outlet: Outlet, controls: ColorControls) -> None:
        self._outlet, self._controls = outlet, controls
        self._hold: ColorHold | None = None
        self._last: bytes | None = None

    def set_automatic(self, on: bool) -> bool | None:
        """Follow the light, or begin to hold, which is reported when it is done."""
        self._hold = None
        if on or self._last is None:
            return all(self._controls.follow(on))
        took, _ = self._controls.follow(False)
        exposure, balance = self._controls.exposure(), self._controls.balance()
        if not took or exposure is None:
            return False
        self._hold = ColorHold(
            seen_colors(self._last),
            exposure.value,
            (exposure.least, exposure.most),
            balance.value if balance else 0.0,
            (balance.least, balance.most) if balance else None,
        )
        return None

    def look(self, picture: Sequence[int]) -> None:
        """The bytes of one more colour picture, red first."""
        if self._hold is None:
            self._last = bytes(picture)
            return
        step = self._hold.step(seen_colors(picture))
        if step is not None:
            self._controls.put(step)
        if self._hold.is_over:
            done = self._hold.is_like_before
            self._hold = None
            self._outlet.send(ExposureSet(True, done))
