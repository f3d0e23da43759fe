"""Holds exposure and white balance of a camera that does not tell what its automatics have chosen.

Automatics are switched off, then values are looked for at which the pictures look as before.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from carpus.core.capture.devices.capture_child import CaptureOutlet, ExposureLocked

EXPOSURE_SHARE = 0.9
"""Of a picture's time the longest exposure: a longer one would slow the camera down."""
EXPOSURE_UNIT_S = 1e-4
"""In which both makers count exposure."""
PIXEL_STEP = 97
"""Every so-many-th pixel is looked at."""
EFFECT_DELAY_FRAMES = 7
"""Pictures until a change is seen for certain: some are on their way."""
DONE_TOLERANCE, HELD_TOLERANCE = 0.02, 0.10
"""Share by which brightness, and red against blue, may differ: to be done, and to count as held at all."""
MAX_ROUNDS = 12
FIRST_STEP_K = 300.0
MAX_LOG_STEP = 1.0
"""Of the logarithm of the exposure in one round."""


@dataclass(frozen=True, slots=True)
class ColorStatistics:
    """Mean brightness (0 to 255), and the logarithm of red against blue."""

    brightness: float
    red_blue: float


@dataclass(frozen=True, slots=True)
class ColorSettings:
    """What to set next; ``kelvin`` 0 where white balance cannot be set."""

    exposure: float
    kelvin: float


def measure_colors(image: Sequence[int]) -> ColorStatistics:
    """Of the bytes of an RGB picture."""
    red, green, blue = (sum(image[channel :: 3 * PIXEL_STEP]) + 1.0 for channel in range(3))
    count = len(range(0, len(image), 3 * PIXEL_STEP))
    return ColorStatistics((red + green + blue) / (3.0 * count), math.log(red / blue))


class ColorController:
    """Steps towards the pictures of before. Brightness follows the exposure; how red against blue follows the colour
    temperature is learnt by a first step."""

    def __init__(
        self,
        reference: ColorStatistics,
        exposure: float,
        exposures: tuple[float, float],
        kelvin: float,
        kelvins: tuple[float, float] | None,
    ) -> None:
        self._reference = reference
        self._exposure, self._exposures = _clamp(exposure, exposures), exposures
        self._kelvin, self._kelvins = kelvin, kelvins
        self._frames = self._rounds = 0
        self._last_measurement: tuple[float, float] | None = None
        self.is_done = False
        self.has_converged = False

    def update(self, measured: ColorStatistics) -> ColorSettings | None:
        """One more picture: what to set, None for nothing now."""
        if self._rounds == self._frames == 0:
            self._frames = 1
            return ColorSettings(self._exposure, self._kelvin)
        self._frames += 1
        if self._frames <= EFFECT_DELAY_FRAMES or self.is_done:
            return None
        self._frames = 1
        self._rounds += 1
        darker = math.log(self._reference.brightness / measured.brightness)
        redder = self._reference.red_blue - measured.red_blue if self._kelvins else 0.0
        worst = max(abs(darker), abs(redder))
        self.is_done = worst < DONE_TOLERANCE or self._rounds >= MAX_ROUNDS
        self.has_converged = worst < HELD_TOLERANCE
        if self.is_done:
            return None
        factor = math.exp(max(-MAX_LOG_STEP, min(MAX_LOG_STEP, darker)))
        self._exposure = _clamp(self._exposure * factor, self._exposures)
        if self._kelvins is not None and abs(redder) >= DONE_TOLERANCE:
            self._kelvin = _clamp(self._kelvin + self._temperature_step_k(redder, measured.red_blue), self._kelvins)
        return ColorSettings(self._exposure, self._kelvin)

    def _temperature_step_k(self, redder: float, red_blue: float) -> float:
        tried, self._last_measurement = self._last_measurement, (self._kelvin, red_blue)
        if tried is None or tried[0] == self._kelvin or tried[1] == red_blue:
            return math.copysign(FIRST_STEP_K, redder)
        slope = (red_blue - tried[1]) / (self._kelvin - tried[0])
        return max(-1500.0, min(1500.0, redder / slope))


def _clamp(value: float, reach: tuple[float, float]) -> float:
    return max(reach[0], min(reach[1], value))


def max_exposure(fps: float) -> float:
    """In :data:`EXPOSURE_UNIT_S`."""
    return EXPOSURE_SHARE / fps / EXPOSURE_UNIT_S


@dataclass(frozen=True, slots=True)
class Control:
    """A value that can be set, and between which it can be; the unit is the camera's own."""

    value: float
    min_value: float
    max_value: float


class ColorControls(Protocol):
    """What a driver can set of its colour camera."""

    def disable_automatic(self) -> tuple[bool, bool]:
        """Switch automatic exposure and white balance off; which of both took it."""
        ...

    def read_exposure(self) -> Control | None:
        """None where it cannot be set."""
        ...

    def read_white_balance(self) -> Control | None:
        """Colour temperature in kelvin; None where it cannot be set."""
        ...

    def apply(self, step: ColorSettings) -> None:
        """Set both to the nearest that the camera takes."""
        ...


class ColorLock:
    """Lets the camera follow the light until it is to hold; that it holds is reported to the owner of the process."""

    def __init__(self, outlet: CaptureOutlet, controls: ColorControls) -> None:
        self._outlet, self._controls = outlet, controls
        self._controller: ColorController | None = None
        self._last_image: bytes | None = None

    def start(self) -> bool | None:
        """Begin to hold, which is reported when it is done."""
        self._controller = None
        took = self._controls.disable_automatic()
        if self._last_image is None:
            return all(took)
        exposure, balance = self._controls.read_exposure(), self._controls.read_white_balance()
        if not took[0] or exposure is None:
            return False
        self._controller = ColorController(
            measure_colors(self._last_image),
            exposure.value,
            (exposure.min_value, exposure.max_value),
            balance.value if balance else 0.0,
            (balance.min_value, balance.max_value) if balance else None,
        )
        return None

    def add_frame(self, image: Sequence[int]) -> None:
        """The bytes of one more colour picture, red first."""
        if self._controller is None:
            self._last_image = bytes(image)
            return
        step = self._controller.update(measure_colors(image))
        if step is not None:
            self._controls.apply(step)
        if self._controller.is_done:
            done = self._controller.has_converged
            self._controller = None
            self._outlet.send(ExposureLocked(done))
