"""The flow of putting markers right: the screen, tracking again beside everything else, and the choice at the end."""

from __future__ import annotations

import math
import threading
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import Signal

from carpus.core.pipeline.correction import correct_in_process, not_held, task_of
from carpus.core.records.corrections import Corrections, Difference, Waiting, difference
from carpus.core.records.set_up import PRACTICE_PATIENT
from carpus.core.results.figures import session_figures
from carpus.core.results.seen import joint_curves, session_curves
from carpus.core.session.marker_doubts import Correction, corrections_in
from carpus.core.session.reader import read_detections
from carpus.core.session.values import Session, SessionHeader
from carpus.ui import numbers, terms
from carpus.ui.background import Background
from carpus.ui.correct.results_sheet import BothResults, ResultsSheet
from carpus.ui.correct.screen import CorrectScreen
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.marker_words import finger_of, marker_name
from carpus.ui.now_open import practice_name
from carpus.ui.translate import inside, tr
from carpus.ui.words.agreement import angle_name


class CorrectFlow(Flow):
    """``changed`` carries percent, -1 when nothing runs, and how many new results wait for a decision.

    One session is tracked again at a time, in a process of its own; window, other patients and a new measurement go on.
    What comes of it waits in the top bar until a person opens it: nothing comes up over what somebody does.
    """

    place, guide = "correct", "correct"
    while_aside = True
    screen: CorrectScreen

    changed = Signal(int, int)
    _at = Signal(int)

    def __init__(self, context: ScreenContext) -> None:
        self._stored = Corrections(context.library)
        self._stored.clear_unfinished()
        super().__init__(context, CorrectScreen(context.theme, context.background, self._stored))
        self.sheet = ResultsSheet(context.shell.stage, context.theme)
        self._tracking, self._background = Background(), Background()
        self._stopping = threading.Event()
        self.running, self._whose, self._percent = "", "", -1
        self.waiting: list[Waiting] = []
        self._shown: Waiting | None = None
        self._at.connect(self._take_progress)
        self.screen.wanted.connect(self.start)
        self.screen.told.connect(context.messages.fault)
        self.screen.done.connect(context.way.back)
        self.sheet.stop.clicked.connect(self.stop)
        self.sheet.keep.clicked.connect(self._keep)
        self.sheet.use.clicked.connect(self._use)

    @property
    def is_at_work(self) -> bool:
        return self._tracking.busy

    def look_for_waiting(self) -> None:
        """When the program starts, and after something was erased: what waits for a decision."""
        self._background.run(self._stored.waiting, self._take_waiting, self.context.messages.fault, self)

    def _take_waiting(self, found: Sequence[Waiting]) -> None:
        self.waiting = list(found)
        self._say()

    def show(self, session_id: str, session: Session, row: int) -> None:
        if self.running:
            self.open_sheet()
            return
        self._whose = whose(session.header)
        self.screen.begin(session_id, session, row)
        self.context.way.go("correct")

    def start(self, session_id: str, corrections: Sequence[Correction]) -> None:
        """Track again in the background."""
        if self.running:
            self.open_sheet()
            return
        self.running, self._percent = session_id, 0
        self._stopping.clear()
        trial: list[Path] = []

        def work() -> bool:
            trial.append(self._stored.trial_path(session_id))
            origin = self.context.library.entry(session_id).path
            task = task_of(origin, trial[0], corrections, self.context.report.therapist)
            return correct_in_process(task, self._tell_progress, self._stopping)

        def done(finished: bool) -> None:
            one = Waiting(session_id, trial[0])
            if finished and one not in self.waiting:  # a look has found it already
                self.waiting.append(one)
            self._end()
            if finished and self.sheet.isVisible():  # somebody waits for it there
                self._show_waiting(one)
            if finished:
                self.look_for_waiting()  # one from before may still come, and know nothing of it

        def failed(fault: Exception) -> None:
            self._end()
            self.context.messages.fault(fault)

        self._say()
        self._tracking.run(work, done, failed, self)
        self.context.way.back()

    def up(self) -> None:
        self.to_session()

    def stop(self) -> None:
        """Keep the old result; what runs is given up."""
        self._stopping.set()
        self.sheet.close_sheet()

    def open_sheet(self, session_id: str = "") -> None:
        """What runs, or what waits for a decision: of this session first."""
        if self.running:
            self.sheet.show_running(self._whose, max(self._percent, 0))
            self.sheet.begin()
        elif self.waiting:
            own = [one for one in self.waiting if one.session_id == session_id]
            self._show_waiting((own or self.waiting)[-1 if own else 0])
            self.sheet.begin()

    def close(self) -> None:
        """The program ends; what waits for a decision waits on."""
        self._stopping.set()
        self._tracking.wait()
        self._background.wait()

    def _tell_progress(self, done: int, total: int) -> None:
        """Called in the background."""
        self._at.emit(100 * done // max(total, 1))

    def _take_progress(self, percent: int) -> None:
        if not self.running:
            return
        self._percent = percent
        if self.sheet.isVisible():
            self.sheet.show_running(self._whose, percent)
        self._say()

    def _end(self) -> None:
        self.running, self._percent = "", -1
        if self._stopping.is_set() or not self.waiting:
            self.sheet.close_sheet()
        self._say()

    def _say(self) -> None:
        self.changed.emit(self._percent, len(self.waiting))

    # --- old or new ---------------------------------------------------------------------------------------
    def _show_waiting(self, one: Waiting) -> None:
        self._shown = one
        self.sheet.show_reading(self._whose)

        def read() -> tuple[str, str, BothResults]:
            old, new = self._stored.both(one.session_id, one.trial)
            said = [correction for correction, _ in corrections_in(new)]
            words = difference_words(difference(old, new), not_held(new, read_detections(one.trial), said))
            both = BothResults(
                session_figures(new), session_curves(old), session_curves(new), joint_curves(old), joint_curves(new),
                max((finger_of(marker) for one in said for marker in one.places), default=0),
            )  # fmt: skip
            return whose(old.header), words, both

        def show(found: tuple[str, str, BothResults]) -> None:
            if self._shown == one and self.sheet.isVisible():
                self.sheet.show_both(*found)

        def failed(fault: Exception) -> None:
            self.sheet.close_sheet()
            self.context.messages.fault(fault)

        self._background.run(read, show, failed, self)

    def _decided(self) -> Waiting | None:
        """The new result that was decided about; it waits no more."""
        one, self._shown = self._shown, None
        self.sheet.close_sheet()
        if one in self.waiting:
            self.waiting.remove(one)
            self._say()
        return one

    def _keep(self) -> None:
        one = self._decided()
        if one is None:
            return
        # A look from before may still come, and tell of it once more: the last look is the true one.
        self._background.run(
            lambda: self._stored.drop(one.trial), lambda _: self.look_for_waiting(), self._not_decided, self
        )

    def _use(self) -> None:
        one = self._decided()
        if one is None:
            return
        self._background.run(
            lambda: self._stored.use(one.session_id, one.trial),
            lambda new: self._used(one.session_id, str(new)),
            self._not_decided,
            self,
        )

    def _not_decided(self, fault: Exception) -> None:
        self.context.messages.fault(fault)
        self.look_for_waiting()

    def _used(self, before: str, new: str) -> None:
        """A new result counts from now on; where the old one was on the screen the new one is shown."""
        self.look_for_waiting()
        if self.context.now.session_id == before and self.context.way.behind in ("review", "correct"):
            self.context.way.show_behind("review", new)


def whose(header: SessionHeader) -> str:
    """Whose session, from when and of what."""
    when = numbers.report_date(datetime.fromisoformat(header.recorded or header.created))
    what = f"{terms.exercise_name(header.exercise)}, {inside(terms.hand_name(header.hand))}"
    name = practice_name() if header.subject_id == PRACTICE_PATIENT else header.subject_id
    return " · ".join((name, when, what))


def difference_words(found: Difference, missed: Sequence[str]) -> str:
    """What a person needs to choose: how much differs, most of all where, and which names did not hold."""
    said = []
    if missed:
        names = ", ".join(marker_name(name) for name in missed)
        said.append(tr("Not held: {names}. Correct a picture soon after too.").format(names=names))
    if found.lost:
        names = ", ".join(marker_name(name) for name in found.lost)
        said.append(tr("Hardly seen any more: {names}. What they show has no value then.").format(names=names))
    if found.changed:
        pattern = tr("{count} of {common} pictures differ by more than 2°, most at {time}: {angle}, {size}.")
        said.append(
            pattern.format(
                count=found.changed,
                common=found.common,
                time=numbers.clock_tenths(found.at_s),
                angle=inside(angle_name(found.most_at)),
                size=numbers.degrees(math.degrees(found.most_rad)),
            )
        )
    else:
        said.append(tr("No picture differs by more than 2°."))
    if found.found:
        said.append(tr("{count} pictures have an angle that had none.").format(count=found.found))
    if found.live:
        said.append(tr("As measured live: one of the two was not looked back at."))
    return " ".join(said)
