"""Which screen follows which: patient, exercise, camera, markers, live, review, progress, report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path

from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtWidgets import QWidget

from app.desktop.last_places import LastPlaces
from app.desktop.library import Library, Recovered
from app.desktop.live_events import LiveEvents
from app.desktop.opening import Opener
from app.desktop.phrases import shortened
from app.desktop.places import STEPS, TABS, Place
from app.desktop.printing import Printing
from app.desktop.sources import OpenSource, Sources
from app.desktop.teller import Teller
from app.settings import Settings
from core.output.exercises import EXERCISES, exercise_named
from core.pipeline.live_values import LiveCounters
from core.types import Side
from ui import numbers, terms
from ui.background import Background
from ui.controls.sheet import Sheet
from ui.help.screen import HelpScreen
from ui.keys import Keys
from ui.live.screen import LiveScreen
from ui.markers.screen import MarkersScreen
from ui.messages.stop_card import Answer
from ui.messages.strip import NoticeStrip
from ui.patients.screen import PatientsScreen
from ui.ports import PRACTICE_PATIENT, PatientRow, PatientStore, Phrasebook, SetUp, Words
from ui.progress.screen import ProgressScreen
from ui.report.screen import ReportScreen
from ui.review.screen import ReviewScreen
from ui.setup.camera import CameraScreen
from ui.setup.choice import SourceChoice, SourceKind
from ui.setup.exercise import ExerciseScreen
from ui.shell import Shell
from ui.theme import Theme

LOOK_FOR_CAMERA_MS = 2000
MOST_NAME = 24
"""Letters of a recording's name in the top bar."""
ALL_KEYS = ("help", "settings", "search", "new_patient", "back")


@dataclass(frozen=True, slots=True)
class Parts:
    """What the journey needs besides the window."""

    library: Library
    patients: PatientStore
    sources: Sources
    phrasebook: Phrasebook
    settings: Settings
    is_demo: bool
    today: date


class Journey(QObject):
    """Owns the screens and knows where the person is. ``settings_wanted`` asks for the settings screen."""

    settings_wanted = Signal()

    def __init__(self, shell: Shell, theme: Theme, keys: Keys, parts: Parts) -> None:
        super().__init__(shell)
        self.shell, self._parts = shell, parts
        self.library, self.settings = parts.library, parts.settings
        self.background = Background()
        self.opener = Opener(parts.sources)
        self.places = LastPlaces(parts.library.folder)
        self.teller = Teller(shell.stage, theme, parts.phrasebook)
        self.patients = PatientsScreen(theme, parts.patients, parts.today)
        self.exercise = ExerciseScreen(theme)
        self.camera = CameraScreen(theme)
        self.markers = MarkersScreen(theme, keys, self.background, parts.phrasebook)
        self.live = LiveScreen(theme, keys, self.background)
        self.review = ReviewScreen(theme, keys, self.background, parts.library)
        self.progress = ProgressScreen(theme, keys, self.background, parts.library)
        self.report = ReportScreen(theme, keys, self.background)
        self.help = HelpScreen(theme, keys)
        self.printing = Printing(self)
        self.live_events = LiveEvents(self)
        self.place: Place = "patients"
        self.patient: PatientRow | None = None
        self.set_up: SetUp | None = None
        self.source: OpenSource | None = None
        self.session_id = ""
        self._before_aside: tuple[Place, QWidget] = ("patients", self.patients)
        self._kind: SourceKind = "practice" if parts.is_demo else "camera"
        self._choice = SourceChoice(self._kind)
        self._camera_there = False
        self._connect(keys)
        shell.asks_before_closing = self._asks_before_closing
        self._camera_timer = QTimer(self)
        self._camera_timer.setInterval(LOOK_FOR_CAMERA_MS)
        self._camera_timer.timeout.connect(self._look_for_camera)
        self._camera_timer.start()
        self._look_for_camera()

    def _connect(self, keys: Keys) -> None:
        self.shell.set_keys({name: keys[name] for name in ALL_KEYS})
        self.shell.key.connect(self._take_key)
        bar = self.shell.bar
        bar.back.connect(self.back)
        bar.tab.connect(self._take_tab)
        bar.step.connect(lambda number: self._go_to_step(STEPS[number]))
        bar.help.connect(lambda: self.aside("help", self.help))
        bar.settings.connect(self.settings_wanted)
        self.help.done.connect(self.back)
        self.patients.start.connect(self.start)
        self.patients.set_up.connect(self.choose_exercise)
        self.patients.review.connect(self._review_newest)
        self.patients.progress.connect(self._open_progress)
        self.exercise.ready.connect(self._choose_camera)
        self.camera.wanted.connect(self.open_source)
        self.camera.picked.connect(lambda path: self.places.keep("recordings", str(Path(path).parent)))
        self.opener.opened.connect(self._source_opened)
        self.opener.failed.connect(self._source_failed)
        self.opener.progressed.connect(self.camera.show_progress)
        self.markers.started.connect(self._begin_live)
        self.markers.told.connect(self.teller.fault)
        self.live.told.connect(self.live_events.take)
        self.live.recording_changed.connect(self._show_recording)
        self.live.counted.connect(self._show_counters)
        self.live.stopped.connect(self._stopped)
        self.live.stop_failed.connect(self.live_events.stop_failed)
        self.review.report.connect(self.printing.session)
        self.review.export.connect(self.printing.export)
        self.review.again.connect(self._another_set)
        self.review.told.connect(self.teller.fault)
        self.review.arrived.connect(self._show_bar)
        self.progress.report.connect(self.printing.course)
        self.progress.table_wanted.connect(self.printing.table)
        self.progress.told.connect(self.teller.fault)
        self.report.told.connect(self.teller.fault)
        self.report.saved.connect(lambda path: self.places.keep("reports", str(Path(path).parent)))

    # --- patients -----------------------------------------------------------------------------------------
    def show_patients(self, choose: str = "") -> None:
        """The first screen; whatever was open is closed."""
        self.close_source()
        self._parts.library.cut_short()  # what a full disk kept from the list is taken into it
        self.patient = self.set_up = None
        self.session_id = ""
        self.patients.refresh(choose)
        self._go("patients", self.patients, self.patients.search)

    def start(self, patient_id: str) -> None:
        """Same set-up as last time, or the first one: ask for what is not known."""
        self._take_patient(patient_id)
        set_up = self._parts.library.last_set_up(patient_id)
        if patient_id == PRACTICE_PATIENT:
            self._kind = "practice"
            self._choose_camera(set_up or self._usual_set_up())
            self.open_source(SourceChoice("practice"))
        elif set_up is None:
            self.choose_exercise(patient_id)
        else:
            self._choose_camera(set_up)
            if self._kind == "camera" and self._camera_there:
                self.open_source(SourceChoice("camera"))

    def choose_exercise(self, patient_id: str) -> None:
        """First step of the set-up."""
        row = self._take_patient(patient_id)
        last = self.set_up or self._parts.library.last_set_up(patient_id)
        affected: Side | None = None if row.side == "both" else row.side
        side = last.side if last is not None else affected
        keep = last.keep_pictures if last is not None else self._parts.settings.recording.keep_pictures
        self.exercise.begin(row, last, side, keep)
        self._go("exercise", self.exercise, self.exercise.first())

    def _usual_set_up(self) -> SetUp:
        assert self.patient is not None
        exercise, nothing = EXERCISES[0], float("nan")
        return SetUp(
            self.patient.patient_id, self.patient.pseudonym, "right", exercise, exercise.repetitions, nothing, nothing
        )

    def _take_patient(self, patient_id: str) -> PatientRow:
        if self.patient is None or self.patient.patient_id != patient_id:
            self.patient = self._parts.patients.card(patient_id).row
        return self.patient

    def prepare_practice(self) -> None:
        """Render the practice patient's usual exercise now, so that nobody waits for it later."""
        nothing = float("nan")
        set_up = SetUp(PRACTICE_PATIENT, "", "right", EXERCISES[0], EXERCISES[0].repetitions, nothing, nothing)
        self.opener.prepare(set_up)
        self.patients.refresh(PRACTICE_PATIENT)

    # --- set-up -------------------------------------------------------------------------------------------
    def _choose_camera(self, set_up: SetUp) -> None:
        self.close_source()
        self.set_up = set_up
        self.camera.start_folder = self.places.folder("recordings")
        self.camera.begin(set_up, "practice" if set_up.patient_id == PRACTICE_PATIENT else self._kind)
        self._go("camera", self.camera, self.camera.first())

    def open_source(self, choice: SourceChoice) -> None:
        """Open camera, recording or simulation in the background."""
        assert self.set_up is not None
        self._kind, self._choice = choice.kind, choice
        words = {
            "camera": self.tr("The camera is being opened."),
            "file": self.tr("The recording is being opened."),
            "practice": self.tr("The simulated patient is drawn: about half a minute, once for each exercise."),
        }[choice.kind]
        self.camera.show_opening(True, words)
        self.opener.open(choice, self.set_up)

    def _source_opened(self, source: OpenSource) -> None:
        self.camera.show_opening(False)
        if source.asks_registration:
            self.background.run(source.measuring.close, lambda _: None, self.teller.fault)
            self._ask_registration(self._choice)
            return
        self.source = source
        self._show_markers()

    def _ask_registration(self, choice: SourceChoice) -> None:
        def opened(registered: bool) -> Callable[[], None]:
            return lambda: self.open_source(replace(choice, registered=registered))

        name = choice.path.replace("\\", "/").rpartition("/")[2]
        self.teller.ask(
            Words(
                self.tr("Nothing says whether the depth of {name} was laid on its colours.").format(name=name),
                self.tr("The recording itself is not changed."),
                self.tr("Most programs record with “registration” switched on. If you do not know, say yes."),
            ),
            (
                Answer(self.tr("No"), opened(False)),
                Answer(self.tr("Yes, it was"), opened(True)),
            ),
        )

    def _source_failed(self, fault: Exception) -> None:
        self.camera.show_opening(False)
        self.camera.first().setFocus(Qt.FocusReason.OtherFocusReason)
        self.teller.fault(fault, (Answer(self.tr("Choose the source again"), lambda: None),))

    def _show_markers(self) -> None:
        assert self.source is not None
        assert self.set_up is not None
        library, patient_id = self._parts.library, self.set_up.patient_id
        alike = library.sessions_alike(patient_id, self.set_up)
        day = numbers.day_month(alike[0].created) if alike else ""
        self.markers.begin(self.source.calibrator, library.marker_picture(patient_id, self.set_up), day)
        self._go("markers", self.markers, self.markers.picture)

    # --- measuring ----------------------------------------------------------------------------------------
    def _begin_live(self) -> None:
        assert self.source is not None
        assert self.set_up is not None
        self.live.begin(self.source.measuring, self.set_up)
        self._go("live", self.live, self.live)
        if self.source.measuring.starts_with_recording:
            self.live.toggle_recording()

    def _stopped(self, session_id: str) -> None:
        self._show_recording("off", 0.0)
        self.live.end()  # the source goes on, for another set
        self.open_review(session_id)

    def _another_set(self) -> None:
        if self.source is not None:
            self._begin_live()
        elif self.patient is not None:
            self.start(self.patient.patient_id)

    def close_source(self) -> None:
        """Let camera or recording go."""
        self.opener.cancel()
        source, self.source = self.source, None
        if source is not None:
            self.markers.end()
            self.live.end()
            self._show_recording("off", 0.0)
            self.background.run(source.measuring.close, lambda _: None, self.teller.fault)

    # --- views of a patient -------------------------------------------------------------------------------
    def open_review(self, session_id: str) -> None:
        """Show one session."""
        assert self.patient is not None
        self.session_id = session_id
        may_repeat = self.source is None or not self.source.measuring.starts_with_recording
        protocol = exercise_named(self._parts.library.entry(session_id).exercise).protocol
        self.review.begin(self.patient.patient_id, session_id, may_repeat=may_repeat, whole_hand=protocol.has_fingers)
        self._go("review", self.review, self.review)

    def _review_newest(self, patient_id: str) -> None:
        self._take_patient(patient_id)
        sessions = self._parts.library.sessions(patient_id)
        if sessions:
            self.open_review(sessions[0].session_id)

    def review_recovered(self, found: Recovered) -> None:
        """Open a session that had been cut short."""
        self._take_patient(found.patient_id)
        self.open_review(found.session_id)

    def _open_progress(self, patient_id: str) -> None:
        self._take_patient(patient_id)
        self.progress.start_folder = self.places.folder("exports")
        self.progress.begin(patient_id, self.session_id)
        self._go("progress", self.progress, self.progress)

    def show_report(self) -> None:
        """The page that :class:`Printing` has put on the report screen."""
        self._go("report", self.report, self.report.save_button)

    def _take_tab(self, number: int) -> None:
        place = TABS[number]
        if self.patient is None or place == self.place or self.teller.busy:
            self._show_bar()
        elif place == "live":
            self._another_set()
        elif place == "progress":
            self._open_progress(self.patient.patient_id)
        elif self.session_id and place == "report":
            self.printing.session(self.session_id)
        elif self.session_id:
            self.open_review(self.session_id)
        else:
            self._review_newest(self.patient.patient_id)

    # --- around -------------------------------------------------------------------------------------------
    def back(self) -> None:
        """One step back; what covers the screen goes first, and nothing leaves a message or a running recording."""
        if self.teller.busy:
            return
        sheets = [sheet for sheet in self.shell.findChildren(Sheet) if sheet.isVisible()]
        strips = self.patients.findChildren(NoticeStrip) if self.place == "patients" else []
        if sheets:
            sheets[-1].leave()
        elif strips:
            strips[-1].later.emit()
        elif self.place in ("help", "settings"):
            place, screen = self._before_aside
            self._go(place, screen, screen)
        elif self.place == "live" and self.live.recording_state != "off":
            return
        elif self.place == "camera" and self.patient is not None:
            self.opener.cancel()
            self.choose_exercise(self.patient.patient_id)
        elif self.place in ("markers", "live") and self.set_up is not None:
            self._choose_camera(self.set_up)
        elif self.place in ("progress", "report") and self.session_id:
            self.open_review(self.session_id)
        else:
            self.show_patients(self.patient.patient_id if self.patient else "")

    def _go_to_step(self, place: Place) -> None:
        if self.teller.busy:
            return
        if place == "exercise" and self.patient is not None:
            self.close_source()
            self.choose_exercise(self.patient.patient_id)
        elif place == "camera" and self.set_up is not None:
            self._choose_camera(self.set_up)

    def _take_key(self, name: str) -> None:
        actions: dict[str, Callable[[], None]] = {"back": self.back, "help": lambda: self.aside("help", self.help)}
        actions["settings"] = self.settings_wanted.emit
        if self.place == "patients":
            actions["search"] = lambda: self.patients.search.setFocus(Qt.FocusReason.ShortcutFocusReason)
            actions["new_patient"] = self.patients.new_patient
        if name in actions:
            actions[name]()

    def aside(self, place: Place, screen: QWidget) -> None:
        """Help or settings, from which one comes back; not over a running recording."""
        if self.place in ("help", "settings") or self.live.recording_state != "off" or self.teller.busy:
            return
        shown = self.shell.stage.currentWidget()
        assert shown is not None
        self._before_aside = (self.place, shown)
        self._go(place, screen, screen)

    def _go(self, place: Place, screen: QWidget, first: QWidget) -> None:
        if self.place == "review" and place != "review":
            self.review.end()
        if self.place == "markers" and place not in ("markers", "help", "settings"):
            self.markers.end()
        self.place = place
        # A lost camera leaves the tracking light to be seen from afar; elsewhere the top bar stays.
        self.teller.cover(self.live.stage if place == "live" else self.shell.stage)
        self.shell.show_screen(screen, first)
        self._show_bar()

    # --- the top bar --------------------------------------------------------------------------------------
    def _show_bar(self) -> None:
        bar, row, set_up = self.shell.bar, self.patient, self.set_up
        side = set_up.side if set_up is not None else row.side if row is not None else ""
        words = [terms.hand_name(side)] if side else []
        if self.place == "live" and set_up is not None:
            words.append(terms.exercise_name(set_up.exercise.id))
        bar.show_place(row.pseudonym if row is not None else "", " · ".join(words))
        if self.place in STEPS and self.place != "live":
            names = [self.tr("Exercise"), self.tr("Camera"), self.tr("Markers"), self.tr("Measure")]
            bar.show_steps(names, STEPS.index(self.place))
        elif self.place in TABS and self.place != "live":
            names = [self.tr("Session"), self.tr("Review"), self.tr("Progress"), self.tr("Report")]
            bar.show_tabs(names, TABS.index(self.place))
        else:
            bar.show_nothing()
        if self.place != "live":
            bar.disk.show_state("none", "")
            self._show_camera()
        self.shell.sign.show_lines(self._sign_lines())

    def _sign_lines(self) -> list[str]:
        """What must not be forgotten of what is on the screen: that it is simulated, or was doubtful."""
        simulated, findings = False, ()
        measuring = self.source.measuring if self.source is not None else None
        if self.place in ("markers", "live") and measuring is not None:
            simulated = measuring.is_simulated
            if self.place == "live" and measuring.calibration is not None:
                findings = measuring.calibration.verdict.findings
        elif self.place == "review" and self.review.shown and self.review.figures is not None:
            simulated, findings = self.review.figures.simulated, self.review.figures.findings
        lines = []
        if simulated and self.patient is not None and self.patient.patient_id != PRACTICE_PATIENT:
            words = self.tr("Simulated hand: this is not {name}, and does not count.")
            lines.append(words.format(name=self.patient.pseudonym))
        if self.place == "review" and self.review.figures is not None and self.review.figures.not_counted:
            lines.append(self.tr("This session does not count."))
        if findings:
            said = " ".join(self._parts.phrasebook.finding(finding).what for finding in findings)
            lines.append(self.tr("Measured although doubtful: {findings}").format(findings=said))
        return lines

    def _look_for_camera(self) -> None:
        there = self._parts.sources.camera_there()
        self._camera_there = there
        self.camera.set_camera_ready(there)
        self.patients.set_camera_ready(there or self._kind == "practice")
        if self.place != "live":
            self._show_camera()

    def _show_camera(self) -> None:
        camera = self.shell.bar.camera
        if self.place == "review" and self.review.saved_at is not None:
            camera.show_state("good", self.tr("Saved {time}").format(time=f"{self.review.saved_at:%H:%M}"))
        elif self._kind == "practice" and (self._parts.is_demo or self.source is not None):
            camera.show_state("good", self.tr("Simulated camera"))
        elif self._kind == "file" and self.source is not None:
            name = Path(self._choice.path).name
            camera.show_state("good", self.tr("Recording {name}").format(name=shortened(name, MOST_NAME)))
        elif self._camera_there:
            camera.show_state("good", self.tr("Camera ready"))
        else:
            camera.show_state("bad", self.tr("No camera"))

    def _show_recording(self, state: str, seconds: float) -> None:
        self.shell.bar.pill.show_state(state, seconds)  # type: ignore[arg-type]
        self.shell.bar.show_recording(state == "recording")
        self.shell.bar.lock_aside(state != "off")

    def _show_counters(self, counters: LiveCounters) -> None:
        words = self.tr("{count} pictures/s").format(count=round(counters.fps))
        lost = counters.dropped + counters.missing
        if lost:
            words = self.tr("{words}, {lost} lost").format(words=words, lost=lost)
        self.shell.bar.camera.show_state("good" if counters.fps >= 25.0 else "warn", words)
        minutes = counters.disk_minutes_left
        if minutes == minutes:
            state = "bad" if minutes < 10.0 else "warn" if minutes < 30.0 else "none"
            words = self.tr("{time} of disk left").format(time=numbers.room_left(minutes))
            self.shell.bar.disk.show_state(state, words, icon="hard-drive")  # type: ignore[arg-type]

    def _asks_before_closing(self) -> bool:
        """A running recording would end with the window: the person says whether it shall."""
        if self.live.recording_state == "off":
            return False
        if not self.teller.busy:
            self.teller.ask(
                Words(
                    self.tr("A recording is running."),
                    self.tr("Everything measured up to now is kept, whatever you choose."),
                    self.tr("Go on measuring, or stop: the session is saved and Carpus closes."),
                ),
                (
                    Answer(self.tr("Stop, save and close"), self.shell.close_surely, "S"),
                    Answer(self.tr("Go on measuring"), lambda: None, self.tr("Space")),
                ),
            )
        return True

    def close(self) -> None:
        """The window closes: finish what runs, in order, and wait for it."""
        self._camera_timer.stop()
        self.markers.end()
        self.review.end()
        recording = self.live.recording_state != "off"
        self.live.end()
        self.opener.close()
        self.background.wait()
        source, self.source = self.source, None
        if source is not None:
            if recording:
                self.live_events.finish(source.measuring)
            source.measuring.close()
