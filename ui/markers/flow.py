"""The flow of naming the markers: on the source that was opened, until tracking begins."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from carpus.core.calibration.result import Verdict
from carpus.core.records.values import unless_away
from carpus.core.rounding import written
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.markers.screen import MarkersScreen
from carpus.ui.messages.messages import Answer


class MarkersFlow(Flow):
    """Third step."""

    place, guide, while_aside = "markers", "calibration", True
    screen: MarkersScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, MarkersScreen(context.theme, context.background))
        context.opener.closing.connect(self.screen.end)
        self.screen.naming.started.connect(lambda: context.way.show("live"))
        self.screen.naming.told.connect(context.messages.fault)
        self.screen.naming.judged.connect(self.check_registration)

    def show(self) -> None:
        """On the source that is open. How far its camera is to be trusted is told, and keeps nobody from measuring."""
        now, library = self.context.now, self.context.library
        source, set_up = now.source, now.set_up
        assert source is not None
        assert set_up is not None
        alike = unless_away(lambda: library.sessions_alike(set_up.patient_id, set_up), ())
        picture = unless_away(lambda: library.marker_picture(set_up.patient_id, set_up), None)
        day = numbers.day_month(alike[0].recorded) if alike else ""
        self.screen.begin(source.calibrator, picture, day)
        self.context.way.go("markers")
        if now.kind == "camera":
            self.context.camera.met(source.measuring.feed.info.serial)

    def up(self) -> None:
        """Back to the camera; names that a person has given are not thrown away by one key."""
        if not self.screen.has_names:
            self.context.way.show("camera")
            return
        self.context.messages.ask(
            Words(
                self.tr("Leave the markers?"),
                self.tr("The names given on this picture would be lost."),
                self.tr("Stay here, or go back to the camera."),
            ),
            (
                Answer(self.tr("Back to the camera"), lambda: self.context.way.show("camera"), "B", risky=True),
                Answer(self.tr("Stay here"), lambda: None),
            ),
        )

    def leave(self) -> None:
        self.screen.end()

    close = leave

    def check_registration(self, verdict: Verdict) -> None:
        """Nothing said whether depth lies on colour, so it was taken to; the calibration has measured otherwise."""
        off = next((finding for finding in verdict.findings if finding.kind == "depth_off"), None)
        source, choice = self.context.now.source, self.context.now.choice
        if off is None or source is None or not source.asks_registration:
            return
        name = Path(choice.path.replace("\\", "/")).name

        def open_again() -> None:
            self.context.way.show("camera")
            self.context.opener.open(replace(choice, registered=False))

        self.context.messages.ask(
            Words(
                self.tr("The depth of {name} lies {px} pixels beside its colours.").format(
                    name=name, px=written(off.value)
                ),
                self.tr("The recording itself is not changed. It does not say that its depth was laid on its colours."),
                self.tr("Open it again with the depth moved onto the colours, then click the markers anew."),
            ),
            (
                Answer(self.tr("Leave it as it is"), lambda: None),
                Answer(self.tr("Open it again"), open_again),
            ),
        )
