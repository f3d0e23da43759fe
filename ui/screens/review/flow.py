"""Flow of the review: which session is shown, and what follows from it."""

from __future__ import annotations

from pathlib import Path

from carpus.core.model.errors import OutputNotWritable
from carpus.core.model.fault_text import MessageText
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.platform.durable import replace_file
from carpus.core.records.corrections import Corrections
from carpus.ui.screens.export.flow import ExportController
from carpus.ui.screens.review.frame_view import HandImage, draw_hand_image
from carpus.ui.screens.review.screen import ReviewScreen
from carpus.ui.shell.flow import Flow, ScreenContext
from carpus.ui.shell.messages import Answer


class ReviewFlow(Flow):
    """Flow of one session of the open patient."""

    screen_name, guide_page = "review", "figures"
    screen: ReviewScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ReviewScreen(context.theme, context.background, context.library))
        screen, way = self.screen, context.navigator
        self.exporting = ExportController(context)
        screen.fault_raised.connect(context.messages.show_fault)
        screen.hand_image_requested.connect(self.save_hand_image)
        screen.correction_requested.connect(lambda *where: way.open_screen("correct", *where))
        card, versions = screen.card, screen.card.tables.versions
        card.report_button.clicked.connect(lambda: way.open_screen("report", screen.session_id))
        card.export_button.clicked.connect(lambda: self.exporting.choose_formats(screen.session_id))
        card.compare_button.clicked.connect(lambda: way.open_screen("comparison", screen.session_id, card.partner_id))
        card.repeat_button.clicked.connect(lambda: way.open_screen("live"))
        versions.chosen.connect(self.open)
        versions.restore_requested.connect(self._restore_version)
        screen.charts.curves.menu.saved.connect(
            lambda path: self.register_exports([path], [context.current.session_id])
        )

    def open(self, session_id: str = "", patient_id: str = "") -> None:
        """Show a session, by default the newest one; ``patient_id`` if the patient is not open."""
        now, library = self.context.current, self.context.library
        if patient_id:
            self.open_patient(patient_id)
        assert now.patient is not None
        if not session_id:
            sessions = library.sessions(patient_id)
            if not sessions:
                return
            session_id = sessions[0].session_id
        now.session_id = session_id
        may_repeat = now.source is None or not now.source.measuring.is_playback
        may_repeat &= bool(now.patient.patient_id)  # a file of nobody here has nobody to measure
        protocol = get_exercise(library.entry(session_id).exercise).protocol
        self.screen.card.tables.patient = now.patient
        self.screen.load_session(
            now.patient.patient_id, session_id, may_repeat=may_repeat, whole_hand=protocol.has_fingers
        )
        self.screen.charts.curves.menu.start_folder = self.context.recent_locations.folder("exports")
        self.context.navigator.switch_screen("review")

    def _restore_version(self, session_id: str) -> None:
        def show_version(new: str) -> bool:
            way = self.context.navigator
            is_looked_at = self.context.current.session_id == session_id and way.underlying_screen == "review"
            if is_looked_at:
                way.open_under_overlay("review", new)
            return is_looked_at

        def report_restored(new: str) -> None:
            if show_version(new):
                text = MessageText(
                    self.tr("This result is used from now on."),
                    self.tr("The other results were not changed."),
                    self.tr("The result was saved again as the newest one."),
                )
                self.context.messages.show_question(text, (Answer(self.tr("Continue"), lambda: None),), icon="good")

        def report_failure(fault: Exception) -> None:
            self.context.messages.show_fault(fault)
            show_version(session_id)  # it may be asked for once more

        self.run(lambda: Corrections(self.context.library).restore_version(session_id), report_restored, report_failure)

    def on_leave(self) -> None:
        self.screen.playing.stop()

    def close(self) -> None:
        self.screen.playing.stop()

    def show_research(self, *, on: bool) -> None:
        """Offer all export formats."""
        self.exporting.dialog.show_research(on=on)

    def save_hand_image(self, hand_image: HandImage) -> None:
        """Ask where to save the image and write it; the file name does not name the patient."""
        library, head = self.context.library, hand_image.session.header
        what = f"{head.exercise.lower().replace('_', '-')}_{head.hand}"
        name = f"carpus_{head.recording_time:%Y-%m-%d_%H-%M}_{what}_{hand_image.row}.png"
        path = self.choose_save_path("exports", name, self.tr("Save image"), "PNG (*.png)")
        if path is None:
            return
        target = path if path.suffix.lower() == ".png" else path.with_name(f"{path.name}.png")

        def write() -> Path:
            frame = library.read_frame(head.session_id, hand_image.row)
            image = None if frame is None else draw_hand_image(self.context.theme, hand_image, frame)
            if image is None:
                raise OutputNotWritable(target, self.tr("no frame of this session was saved"))

            def save(part: Path) -> None:
                if not image.save(str(part), "PNG"):  # type: ignore[call-overload]
                    raise OutputNotWritable(target)

            replace_file(target, save)
            return target

        self.run(write, lambda done: self.announce_exports([done], [head.session_id]))
