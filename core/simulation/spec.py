"""Specification of a simulated recording."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from dataclasses import dataclass
from enum import IntEnum
from typing import Literal

import numpy as np

from carpus.core.model.depth_sensor import SENSORS
from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.hand.protocols import MarkerProtocol, get_protocol
from carpus.core.model.names import Limits, check_limits
from carpus.core.model.types import Side

RENDERER_VERSION = 5
"""Part of the cache key: raise it whenever a spec gives other images than before."""

ACCESSORIES = ("ring", "watch", "bandage")
HABITS = ("tenodesis", "grip", "open_close", "rolling_forearm", "restless_clicks")
NONE = "none"

Light = Literal["drawn", "bright", "normal", "dim"]
Sleeve = Literal["drawn", "none", "grey", "white", "blue", "jeans"]


class RandomStream(IntEnum):
    """Independent random streams of a seed: one option does not change the draws of another."""

    PATIENT = 1
    SCENE = 2
    MOTION = 3
    TROUBLE = 4
    COLOR_NOISE = 5
    DEPTH_NOISE = 6
    CLICKS = 7
    TIMES = 8
    MEASUREMENTS = 9
    TISSUE = 10
    HABIT = 11
    ANATOMY = 12
    WORN = 13


_LIMITS: Limits = {
    "seed": (0, 2**63),
    "seconds": (0.001, 86400.0),
    "fps": (0.1, 240.0),
    "speed_hz": (0.001, 20.0),
    "range_share": (0.0, 1.5),
    "repetitions": (0, 1_000_000),
    "tremor_deg": (0.0, 30.0),
    "tremor_hz": (0.0, 30.0),
    "hand_length_mm": (100.0, 240.0),
    "skin_glide_mm": (0.0, 12.0),
    "cupping": (0.0, 1.5),
    "skin_tone": (0, 5),
    "pen_marks": (0, 30),
    "distance_m": (0.3, 4.0),
    "yaw_deg": (-360.0, 360.0),
    "tilt_deg": (-75.0, 75.0),
    "tilt_heading_deg": (-360.0, 360.0),
    "false_blobs": (0.0, 100.0),
    "hidden_share": (0.0, 0.9),
    "hidden_mean_s": (0.01, 60.0),
    "dropped_share": (0.0, 0.9),
    "click_error_px": (0.0, 50.0),
    "depth_scale_error": (0.0, 0.2),
    "depth_delay_s": (-0.1, 0.1),
    "exposure_s": (0.0, 0.1),
}
"""Least and largest value of every number."""


@dataclass(frozen=True, slots=True)
class RecordingSpec:
    """Specification of a simulated recording; ``None`` and ``"drawn"`` are drawn from the seed.

    Motion: ``motion`` is a name of :data:`core.simulation.motions.MOTIONS`; ``speed_hz`` repetitions per second;
    ``range_share`` scales the motion's range; ``repetitions`` ends the motion early; ``pain_limited`` stops strokes
    short, in several sub-movements. ``skin_offsets=False`` puts the joint centres into the markers (the papers' chain).

    Soft hand (reference 10): ``skin_glide_mm`` of the knuckle markers for 90 degrees of their joints, other markers
    less; ``cupping`` is the share of the full flexion of metacarpals 4 and 5 in a power grip; both are 0 for the rigid
    hand, None is drawn per person. ``habit``: names of :data:`HABITS` joined by ``+``, or ``none``.

    Person: ``anatomy="wide"`` varies hand and markers more than the tables (:mod:`.patient`). ``worn``: names of
    :data:`ACCESSORIES` joined by ``+``, or ``none``; ``pen_marks`` is the number of small blue marks on the skin.

    Camera: ``distance_m`` to the hand, turned by ``yaw_deg``, off the vertical by ``tilt_deg`` about the axis in the
    table at ``tilt_heading_deg`` from the fingers' direction: 0 has a side of the hand nearer, -90 its fingertips.

    Disturbances: mean number of ``false_blobs`` in a frame; ``hidden_share`` of the time each marker is covered, on
    average for ``hidden_mean_s``; ``dropped_share`` of the frames; ``click_error_px`` standard deviation per axis.

    Sensor: ``sensor`` is a name of :data:`core.model.depth_sensor.SENSORS`; ``depth_scale_error`` the largest scale
    error; ``depth_delay_s`` of the depth image after the colour image; ``exposure_s`` blurs motion over that time;
    ``sensor_noise=False`` gives clean images for tests.
    """

    seed: int = 0
    hand: Side = "right"
    protocol: str = "wrist6"
    motion: str = "flexion"
    seconds: float = 8.0
    fps: float = 30.0
    speed_hz: float | None = None
    range_share: float = 1.0
    repetitions: int | None = None
    pain_limited: bool = False
    tremor_deg: float = 0.0
    tremor_hz: float = 5.0
    dip: Literal["coupled", "free"] = "coupled"
    hand_length_mm: float | None = None
    skin_offsets: bool = True
    skin_glide_mm: float | None = 0.0
    cupping: float | None = 0.0
    habit: str = NONE
    anatomy: Literal["usual", "wide"] = "usual"
    worn: str = NONE
    pen_marks: int = 0
    skin_tone: int | None = None
    light: Light = "drawn"
    sleeve: Sleeve = "drawn"
    distance_m: float | None = None
    yaw_deg: float | None = None
    tilt_deg: float | None = None
    tilt_heading_deg: float | None = None
    false_blobs: float = 0.0
    hidden_share: float = 0.0
    hidden_mean_s: float = 0.4
    object_passes: bool = False
    leaves_picture: bool = False
    dropped_share: float = 0.0
    click_error_px: float = 1.5
    depth_scale_error: float = 0.01
    depth_delay_s: float = 0.004
    exposure_s: float = 0.008
    sensor_noise: bool = True
    sensor: str = "primesense"

    def __post_init__(self) -> None:
        get_protocol(self.protocol)
        check_limits("simulation", self, _LIMITS)
        if self.hand not in ("right", "left"):
            raise SettingsInvalid("simulation", f"hand = {self.hand}")
        if self.sensor not in SENSORS:
            raise SettingsInvalid("simulation", f"sensor = {self.sensor} ({', '.join(SENSORS)})")
        if self.anatomy not in ("usual", "wide"):
            raise SettingsInvalid("simulation", f"anatomy = {self.anatomy}")
        for name, given, known in (("habit", self.habits, HABITS), ("worn", self.accessories, ACCESSORIES)):
            if not set(given) <= set(known):
                wanted = f"{NONE}, or with + between: {', '.join(known)}"
                raise SettingsInvalid("simulation", f"{name} = {getattr(self, name)} ({wanted})")

    @property
    def habits(self) -> tuple[str, ...]:
        """Names of the habits."""
        return () if self.habit == NONE else tuple(self.habit.split("+"))

    @property
    def accessories(self) -> tuple[str, ...]:
        """Names of what is worn."""
        return () if self.worn == NONE else tuple(self.worn.split("+"))

    @property
    def marker_protocol(self) -> MarkerProtocol:
        return get_protocol(self.protocol)

    def generator(self, stream: RandomStream) -> np.random.Generator:
        """Return the random generator of one stream, reproducible for a seed."""
        return np.random.default_rng([self.seed, int(stream)])

    def to_json(self) -> str:
        """Return all options as stored beside a recording."""
        options = dataclasses.asdict(self)
        if self.sensor == "primesense":  # as before there were others, so that what was rendered is found again
            del options["sensor"]
        return json.dumps(options, sort_keys=True)

    @property
    def cache_key(self) -> str:
        """Name under which the rendering of this spec is cached."""
        return hashlib.sha256(f"{RENDERER_VERSION} {self.to_json()}".encode()).hexdigest()[:24]
