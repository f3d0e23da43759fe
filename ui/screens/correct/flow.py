"""Controller of marker corrections: the screen, the re-analysis, and the choice of its result."""

from __future__ import annotations

import math
import threading
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from carpus.core.pipeline.correction import correct_in_process, find_lost_corrections, load_task
from carpus.core.pipeline.track import LIVE_LABEL
from carpus.core.records.corrections import Corrections, PendingResult, ResultDifference, compare_results
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.session.label_checks import Correction, read_corrections
from carpus.core.session.reader import read_detections
from carpus.core.session.values import Session, SessionHeader
from carpus.ui.kit import numbers
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import progress_bar
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import to_mid_sentence, tr
from carpus.ui.screens.correct.screen import CorrectionScreen
from carpus.ui.shell.current_selection import practice_patient_name
from carpus.ui.shell.flow import Flow, ScreenContext
from carpus.ui.words import terms
from carpus.ui.words.agreement import angle_name
from carpus.ui.words.terms import marker_title

SHOWING_SESSION = ("review", "correct")
"""Screens on which an accepted result takes the place of the old one."""


class CorrectionFlow(Flow):
    """Controller of corrections.

    One session is re-analysed at a time, in its own process, while other work continues. Its result waits in the top
    bar until the user opens it. Signals: ``progress_changed`` with percent (-1 if nothing runs) and the number of
    results that wait.
    """

    screen_name, guide_page = "correct", "correct"
    runs_behind_overlay = True
    screen: CorrectionScreen

    progress_changed = Signal(int, int)
    _percent_reached = Signal(int)

    def __init__(self, context: ScreenContext) -> None:
        self._corrections = Corrections(context.library)
        self._corrections.delete_unfinished()
        super().__init__(context, CorrectionScreen(context.theme, context.background, self._corrections))
        self.dialog = ResultsDialog(context.window.screen_stack, context.theme)
        self._tracking, self._background = Background(), Background()
        self._stop_event = threading.Event()
        self.running_session_id, self._session_label, self._percent = "", "", -1
        self.pending: list[PendingResult] = []
        self._shown_result: PendingResult | None = None
        self._percent_reached.connect(self._on_progress)
        self.screen.reanalysis_requested.connect(self.start)
        self.screen.fault_raised.connect(context.messages.show_fault)
        self.screen.back_requested.connect(context.navigator.navigate_back)
        self.dialog.stop_button.clicked.connect(self.stop)
        self.dialog.keep_button.clicked.connect(lambda: self._decide(accept=False))
        self.dialog.use_button.clicked.connect(lambda: self._decide(accept=True))

    @property
    def is_busy(self) -> bool:
        return self._tracking.is_busy

    def refresh_pending(self) -> None:
        """Find results that wait for a decision, at the start and after a deletion."""
        self._background.run(self._corrections.list_pending, self._on_pending, self.context.messages.show_fault, self)

    def _on_pending(self, found: Sequence[PendingResult]) -> None:
        self.pending = list(found)
        self._emit_progress()

    def open(self, session_id: str, session: Session, row: int) -> None:
        if self.running_session_id:
            self.open_dialog()
            return
        self._session_label = describe_session(session.header)
        self.screen.show_session(session_id, session, row)
        self.context.navigator.switch_screen("correct")

    def start(self, session_id: str, corrections: Sequence[Correction]) -> None:
        """Start a re-analysis in the background."""
        if self.running_session_id:
            self.open_dialog()
            return
        self.running_session_id, self._percent = session_id, 0
        self._stop_event.clear()
        trial: list[Path] = []

        def work() -> bool:
            trial.append(self._corrections.new_pending_path(session_id))
            origin = self.context.library.entry(session_id).path
            task = load_task(origin, trial[0], corrections, self.context.report_settings.therapist)
            return correct_in_process(task, self._report_progress, self._stop_event)

        def on_done(finished: bool) -> None:
            one = PendingResult(session_id, trial[0])
            if finished and one not in self.pending:  # a look has found it already
                self.pending.append(one)
            self._finish_tracking()
            if finished and self.dialog.isVisible():  # the user is waiting for it
                self._show_pending(one)
            if finished:
                self.refresh_pending()  # one from before may still come, and know nothing of it

        def on_failed(fault: Exception) -> None:
            self._finish_tracking()
            self.context.messages.show_fault(fault)

        self._emit_progress()
        self._tracking.run(work, on_done, on_failed, self)
        self.context.navigator.navigate_back()

    def navigate_back(self) -> None:
        self.return_to_session()

    def stop(self) -> None:
        """Cancel the re-analysis and keep the old result."""
        self._stop_event.set()
        self.dialog.close_dialog()

    def open_dialog(self, session_id: str = "") -> None:
        """Show the running re-analysis, or a result that waits, of this session first."""
        if self.running_session_id:
            self.dialog.show_running(self._session_label, max(self._percent, 0))
            self.dialog.open()
        elif self.pending:
            of_session = [one for one in self.pending if one.session_id == session_id]
            self._show_pending((of_session or self.pending)[-1 if of_session else 0])
            self.dialog.open()

    def close(self) -> None:
        """Stop what is running; results that wait stay."""
        self._stop_event.set()
        self._tracking.join()
        self._background.join()

    def _report_progress(self, done: int, total: int) -> None:
        """Emit the progress; called in the background."""
        self._percent_reached.emit(100 * done // max(total, 1))

    def _on_progress(self, percent: int) -> None:
        if not self.running_session_id:
            return
        self._percent = percent
        if self.dialog.isVisible():
            self.dialog.show_running(self._session_label, percent)
        self._emit_progress()

    def _finish_tracking(self) -> None:
        self.running_session_id, self._percent = "", -1
        if self._stop_event.is_set() or not self.pending:
            self.dialog.close_dialog()
        self._emit_progress()

    def _emit_progress(self) -> None:
        self.progress_changed.emit(self._percent, len(self.pending))

    # --- old or new ---------------------------------------------------------------------------------------
    def _show_pending(self, one: PendingResult) -> None:
        self._shown_result = one
        self.dialog.show_reading(self._session_label)

        def read() -> tuple[str, str]:
            old, new = self._corrections.read_both(one.session_id, one.path)
            corrections = [correction for correction, _ in read_corrections(new)]
            lost = find_lost_corrections(new, read_detections(one.path), corrections)
            live_labels = sum(event.kind == LIVE_LABEL for event in old.events)
            return describe_session(old.header), difference_words(compare_results(old, new), lost, live_labels)

        def show_results(found: tuple[str, str]) -> None:
            if self._shown_result == one and self.dialog.isVisible():
                self.dialog.show_results(*found)

        def on_failed(fault: Exception) -> None:
            self.dialog.close_dialog()
            self.context.messages.show_fault(fault)

        self._background.run(read, show_results, on_failed, self)

    def _decide(self, *, accept: bool) -> None:
        """Accept or discard the result that is shown, and take it off the waiting ones."""
        one, self._shown_result = self._shown_result, None
        self.dialog.close_dialog()
        if one in self.pending:
            self.pending.remove(one)
            self._emit_progress()
        if one is None:
            return
        before, path = one.session_id, one.path

        def work() -> str:
            if accept:
                return str(self._corrections.accept(before, path))
            self._corrections.discard(path)
            return ""

        def on_done(new: str) -> None:
            # A look from before may still come, and tell of it once more: the last look is the true one.
            self.refresh_pending()
            navigator = self.context.navigator
            if new and self.context.current.session_id == before and navigator.underlying_screen in SHOWING_SESSION:
                navigator.open_under_overlay("review", new)

        def on_failed(fault: Exception) -> None:
            self.context.messages.show_fault(fault)
            self.refresh_pending()

        self._background.run(work, on_done, on_failed, self)


def describe_session(header: SessionHeader) -> str:
    """Return patient, date, exercise and hand of a session."""
    when = numbers.format_date_time(datetime.fromisoformat(header.recorded or header.created))
    what = f"{terms.exercise_name(header.exercise)}, {to_mid_sentence(terms.hand_name(header.hand))}"
    name = practice_patient_name() if header.subject_id == PRACTICE_PATIENT else header.subject_id
    return " · ".join((name, when, what))


def difference_words(found: ResultDifference, lost_labels: Sequence[str], live_labels: int = 0) -> str:
    """Return how much two results differ, where most, and which labels were lost.

    ``live_labels`` were given while Carpus 0.2.0 measured; they are not applied again.
    """
    sentences = []
    if live_labels:
        words = tr("Labels given while measuring ({count}) are not part of the new result. Check the markers.")
        sentences.append(words.format(count=live_labels))
    if lost_labels:
        names = ", ".join(marker_title(name) for name in lost_labels)
        sentences.append(tr("Correction not kept for {names}. Correct a later frame too.").format(names=names))
    if found.lost_markers:
        names = ", ".join(marker_title(name) for name in found.lost_markers)
        sentences.append(
            tr("Rarely visible in the new result: {names}. Their angles are missing there.").format(names=names)
        )
    if found.changed_frames:
        pattern = tr(
            "{count} of {common} frames differ by more than 2°. Largest difference at {time}: {angle}, {size}."
        )
        sentences.append(
            pattern.format(
                count=found.changed_frames,
                common=found.compared_frames,
                time=numbers.format_clock_tenths(found.max_difference_at_s),
                angle=to_mid_sentence(angle_name(found.max_difference_angle)),
                size=numbers.format_degrees(math.degrees(found.max_difference_rad)),
            )
        )
    else:
        sentences.append(tr("No frame differs by more than 2°."))
    if found.recovered_frames:
        sentences.append(
            tr("{count} frames have an angle that was missing before.").format(count=found.recovered_frames)
        )
    if found.is_live:
        sentences.append(tr("Live values are compared, because one of the two results is not smoothed."))
    return " ".join(sentences)


class ResultsDialog(Dialog):
    """Progress and result of a re-analysis.

    Only the user opens it. The focus is on the button that changes nothing, so Enter, Space and Esc decide nothing.
    """

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 720)
        self.title = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.session_label = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.words = Text(theme, "", 14, REGULAR, wrap=True)
        self.bar = progress_bar(self.tr("Progress of the re-analysis"))
        self.stop_button = Button(theme, self.tr("&Stop"), "plain", height_px=44)
        self.keep_button = Button(theme, self.tr("&Keep old result"), "plain", height_px=44)
        self.use_button = Button(theme, self.tr("&Use new result"), "plain", height_px=44)
        self.later_button = Button(theme, "", "plain", height_px=44)
        self.later_button.clicked.connect(self.close_dialog)
        self.set_default(self.later_button)
        body = self.card.body
        body.setSpacing(8)
        for widget in (self.title, self.session_label, self.bar, self.words):
            body.addWidget(widget)
        row = row_layout(self.stop_button, self.keep_button, self.use_button, STRETCH, self.later_button, gap=10)
        fill(body, 4, row)

    def show_running(self, session_label: str, percent: int) -> None:
        self._show_heading(self.tr("Re-analysing: {percent} %").format(percent=percent), session_label)
        self.bar.setValue(percent)
        self.words.setText(
            self.tr(
                "You can continue working. The old result stays until you choose the new one. “Stop” keeps the old "
                "result."
            )
        )
        self.later_button.set_label(self.tr("Continue working"))
        self._show_sections(is_running=True)

    def show_reading(self, session_label: str) -> None:
        self._show_heading(self.tr("Reading both results…"), session_label)
        self.words.setText("")
        self.later_button.set_label(self.tr("Decide later"))
        self._show_sections()

    def show_results(self, session_label: str, words: str) -> None:
        self._show_heading(self.tr("Use the new result?"), session_label)
        self.words.setText(words)
        self.later_button.set_label(self.tr("Decide later"))
        self._show_sections(is_ready=True)

    def _show_heading(self, title: str, whose: str) -> None:
        self.title.setText(title)
        self.session_label.setText(whose)
        self.setAccessibleName(f"{title} {whose}")

    def _show_sections(self, *, is_running: bool = False, is_ready: bool = False) -> None:
        self.bar.setVisible(is_running)
        self.stop_button.setVisible(is_running)
        self.keep_button.setVisible(is_ready)
        self.use_button.setVisible(is_ready)
        self.words.setVisible(bool(self.words.text()))
