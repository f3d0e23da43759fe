"""The top bar: patient, screen, and the state of camera, disk and recording."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt

from carpus.core.calibration.result import CalibrationFinding
from carpus.core.model.fault_text import shorten
from carpus.core.model.rounding import round_half_away
from carpus.core.pipeline.live_values import LiveCounters
from carpus.ui.kit import numbers
from carpus.ui.kit.keys import bind_key
from carpus.ui.shell.flow import PATIENT_TABS, SETUP_STEPS, ScreenContext
from carpus.ui.words import terms
from carpus.ui.words.fault_words import finding_words

if TYPE_CHECKING:
    from carpus.ui.screens.review.screen import ReviewScreen

MAX_NAME_LENGTH = 24
"""Characters of a recording's name in the top bar."""


class TopBarController(QObject):
    """Shows patient, screen, and the state of camera, disk and recording."""

    def __init__(self, context: ScreenContext, review: Callable[[], ReviewScreen]) -> None:
        super().__init__(context.window)
        self._shell, self._current, self._navigator = context.window, context.current, context.navigator
        self._camera, self._review, self._is_demo = context.camera, review, context.is_demo
        self._reanalysis, self._store = (-1, 0), context.library.store
        self._lost_before_recording = 0
        self._navigator.screen_changed.connect(lambda _: self.refresh())
        self._navigator.banner_changed.connect(self.refresh)
        names, button = context.names, self._shell.top_bar.names_button
        button.toggled.connect(names.set_hidden)
        names.changed.connect(lambda: button.setChecked(names.is_hidden))
        names.changed.connect(self.refresh)
        bind_key(self._shell, "hide_names", button.toggle, Qt.ShortcutContext.WindowShortcut)
        self._camera.availability_checked.connect(self.show_camera)

    def refresh(self) -> None:
        """Update everything for the present screen."""
        bar, place = self._shell.top_bar, self._navigator.screen_name
        row, set_up = self._current.patient, self._current.set_up
        side = set_up.side if set_up is not None else row.side if row is not None else ""
        words = [terms.hand_name(side)] if side else []
        if place == "live" and set_up is not None:
            words.append(terms.exercise_name(set_up.exercise.id))
        here = self._navigator.current_flow
        bar.show_session(here.title(), " · ".join(words))
        if place in SETUP_STEPS and place != "live":
            names = [self.tr("Exercise"), self.tr("Camera"), self.tr("Markers"), self.tr("Measure")]
            bar.show_navigation(names, SETUP_STEPS.index(place), is_steps=True)
        elif place in PATIENT_TABS or here.parent_tab:
            names = [self.tr("Sessions"), self.tr("Review"), self.tr("Progress"), self.tr("Report")]
            bar.show_navigation(names, PATIENT_TABS.index(here.parent_tab or place))
        else:
            bar.show_navigation()
        if place != "live":
            self._shell.top_bar.disk.show_state("none", "")
        self.show_reanalysis(*self._reanalysis)
        self.show_camera()
        self._shell.banner.show_lines(self.banner_lines())

    def banner_lines(self) -> list[str]:
        """Return warnings about the data on the screen: simulated, uncertain, server unavailable."""
        now, place = self._current, self._navigator.screen_name
        figures = self._review().results if place == "review" else None
        simulated = False
        findings: tuple[CalibrationFinding, ...] = ()
        measuring = now.source.measuring if now.source is not None else None
        if place in ("markers", "live") and measuring is not None:
            simulated = measuring.is_simulated
            if place == "live" and measuring.calibration is not None:
                findings = measuring.calibration.verdict.findings
        elif figures is not None:
            simulated, findings = figures.is_simulated, figures.findings
        lines = []
        if self._store.is_server_away:
            lines.append(
                self.tr(
                    "The clinic’s server does not respond. Until it does, patients and sessions cannot be shown or "
                    "changed. You can still measure."
                )
            )
        if simulated and now.patient is not None and not now.is_practice:
            words = self.tr("This is a simulated hand, not {name}. It is excluded from analysis.")
            lines.append(words.format(name=now.patient.pseudonym))
        if figures is not None and figures.is_excluded:
            lines.append(self.tr("This session is excluded from analysis."))
        if findings:
            summaries = " ".join(finding_words(finding).summary for finding in findings)
            lines.append(self.tr("Measured although uncertain: {findings}").format(findings=summaries))
        return [*lines, *self._navigator.current_flow.banner_lines()]

    def show_camera(self) -> None:
        """Show the state of the camera; on the live screen :meth:`show_counters` does."""
        camera, now, place = self._shell.top_bar.camera, self._current, self._navigator.screen_name
        kind = now.source_choice.kind
        if place == "live":
            return
        if place == "camera":
            camera.show_state("none", "")  # the screen itself says which there are, and how they stand
        elif place == "review" and (reviewed := self._review().reviewed) is not None:
            saved_at = reviewed.end_time
            camera.show_state("good", self.tr("Saved {time}").format(time=f"{saved_at:%H:%M}"))
        elif kind == "file" and now.source is not None:
            name = Path(now.source_choice.path).name
            camera.show_state("good", self.tr("Recording {name}").format(name=shorten(name, MAX_NAME_LENGTH)))
        elif self._is_demo or (kind == "practice" and (now.source is not None or place in SETUP_STEPS)):
            camera.show_state("good", self.tr("Simulated camera"))
        elif self._camera.is_connected:
            camera.show_state("good", self.tr("Camera ready"))
        else:
            camera.show_state("bad", self.tr("No camera"))

    def show_reanalysis(self, percent: int, new_results: int) -> None:
        """Show the progress of a re-analysis (-1 for none) and the number of new results to review."""
        self._reanalysis = (percent, new_results)
        button = self._shell.top_bar.reanalysis_button
        if self._navigator.screen_name == "live":
            button.show_text("", "")
        elif percent >= 0:
            short = self.tr("{percent} %").format(percent=percent)
            button.show_text(
                self.tr("Re-analysing {percent}").format(percent=short), short, self.tr("Progress and Stop")
            )
        elif new_results:
            one = self.tr("New result: choose one") if new_results == 1 else self.tr("{count} new results: choose")
            button.show_text(one.format(count=new_results), self.tr("Choose"), self.tr("Old and new result overlaid"))
        else:
            button.show_text("", "")

    def show_recording(self, state: str, seconds: float) -> None:
        """Show the state of the recording; help and settings are locked meanwhile."""
        self._shell.top_bar.recording_pill.show_state(state, seconds)  # type: ignore[arg-type]
        self._shell.top_bar.show_recording(state == "recording")
        self._shell.top_bar.lock_overlays(state != "off")

    def show_counters(self, counters: LiveCounters) -> None:
        """Show a low frame rate, dropped frames, and the recording time left on the disk."""
        least = 12 if self._current.source_choice.kind == "practice" else 25  # 15 are drawn, as few as are enough
        few = counters.fps < least
        words = self.tr("{count} fps (below {least})") if few else self.tr("{count} fps")
        words = words.format(count=round_half_away(counters.fps), least=least)
        lost = counters.dropped + counters.missing
        if not counters.is_recording:
            self._lost_before_recording = lost
        if lost > self._lost_before_recording:  # of this recording: what was missed before it is missing nowhere
            words = self.tr("{words}, {lost} frames dropped").format(
                words=words, lost=lost - self._lost_before_recording
            )
        elif not few:
            words = ""
        self._shell.top_bar.camera.show_state("warn" if few else "good", words)
        minutes = counters.disk_minutes_left
        if minutes < 30.0 or (counters.is_recording and minutes == minutes):  # before, pictures are not in it
            state = "bad" if minutes < 10.0 else "warn" if minutes < 30.0 else "none"
            words = self.tr("Space for {time}").format(time=numbers.format_recording_time(minutes))
            self._shell.top_bar.disk.show_state(state, words, icon="hard-drive")  # type: ignore[arg-type]
