"""Settings and constants of the tracker, with their sources."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from carpus.core.model.hand.anatomy_prior import AnatomyPrior
from carpus.core.model.names import Limits, check_limits
from carpus.core.model.setting_values import NOT_IN_FILE
from carpus.core.tracking.filter.mixture_filter import UnscentedParameters
from carpus.core.tracking.filter.motion import MotionNoise
from carpus.core.tracking.filter.palm_state import InitialSd
from carpus.core.tracking.filter.soft_tissue import SoftTissue
from carpus.core.tracking.filter.surface_fit import SurfaceSettings

Profile = Literal["slow", "standard", "brisk"]


@dataclass(frozen=True, slots=True)
class AssociationSettings:
    """Priors, densities and gate of the association, equation (12) of the wrist paper.

    Attributes
    ----------
    prior_marker, prior_clutter : float
        Prior probability that a blob is one given marker, and that it is none.
    gate_sd : float
        Gate, in standard deviations of the innovation: a blob beyond it is never that marker.
    depth_range_m : float
        Range over which the depth of clutter is spread.
    min_markers_at_depth, max_depth_error_m : int, float
        With so many markers at their predicted depth, another marker whose depth is wrong by no more than this is
        associated by its image position.
    beam_width : int
        Joint associations that are followed side by side.
    consistency_probability : float
        A joint association is doubted if its NIS is beyond this quantile.
    """

    prior_marker: float = 0.9
    prior_clutter: float = 0.1
    gate_sd: float = 5.0
    depth_range_m: float = 0.5
    min_markers_at_depth: int = 3
    max_depth_error_m: float = 0.03
    beam_width: int = 10
    consistency_probability: float = 0.9995


@dataclass(frozen=True, slots=True)
class Profiles:
    """Process noise by reference 4.5: acceleration of wrist, turning and joints."""

    slow: MotionNoise = field(default_factory=lambda: MotionNoise(0.7, 2.0, 6.0))
    standard: MotionNoise = field(default_factory=lambda: MotionNoise(2.0, 8.0, 12.0))
    brisk: MotionNoise = field(default_factory=lambda: MotionNoise(6.0, 40.0, 60.0))


@dataclass(frozen=True, slots=True)
class MeasurementNoise:
    """Measurement noise.

    Attributes
    ----------
    pixel_sd_px : float
        Of the centre of a whole, well lit marker; measured again on every still hand.
    depth_noise_ratio : float
        Scatter of the depths over that of the sensor model; measured again on every still hand.
    depth_bias_sd_m : float
        Of the constant error of a marker's depth over a recording: the sensor's matching window flattens knuckles.
    outlier_sd : float
        A residual beyond it is given the noise that it shows.
    max_variance_factor, min_variance_factor : float
        Limits of the adaptive factor on each marker's variance.
    """

    pixel_sd_px: float = 0.15
    depth_noise_ratio: float = 1.0
    outlier_sd: float = 3.5
    max_variance_factor: float = 100.0
    min_variance_factor: float = 0.6
    depth_bias_sd_m: float = 2.5e-4


@dataclass(frozen=True, slots=True)
class FingerSettings:
    """Settings of thumb and fingers.

    ``skin_offsets``: discs lie on the skin over the joints; without them the chain of the hand paper, discs in the
    joints. ``anatomy``: how far a hand may differ from the average one.
    """

    skin_offsets: bool = True
    anatomy: AnatomyPrior = field(default_factory=AnatomyPrior)


_LIMITS: Limits = {"lost_after_s": (0.0, 3600.0)}


@dataclass(frozen=True, slots=True)
class TrackerSettings:
    """What a person may set of the tracker, and its constants; all of it is stored with every session.

    ``profile`` which of the ``profiles`` moves the hand; ``use_depth`` False: colour alone, as in the papers; ``dip``:
    DIP joints coupled to PIP joints or free; ``lost_after_s`` without three palm markers the hand is lost.

    The constants, whose reasons stand in their classes: ``mode_scales`` of motion modes run side by side, as factors on
    the process noise; ``shape_bias_share`` of a correction of the palm's shape taken for a constant error of depth;
    ``tissue`` how skin and relief move; ``use_surface`` measure the back of the hand by its depth, as ``surface`` says;
    ``marker_radius_m`` of the paper discs, as measured at each calibration.
    """

    profile: Profile = "standard"
    use_depth: bool = True
    dip: Literal["coupled", "free"] = "coupled"
    lost_after_s: float = 1.5
    profiles: Profiles = field(default_factory=Profiles, metadata=NOT_IN_FILE)
    shape_bias_share: float = field(default=0.3, metadata=NOT_IN_FILE)
    mode_scales: tuple[float, ...] = field(default=(0.5, 4.0), metadata=NOT_IN_FILE)
    scaling: UnscentedParameters = field(default_factory=UnscentedParameters, metadata=NOT_IN_FILE)
    initial: InitialSd = field(default_factory=InitialSd, metadata=NOT_IN_FILE)
    noise: MeasurementNoise = field(default_factory=MeasurementNoise, metadata=NOT_IN_FILE)
    association: AssociationSettings = field(default_factory=AssociationSettings, metadata=NOT_IN_FILE)
    fingers: FingerSettings = field(default_factory=FingerSettings, metadata=NOT_IN_FILE)
    tissue: SoftTissue = field(default_factory=SoftTissue, metadata=NOT_IN_FILE)
    use_surface: bool = field(default=True, metadata=NOT_IN_FILE)
    surface: SurfaceSettings = field(default_factory=SurfaceSettings, metadata=NOT_IN_FILE)
    marker_radius_m: float = field(default=0.006, metadata=NOT_IN_FILE)

    def __post_init__(self) -> None:
        check_limits("tracker", self, _LIMITS)

    @property
    def motion_noise(self) -> MotionNoise:
        noise: MotionNoise = getattr(self.profiles, self.profile)
        return noise
