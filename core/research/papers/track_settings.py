"""Settings of tracking by the papers' filter, and how a session stores them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Self

from carpus.core.calibration.neutral_pose import with_w0_from_markers
from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.pipeline import stored_settings
from carpus.core.pipeline.stored_settings import StoredSettings
from carpus.core.pipeline.track import NeutralNoise, TrackSettings, is_of_other_filter
from carpus.core.research.papers.hand_model import PaperSettings, calibrate_as_written
from carpus.core.research.papers.tracker import PaperTracker
from carpus.core.session.values import Session


@dataclass(frozen=True, slots=True)
class PaperTrackSettings(TrackSettings):
    """Settings of both papers' filter in ZYX, which uses nothing of ``tracker`` and does not smooth."""

    paper: PaperSettings = field(default_factory=PaperSettings)

    @classmethod
    def from_base(cls, base: TrackSettings, paper: PaperSettings) -> Self:
        """Return settings with this filter in place of Carpus' own."""
        return cls(base.detection, base.calibration, base.tracker, base.smooth, paper)

    @property
    def dip_free(self) -> bool:
        return False

    @property
    def uses_depth(self) -> bool:
        return False

    def build_tracker(
        self, calibration: Calibration, camera: Camera, learnt: NeutralNoise
    ) -> tuple[PaperTracker, None]:
        return PaperTracker(calibration, camera, self.paper), None

    def adapt_calibration(self, calibration: Calibration, camera: Camera) -> Calibration:
        return calibrate_as_written(calibration, camera, self.paper.palm)

    def adapt_stored_calibration(self, session: Session) -> Calibration:
        before = settings_from_json(session.header.parameters)
        calibration = session.calibration
        if before is not None and isinstance(before.settings, PaperTrackSettings):
            if before.settings.paper.palm == self.paper.palm:
                return calibration
            calibration = with_w0_from_markers(calibration)
        return self.adapt_calibration(calibration, session.camera)


def settings_from_json(parameters: str) -> StoredSettings | None:
    """Return the settings in a session's parameters, of whichever filter; None where there are none."""
    return stored_settings.settings_from_json(
        parameters, PaperTrackSettings if is_of_other_filter(parameters) else TrackSettings
    )
