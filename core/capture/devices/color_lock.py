"""Lock exposure and white balance of a camera that does not report the values its automatic has chosen.

The automatic is switched off, then values are searched at which the images look as before.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from carpus.core.capture.devices.capture_process import CaptureChannel, ExposureLocked

EXPOSURE_SHARE = 0.9
"""Longest exposure as a share of the frame period: a longer one would slow the camera down."""
EXPOSURE_UNIT_S = 1e-4
"""Unit in which both makers count exposure."""
PIXEL_STEP = 97
"""Every so-many-th pixel is sampled."""
EFFECT_DELAY_FRAMES = 7
"""Images until a change is certain to be visible."""
DONE_TOLERANCE, HELD_TOLERANCE = 0.02, 0.10
"""Relative difference of brightness and of red/blue: at which the search ends, and up to which colours count as held.
"""
MAX_ROUNDS = 12
FIRST_STEP_K = 300.0
MAX_LOG_STEP = 1.0
"""Largest change of the logarithm of the exposure in one round."""


@dataclass(frozen=True, slots=True)
class ColorStatistics:
    """Mean brightness (0 to 255) and logarithm of red over blue."""

    brightness: float
    red_blue: float


@dataclass(frozen=True, slots=True)
class ColorSettings:
    """Exposure and white balance to set; ``kelvin`` 0 if white balance cannot be set."""

    exposure: float
    kelvin: float


def measure_colors(image: Sequence[int]) -> ColorStatistics:
    """Return the colour statistics of an RGB image (bytes)."""
    red, green, blue = (sum(image[channel :: 3 * PIXEL_STEP]) + 1.0 for channel in range(3))
    count = len(range(0, len(image), 3 * PIXEL_STEP))
    return ColorStatistics((red + green + blue) / (3.0 * count), math.log(red / blue))


class ColorController:
    """Iterative search for the exposure and white balance of a reference image.

    Brightness is proportional to exposure. How red/blue depends on the colour temperature is learnt by a first step.
    """

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
        """Add one image; return what to set, or None for nothing now."""
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
            red_blue, step_k = measured.red_blue, math.copysign(FIRST_STEP_K, redder)
            tried, self._last_measurement = self._last_measurement, (self._kelvin, red_blue)
            if tried is not None and tried[0] != self._kelvin and tried[1] != red_blue:
                slope = (red_blue - tried[1]) / (self._kelvin - tried[0])
                step_k = _clamp(redder / slope, (-1500.0, 1500.0))
            self._kelvin = _clamp(self._kelvin + step_k, self._kelvins)
        return ColorSettings(self._exposure, self._kelvin)


def _clamp(value: float, reach: tuple[float, float]) -> float:
    return max(reach[0], min(reach[1], value))


@dataclass(frozen=True, slots=True)
class ColorOptions:
    """Options of a colour camera, by the maker's names of them.

    ``set`` returns whether the camera accepted a value, ``read`` the value of an option and its range (``min``,
    ``max``, ``step``), None if it cannot be set. ``fps`` limits the exposure.
    """

    auto_exposure: Any
    auto_white_balance: Any
    exposure: Any
    white_balance: Any
    fps: float
    set: Callable[[Any, float], bool]
    read: Callable[[Any], tuple[float, Any] | None]

    def set_nearest(self, option: Any, value: float) -> None:
        """Set an option to the nearest accepted value: a camera rejects values between its steps."""
        found = self.read(option)
        if found is not None:
            reach = found[1]
            step = reach.step or 1
            self.set(option, reach.min + round((_clamp(value, (reach.min, reach.max)) - reach.min) / step) * step)


class ColorLock:
    """Lock of exposure and white balance; its success is reported to the owner of the process."""

    def __init__(self, channel: CaptureChannel, options: ColorOptions) -> None:
        self._channel, self._options = channel, options
        channel.lock_exposure = self.start
        self._controller: ColorController | None = None
        self._last_image: bytes | None = None

    def start(self) -> bool | None:
        """Start to lock; return whether it succeeded, or None if that is reported later."""
        self._controller = None
        options = self._options
        took = [options.set(option, 0) for option in (options.auto_exposure, options.auto_white_balance)]
        if self._last_image is None:
            return all(took)
        exposure, balance = options.read(options.exposure), options.read(options.white_balance)
        if not took[0] or exposure is None:
            return False
        shortest, longest = exposure[1].min, min(exposure[1].max, EXPOSURE_SHARE / options.fps / EXPOSURE_UNIT_S)
        kelvin, kelvins = (0.0, None) if balance is None else (balance[0], (balance[1].min, balance[1].max))
        self._controller = ColorController(
            measure_colors(self._last_image),
            exposure[0],
            (shortest, max(shortest, longest)),
            kelvin,
            kelvins,
        )
        return None

    def add_frame(self, image: Sequence[int]) -> None:
        """Take one more colour image (RGB bytes)."""
        if self._controller is None:
            self._last_image = bytes(image)
            return
        step = self._controller.update(measure_colors(image))
        if step is not None:
            self._options.set_nearest(self._options.exposure, step.exposure)
            if step.kelvin:
                self._options.set_nearest(self._options.white_balance, step.kelvin)
        if self._controller.is_done:
            done = self._controller.has_converged
            self._controller = None
            self._channel.send(ExposureLocked(done))
