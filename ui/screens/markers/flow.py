"""The flow of labelling the markers, from the open source to the start of tracking."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from carpus.core.calibration.result import Verdict
from carpus.core.model.fault_text import MessageText
from carpus.core.model.rounding import format_rounded
from carpus.core.records.values import read_or_default
from carpus.ui.kit import numbers
from carpus.ui.screens.markers.screen import MarkersScreen
from carpus.ui.shell.flow import Flow, ScreenContext
from carpus.ui.shell.messages import Answer


class MarkersFlow(Flow):
    """Third step."""

    screen_name, guide_page, runs_behind_overlay = "markers", "calibration", True
    screen: MarkersScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, MarkersScreen(context.theme, context.background))
        context.opener.closing.connect(self.screen.close_calibrator)
        self.screen.labelling.started.connect(lambda: context.navigator.open_screen("live"))
        self.screen.labelling.fault_raised.connect(context.messages.show_fault)
        self.screen.labelling.judged.connect(self.check_registration)

    def open(self) -> None:
        """Open on the running source."""
        now, library = self.context.current, self.context.library
        source, set_up = now.source, now.set_up
        assert source is not None
        assert set_up is not None
        alike = read_or_default(lambda: library.matching_sessions(set_up.patient_id, set_up), ())
        picture = read_or_default(lambda: library.read_marker_photo(set_up.patient_id, set_up), None)
        day = numbers.format_day_month(alike[0].recorded) if alike else ""
        self.screen.open_calibrator(source.calibrator, picture, day)
        self.context.navigator.switch_screen("markers")
        if now.source_choice.kind == "camera":
            self.context.camera.set_serial(source.measuring.feed.info.serial)

    def navigate_back(self) -> None:
        """Go back to the camera; ask first if labels would be lost."""
        if self.screen.labels is None or not self.screen.labels.confirmed_px:
            self.context.navigator.open_screen("camera")
            return
        self.context.messages.show_question(
            MessageText(
                self.tr("Leave this screen?"),
                self.tr("The labels on this image would be lost."),
                self.tr("Stay here, or go back to the camera."),
            ),
            (
                Answer(
                    self.tr("Back to the camera"),
                    lambda: self.context.navigator.open_screen("camera"),
                    "B",
                    is_risky=True,
                ),
                Answer(self.tr("Stay here"), lambda: None),
            ),
        )

    def on_leave(self) -> None:
        self.screen.close_calibrator()

    close = on_leave

    def check_registration(self, verdict: Verdict) -> None:
        """Offer to open a recording again if its depth turns out not to be registered."""
        off = next((finding for finding in verdict.findings if finding.kind == "depth_off"), None)
        source, choice = self.context.current.source, self.context.current.source_choice
        if off is None or source is None or not source.is_registration_unknown:
            return
        name = Path(choice.path.replace("\\", "/")).name

        def open_again() -> None:
            self.context.navigator.open_screen("camera")
            self.context.opener.open(replace(choice, is_depth_registered=False))

        self.context.messages.show_question(
            MessageText(
                self.tr("Depth and colour of {name} are misaligned by {px} pixels.").format(
                    name=name, px=format_rounded(off.value)
                ),
                self.tr("The recording was not changed. It does not say whether depth and colour are aligned."),
                self.tr("Open it again with depth aligned to colour, then click the markers again."),
            ),
            (
                Answer(self.tr("Do not change it"), lambda: None),
                Answer(self.tr("Open the recording again"), open_again),
            ),
        )
