"""The screens, each imported and created when it is first needed, to keep the start fast."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib import import_module
from pkgutil import resolve_name
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from carpus.ui.shell.flow import Flow, Navigator, ScreenContext

if TYPE_CHECKING:
    from carpus.ui.screens.by_hand.flow import ManualMeasurementsFlow
    from carpus.ui.screens.camera_calibration.flow import CameraCalibrationFlow
    from carpus.ui.screens.check_card.flow import CheckCardFlow
    from carpus.ui.screens.comparison.flow import ComparisonFlow
    from carpus.ui.screens.correct.flow import CorrectionFlow
    from carpus.ui.screens.help.flow import HelpFlow
    from carpus.ui.screens.live.flow import LiveFlow
    from carpus.ui.screens.markers.flow import MarkersFlow
    from carpus.ui.screens.patients.flow import PatientsFlow
    from carpus.ui.screens.progress.flow import ProgressFlow
    from carpus.ui.screens.report.flow import ReportFlow
    from carpus.ui.screens.review.flow import ReviewFlow
    from carpus.ui.screens.sessions.flow import SessionsFlow
    from carpus.ui.screens.setup.flow import CameraFlow, ExerciseFlow

SLOW_CORE_MODULES = (
    "carpus.core.pipeline.correction",
    "carpus.core.research.agreement.retest",
    "carpus.core.calibration.camera.calibrate",
    "carpus.core.calibration.card.measure",
    "carpus.core.results.side_by_side",
)
"""Slow imports of the screens without Qt, which any thread may load."""
PLACES = {
    "patients": "patients.flow:PatientsFlow", "exercise": "setup.flow:ExerciseFlow",
    "camera": "setup.flow:CameraFlow", "markers": "markers.flow:MarkersFlow", "live": "live.flow:LiveFlow",
    "sessions": "sessions.flow:SessionsFlow", "review": "review.flow:ReviewFlow",
    "progress": "progress.flow:ProgressFlow", "report": "report.flow:ReportFlow",
    "by_hand": "by_hand.flow:ManualMeasurementsFlow", "comparison": "comparison.flow:ComparisonFlow",
    "board": "camera_calibration.flow:CameraCalibrationFlow", "card": "check_card.flow:CheckCardFlow",
    "help": "help.flow:HelpFlow", "correct": "correct.flow:CorrectionFlow",
}  # fmt: skip
"""Each screen's flow below ``carpus.ui.screens``; :class:`Screens` has their types."""


class Screens(QObject):
    """Each screen's flow by its name."""

    navigator: Navigator
    patients: PatientsFlow
    exercise: ExerciseFlow
    camera: CameraFlow
    markers: MarkersFlow
    live: LiveFlow
    sessions: SessionsFlow
    review: ReviewFlow
    progress: ProgressFlow
    report: ReportFlow
    by_hand: ManualMeasurementsFlow
    comparison: ComparisonFlow
    board: CameraCalibrationFlow
    card: CheckCardFlow
    help: HelpFlow
    correct: CorrectionFlow

    if not TYPE_CHECKING:

        def __getattr__(self, place: str) -> Flow:
            """Create the flow of a screen that was not shown yet."""
            if place not in PLACES:
                raise AttributeError(place)
            return self.navigator.flow(place)


def load_flow_class(place: str) -> Callable[[ScreenContext], Flow]:
    """Import a screen and return the class of its flow."""
    found: Callable[[ScreenContext], Flow] = resolve_name(f"carpus.ui.screens.{PLACES[place]}")
    return found


def load_core() -> Iterator[str]:
    """Import :data:`SLOW_CORE_MODULES` one by one, in any thread."""
    for module in SLOW_CORE_MODULES:
        import_module(module)
        yield module


def load_screens() -> Iterator[str]:
    """Import all screens one by one, in the window's thread.

    Qt creates a class when it is first named; if two threads do that at once the process ends.
    """
    for place in PLACES:
        load_flow_class(place)
        yield place
    import_module("carpus.ui.screens.settings.flow")
    yield "settings"
