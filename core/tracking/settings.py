"""What can be chosen about the tracker, with its defaults and where they come from."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from carpus.core.names import Limits, check_limits
from carpus.core.tracking.association import AssociationSettings
from carpus.core.tracking.finger_settings import FingerSettings
from carpus.core.tracking.motion import MotionNoise
from carpus.core.tracking.palm_state import InitialSd
from carpus.core.tracking.soft_tissue import SoftTissue
from carpus.core.tracking.surface_fit import SurfaceSettings
from carpus.core.tracking.unscented import Spread

Profile = Literal["slow", "standard", "brisk"]


@dataclass(frozen=True, slots=True)
class Profiles:
    """Process noise by reference 4.5: acceleration of wrist, turning and joints."""

    slow: MotionNoise = field(default_factory=lambda: MotionNoise(0.7, 2.0, 6.0))
    standard: MotionNoise = field(default_factory=lambda: MotionNoise(2.0, 8.0, 12.0))
    brisk: MotionNoise = field(default_factory=lambda: MotionNoise(6.0, 40.0, 60.0))

    def of(self, profile: Profile) -> MotionNoise:
        return {"slow": self.slow, "standard": self.standard, "brisk": self.brisk}[profile]


@dataclass(frozen=True, slots=True)
class MeasurementNoise:
    """``pixel_sd_px`` of a whole, well lit disc's centre, measured anew on every still hand; ``depth_ratio`` of the
    depths' scatter to that of a reading by the book, likewise measured.
    ``depth_stays_m``: error of a disc's depth that stays over a recording (the matching window flattens knuckles).
    A residual beyond ``outlier_sd`` is given the noise it shows; each marker's variance rises to at most
    ``most_adapted`` times and falls to ``least_adapted``.
    """

    pixel_sd_px: float = 0.15
    depth_ratio: float = 1.0
    outlier_sd: float = 3.5
    most_adapted: float = 100.0
    least_adapted: float = 0.6
    depth_stays_m: float = 2.5e-4


_LIMITS: Limits = {
    "shape_hidden": (0.0, 1.0),
    "mode_scales": (0.001, 1000.0),
    "marker_radius_m": (0.0005, 0.1),
    "lost_after_s": (0.0, 3600.0),
}


@dataclass(frozen=True, slots=True)
class TrackerSettings:
    """Defaults of the tracker; all of it is stored with every session.

    ``profile`` which of the ``profiles`` moves the hand. ``mode_scales``: the motion modes run side by side, as factors
    on the process noise; ``dip``: end joints bound to the middle joints or free.
    ``shape_hidden``: share of a correction of the palm's shape taken for a depth that stays wrong.
    ``tissue``: how skin and relief move; ``use_surface``: measure the back of the hand by its depth, as ``surface``
    says.
    ``marker_radius_m`` of the paper discs; ``lost_after_s`` without three palm markers the hand is lost.
    """

    profile: Profile = "standard"
    profiles: Profiles = field(default_factory=Profiles)
    use_depth: bool = True
    dip: Literal["coupled", "free"] = "coupled"
    shape_hidden: float = 0.3
    mode_scales: tuple[float, ...] = (0.5, 4.0)
    spread: Spread = field(default_factory=Spread)
    initial: InitialSd = field(default_factory=InitialSd)
    noise: MeasurementNoise = field(default_factory=MeasurementNoise)
    association: AssociationSettings = field(default_factory=AssociationSettings)
    fingers: FingerSettings = field(default_factory=FingerSettings)
    tissue: SoftTissue = field(default_factory=SoftTissue)
    use_surface: bool = True
    surface: SurfaceSettings = field(default_factory=SurfaceSettings)
    marker_radius_m: float = 0.006
    lost_after_s: float = 1.5

    def __post_init__(self) -> None:
        check_limits("tracker", self, _LIMITS)

    @property
    def motion_noise(self) -> MotionNoise:
        return self.profiles.of(self.profile)
