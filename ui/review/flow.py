"""The flow of the review: which session, where one goes on from it, a frame as a picture of the hand."""

from __future__ import annotations

from pathlib import Path

from carpus.core.durable import replace_file
from carpus.core.errors import OutputNotWritable
from carpus.core.hand.exercises import exercise_named
from carpus.core.records.corrections import Corrections
from carpus.core.words import Words
from carpus.ui.export.flow import Exporting
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.messages.messages import Answer
from carpus.ui.review.hand_picture import HandPicture, draw_hand_picture
from carpus.ui.review.screen import ReviewScreen


class ReviewFlow(Flow):
    """One session of the patient who is open."""

    place, guide = "review", "figures"
    screen: ReviewScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ReviewScreen(context.theme, context.background, context.library))
        screen, way = self.screen, context.way
        self.exporting = Exporting(context)
        screen.told.connect(context.messages.fault)
        screen.report.connect(lambda session_id: way.show("report", session_id))
        screen.export.connect(self.exporting.ask)
        screen.hand_picture_wanted.connect(self.save_hand_picture)
        screen.beside.connect(lambda one, other: way.show("beside", one, other))
        screen.correct.connect(lambda *where: way.show("correct", *where))
        screen.result.connect(self.show)
        screen.result_wanted.connect(self._use_again)
        screen.charts.curves.menu.saved.connect(lambda path: self.note_made([path], [context.now.session_id]))

    def show(self, session_id: str = "", patient_id: str = "") -> None:
        """Show one session, ``patient_id`` of a patient who is not open; without one the newest, if there is any."""
        now, library = self.context.now, self.context.library
        if patient_id:
            self.open_patient(patient_id)
        assert now.patient is not None
        if not session_id:
            sessions = library.sessions(patient_id)
            if not sessions:
                return
            session_id = sessions[0].session_id
        now.session_id = session_id
        may_repeat = now.source is None or not now.source.measuring.starts_with_recording
        may_repeat &= bool(now.patient.patient_id)  # a file of nobody here has nobody to measure
        protocol = exercise_named(library.entry(session_id).exercise).protocol
        self.screen.begin(now.patient.patient_id, session_id, may_repeat=may_repeat, whole_hand=protocol.has_fingers)
        self.screen.charts.curves.menu.start_folder = self.context.places.folder("exports")
        self.context.way.go("review")

    def _use_again(self, session_id: str) -> None:
        def show(new: str) -> bool:
            way = self.context.way
            is_looked_at = self.context.now.session_id == session_id and way.behind == "review"
            if is_looked_at:
                way.show_behind("review", new)
            return is_looked_at

        def done(new: str) -> None:
            if show(new):
                said = Words(
                    self.tr("This result counts from now on."),
                    self.tr("The others stay as they were."),
                    self.tr("It stands there once more, as the newest."),
                )
                self.context.messages.ask(said, (Answer(self.tr("Go on"), lambda: None),), icon="good")

        def failed(fault: Exception) -> None:
            self.context.messages.fault(fault)
            show(session_id)  # it may be asked for once more

        self.run(lambda: Corrections(self.context.library).use_again(session_id), done, failed)

    def leave(self) -> None:
        self.screen.playing.stop()

    def close(self) -> None:
        self.screen.playing.stop()

    def show_research(self, *, on: bool) -> None:
        """Paths, places and speeds besides the angles, and all formats of an export."""
        self.screen.player.show_research(on=on)
        self.exporting.formats.show_research(on=on)

    def save_hand_picture(self, wanted: HandPicture) -> None:
        """Ask where, and write it; the name does not say whose hand it is."""
        library, head = self.context.library, wanted.session.header
        what = f"{head.exercise.lower().replace('_', '-')}_{head.hand}"
        name = f"carpus_{head.when:%Y-%m-%d_%H-%M}_{what}_{wanted.row}.png"
        path = self.ask_where_to_save("exports", name, self.tr("Save picture"), "PNG (*.png)")
        if path is None:
            return
        target = path if path.suffix.lower() == ".png" else path.with_name(f"{path.name}.png")

        def write() -> Path:
            frame = library.picture(head.session_id, wanted.row)
            image = None if frame is None else draw_hand_picture(self.context.theme, wanted, frame)
            if image is None:
                raise OutputNotWritable(target, self.tr("there is no picture of it"))

            def save(part: Path) -> None:
                if not image.save(str(part), "PNG"):  # type: ignore[call-overload]
                    raise OutputNotWritable(target)

            replace_file(target, save)
            return target

        self.run(write, lambda done: self.tell_made([done], [head.session_id]))
