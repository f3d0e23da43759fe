"""The screens, each imported and created when it is first needed, to keep the start fast."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib import import_module
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
PLACES = (
    "patients", "exercise", "camera", "markers", "live", "sessions", "review", "progress", "report", "by_hand",
    "comparison", "board", "card", "help", "correct",
)  # fmt: skip


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
    match place:
        case "patients":
            from carpus.ui.screens.patients.flow import PatientsFlow

            return PatientsFlow
        case "exercise":
            from carpus.ui.screens.setup.flow import ExerciseFlow

            return ExerciseFlow
        case "camera":
            from carpus.ui.screens.setup.flow import CameraFlow

            return CameraFlow
        case "markers":
            from carpus.ui.screens.markers.flow import MarkersFlow

            return MarkersFlow
        case "live":
            from carpus.ui.screens.live.flow import LiveFlow

            return LiveFlow
        case "sessions":
            from carpus.ui.screens.sessions.flow import SessionsFlow

            return SessionsFlow
        case "review":
            from carpus.ui.screens.review.flow import ReviewFlow

            return ReviewFlow
        case "progress":
            from carpus.ui.screens.progress.flow import ProgressFlow

            return ProgressFlow
        case "report":
            from carpus.ui.screens.report.flow import ReportFlow

            return ReportFlow
        case "by_hand":
            from carpus.ui.screens.by_hand.flow import ManualMeasurementsFlow

            return ManualMeasurementsFlow
        case "comparison":
            from carpus.ui.screens.comparison.flow import ComparisonFlow

            return ComparisonFlow
        case "board":
            from carpus.ui.screens.camera_calibration.flow import CameraCalibrationFlow

            return CameraCalibrationFlow
        case "card":
            from carpus.ui.screens.check_card.flow import CheckCardFlow

            return CheckCardFlow
        case "help":
            from carpus.ui.screens.help.flow import HelpFlow

            return HelpFlow
        case "correct":
            from carpus.ui.screens.correct.flow import CorrectionFlow

            return CorrectionFlow
    raise KeyError(place)


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
    for module in ("carpus.ui.screens.settings.flow",):
        import_module(module)
        yield module
