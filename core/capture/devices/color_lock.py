"""Holds exposure and white balance of a camera that does not tell what its automatics have chosen.

Automatics are switched off, then values are looked for at which the pictures look as before.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from carpus.core.capture.devices.capture_child import ExposureSet, Outlet

LIGHT_SHARE = 0.9
"""Of a picture's time the longest exposure: a longer one would slow the camera down."""
EXPOSURE_UNIT_S = 1e-4
"""In which both makers count exposure."""
EVERY = 97
"""Every so-many-th pixel is looked at."""
TAKES_EFFECT = 7
"""Pictures until a change is seen for certain: some are on their way."""
NEAR, FAR = 0.02, 0.10
"""Share by which brightness, and red against blue, may differ: to be done, and to count as held at all."""
MOST_ROUNDS = 12
FIRST_STEP_K = 300.0
LARGEST_STEP = 1.0
"""Of the logarithm of the exposure in one round."""


@dataclass(frozen=True, slots=True)
class SeenColors:
    """Mean brightness (0 to 255), and the logarithm of red against blue."""

    brightness: float
    red_blue: float


@dataclass(frozen=True, slots=True)
class Step:
    """What to set next; ``kelvin`` 0 where white balance cannot be set."""

    exposure: float
    kelvin: float


def seen_colors(picture: Sequence[int]) -> SeenColors:
    """Of the bytes of an RGB picture."""
    red, green, blue = (sum(picture[channel :: 3 * EVERY]) + 1.0 for channel in range(3))
    count = len(range(0, len(picture), 3 * EVERY))
    return SeenColors((red + green + blue) / (3.0 * count), math.log(red / blue))


class ColorHold:
    """Steps towards the pictures of before. Brightness follows the exposure; how red against blue follows the colour
    temperature is learnt by a first step."""

    def __init__(
        self,
        before: SeenColors,
        exposure: float,
        exposures: tuple[float, float],
        kelvin: float,
        kelvins: tuple[float, float] | None,
    ) -> None:
        self._before = before
        self._exposure, self._exposures = _within(exposure, exposures), exposures
        self._kelvin, self._kelvins = kelvin, kelvins
        self._pictures = self._rounds = 0
        self._tried: tuple[float, float] | None = None
        self.is_over = False
        self.is_like_before = False

    def step(self, seen: SeenColors) -> Step | None:
        """One more picture: what to set, None for nothing now."""
        if self._rounds == self._pictures == 0:
            self._pictures = 1
            return Step(self._exposure, self._kelvin)
        self._pictures += 1
        if self._pictures <= TAKES_EFFECT or self.is_over:
            return None
        self._pictures = 1
        self._rounds += 1
        darker = math.log(self._before.brightness / seen.brightness)
        redder = self._before.red_blue - seen.red_blue if self._kelvins else 0.0
        worst = max(abs(darker), abs(redder))
        self.is_over = worst < NEAR or self._rounds >= MOST_ROUNDS
        self.is_like_before = worst < FAR
        if self.is_over:
            return None
        factor = math.exp(max(-LARGEST_STEP, min(LARGEST_STEP, darker)))
        self._exposure = _within(self._exposure * factor, self._exposures)
        if self._kelvins is not None and abs(redder) >= NEAR:
            self._kelvin = _within(self._kelvin + self._step_k(redder, seen.red_blue), self._kelvins)
        return Step(self._exposure, self._kelvin)

    def _step_k(self, redder: float, red_blue: float) -> float:
        tried, self._tried = self._tried, (self._kelvin, red_blue)
        if tried is None or tried[0] == self._kelvin or tried[1] == red_blue:
            return math.copysign(FIRST_STEP_K, redder)
        slope = (red_blue - tried[1]) / (self._kelvin - tried[0])
        return max(-1500.0, min(1500.0, redder / slope))


def _within(value: float, reach: tuple[float, float]) -> float:
    return max(reach[0], min(reach[1], value))


def longest_exposure(fps: float) -> float:
    """In :data:`EXPOSURE_UNIT_S`."""
    return LIGHT_SHARE / fps / EXPOSURE_UNIT_S


@dataclass(frozen=True, slots=True)
class Control:
    """A value that can be set, and between which it can be; the unit is the camera's own."""

    value: float
    least: float
    most: float


class ColorControls(Protocol):
    """What a driver can set of its colour camera."""

    def stop_following(self) -> tuple[bool, bool]:
        """Switch automatic exposure and white balance off; which of both took it."""
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
    """Lets the camera follow the light until it is to hold; that it holds is reported to the owner of the process."""

    def __init__(self, outlet: Outlet, controls: ColorControls) -> None:
        self._outlet, self._controls = outlet, controls
        self._hold: ColorHold | None = None
        self._last: bytes | None = None

    def begin(self) -> bool | None:
        """Begin to hold, which is reported when it is done."""
        self._hold = None
        took = self._controls.stop_following()
        if self._last is None:
            return all(took)
        exposure, balance = self._controls.exposure(), self._controls.balance()
        if not took[0] or exposure is None:
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
            self._outlet.send(ExposureSet(done))
