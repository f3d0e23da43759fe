"""Puts the screens together: patient, exercise, camera, markers, live, review, progress, report.

Each knows its own way (:mod:`ui.flow`); here is what belongs to none: the top bar, the keys, the end.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import date, datetime
from functools import partial
from pathlib import Path

from carpus.app.desktop.bar import Bar
from carpus.app.desktop.care_cameras import CareCameras
from carpus.app.desktop.screens import PLACES, Screens, flow_class
from carpus.app.desktop.server_watch import ServerWatch
from carpus.app.settings import Settings
from carpus.core.capture.files.raw import MB_PER_MINUTE
from carpus.core.errors import CarpusFault
from carpus.core.records.corrections import Corrections
from carpus.core.records.library import Library
from carpus.core.records.values import Patient
from carpus.ui.background import Background
from carpus.ui.camera_state import CameraState
from carpus.ui.flow import STEPS, TABS, Flow, Navigator, ScreenContext
from carpus.ui.last_places import LastPlaces
from carpus.ui.messages.messages import Messages
from carpus.ui.now_open import NowOpen, SourceChoice
from carpus.ui.opening import Opener, OpenIt
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme

ALL_KEYS = ("help", "settings", "search", "new_patient", "back", "quit")


@dataclass(frozen=True, slots=True)
class Parts:
    """What the journey needs besides the window."""

    library: Library
    open_source: OpenIt
    cameras: CareCameras
    settings: Settings
    is_demo: bool
    today: Callable[[], date]
    """The day now: the program may stand open for days."""


class Journey(Screens):
    """The way through the screens, and what they share."""

    def __init__(self, shell: Shell, theme: Theme, parts: Parts) -> None:
        super().__init__(shell)
        self._shell, self._library = shell, parts.library
        self.takes_escape: Callable[[], bool] = lambda: False
        """Asked first when Esc is pressed: True where that closed something, and the person stays where they are."""
        self.settings, self.is_demo = parts.settings, parts.is_demo
        self.now = NowOpen(choice=SourceChoice("practice" if parts.is_demo else "camera"))
        self.background = Background()
        self.messages = messages = Messages(shell.stage, theme)
        self.opener = Opener(parts.open_source, self.now, self.background, messages.fault, self)
        self.camera_state = CameraState(
            parts.cameras, self.background, lambda: datetime.now().astimezone(), self, is_demo=parts.is_demo
        )
        self.way = Navigator(shell, lambda: messages.busy, lambda: "live" in self.way.flows and self.live.is_recording)
        self.context = ScreenContext(
            shell, theme, parts.library, self.background, messages, self.way, self.now, self.opener,
            self.camera_state, parts.cameras, LastPlaces(parts.library.folder), parts.settings.report, parts.today,
            parts.is_demo, parts.settings.patient.sound,
            parts.settings.recording.keep_pictures, MB_PER_MINUTE,
        )  # fmt: skip
        for place in PLACES:
            self.way.makers[place] = partial(self._make, place)
        self.bar = Bar(self.context, lambda: self.review.screen)
        self._connect()
        self.camera_state.start()
        self._look_for_waiting()
        self.server = ServerWatch(parts.library, self)
        self.server.gone.connect(self._server_gone)
        self.server.back.connect(self._server_back)

    def _server_gone(self) -> None:
        self.bar.show()
        if self.place == "patients":
            self.patients.screen.refresh()

    def _server_back(self) -> None:
        """Who was typed while it was away is who the list says, and every screen reads what it could not."""
        now, patients = self.now, self._library.patients
        row = now.patient
        if row is not None and row.patient_id and not patients.has(row.patient_id):
            known = patients.called(row.pseudonym)
            now.patient = patients.one(known) if known else row
            if now.set_up is not None:
                now.set_up = replace(now.set_up, patient_id=now.patient.patient_id)
        for flow in self.way.flows.values():
            flow.server_back()
        self.bar.show()

    def _make(self, place: str) -> Flow:
        return flow_class(place)(self.context)

    def _connect(self) -> None:
        shell, bar, way = self._shell, self._shell.bar, self.way
        shell.bind_keys(ALL_KEYS)
        shell.key.connect(self._take_key)
        shell.asks_before_closing = lambda: any(flow.asks_before_closing() for flow in way.flows.values())
        bar.back_button.clicked.connect(way.back)
        bar.tab.connect(self.take_tab)
        bar.step.connect(lambda number: self._go_to_step(STEPS[number]))
        bar.help_button.clicked.connect(lambda: way.show("help"))
        bar.settings_button.clicked.connect(lambda: way.show("settings"))
        bar.again.clicked.connect(lambda: self.correct.open_sheet(self.now.session_id))
        way.when_made("live", self._connect_live)
        way.when_made("beside", lambda: self.beside.screen.arrived.connect(way.changed))
        way.when_made("review", self._connect_review)
        way.when_made("correct", lambda: self.correct.changed.connect(self.bar.show_again))
        way.when_made("sessions", lambda: self.sessions.screen.changed.connect(self._look_for_waiting))

    def _connect_live(self) -> None:
        self.live.screen.recording_changed.connect(self.bar.show_recording)
        self.live.screen.counted.connect(self.bar.show_counters)

    def _connect_review(self) -> None:
        self.review.screen.arrived.connect(self.way.changed)
        self.review.screen.again.connect(lambda: self.way.show("live"))

    def _look_for_waiting(self) -> None:
        """What was tracked again and waits for a decision, also from before the program was started."""
        if "correct" in self.way.flows or Corrections(self._library).are_there:
            self.correct.look_for_waiting()

    @property
    def place(self) -> str:
        return self.way.place

    # --- from one to the other ----------------------------------------------------------------------------
    def take_tab(self, number: int) -> None:
        place, patient = TABS[number], self.now.patient
        if patient is None or place == self.place or self.messages.busy:
            self.bar.show()
        elif place in ("sessions", "progress"):
            self.way.show(place, patient.patient_id)
        elif self.now.session_id:
            self.way.show(place, self.now.session_id)
        else:
            self.review.show("", patient.patient_id)

    def _go_to_step(self, place: str) -> None:
        if self.messages.busy:
            return
        if place == "exercise" and self.now.patient is not None:
            self.exercise.show(self.now.patient.patient_id)
        elif place == "camera":
            (self.markers.up if self.place == "markers" else self.camera.show)()

    def review_file(self, path: Path) -> None:
        """Open a session file handed over from outside; not while something is measured or asked."""
        if self.messages.busy or self.way.is_recording() or self.now.source is not None:
            return
        try:
            found = self._library.look_at(path)
        except CarpusFault as fault:
            self.messages.fault(fault)
            return
        if not found.patient_id:  # of nobody here: shown under the name in its file
            self.now.patient = Patient(found.subject_id.strip() or "?", found.side)
        self.review.show(found.session_id, found.patient_id)

    def _take_key(self, name: str) -> None:
        actions: dict[str, Callable[[], object]] = {
            "back": self._escape, "help": lambda: self.way.show("help"), "settings": lambda: self.way.show("settings"),
            "quit": self._shell.close,
        }  # fmt: skip
        if name in actions:
            actions[name]()

    def _escape(self) -> None:
        taken = not self.messages.busy and (
            ("live" in self.way.flows and self.live.patient_view.uncover())
            or self.takes_escape()
            or (self.place == "report" and self.report.screen.to_report())
        )
        if not taken:
            self.way.back()

    @property
    def is_at_work(self) -> bool:
        """Whether something is measured, or worked on that would end with the window."""
        measures = self.now.source is not None and self.way.behind in STEPS
        works = any(flow.is_at_work for flow in self.way.flows.values())
        return measures or works or self.background.busy

    def close(self) -> None:
        """The window closes: finish what runs, in order, and wait for it."""
        self.server.end()
        self.camera_state.stop()
        for flow in self.way.flows.values():
            flow.close()
        self.opener.end()
        self.background.wait()
        if self.now.source is not None:
            self.live.finish()
