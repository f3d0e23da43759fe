"""The flow of two sessions side by side: which two, and from where."""

from __future__ import annotations

from carpus.ui.background import Background
from carpus.ui.beside.screen import BesideScreen
from carpus.ui.flow import Flow, ScreenContext


class BesideFlow(Flow):
    """``back_to`` is where one came from."""

    place, guide, tab = "beside", "sessions", "review"
    screen: BesideScreen

    def __init__(self, context: ScreenContext) -> None:
        self._background = Background()  # its own: what the list still reads holds up no picture
        super().__init__(context, BesideScreen(context.theme, self._background, context.library))
        self.back_to = "sessions"
        self.screen.told.connect(context.messages.fault)

    def show(self, one: str, other: str) -> None:
        """Show two sessions; Back leads to where one is now."""
        if self.context.way.place != "beside":
            self.back_to = self.context.way.place
        patient = self.context.now.patient
        self.screen.begin((one, other), patient.side if patient is not None else "")
        self.context.way.go("beside")

    def up(self) -> None:
        patient = self.context.now.patient
        if self.back_to == "review" or patient is None:
            self.to_session()
        else:
            self.context.way.show("sessions", patient.patient_id)

    def leave(self) -> None:
        self.screen.playing.stop()

    def close(self) -> None:
        self.screen.playing.stop()
        self._background.wait()

    def sign_lines(self) -> list[str]:
        both = None if self.context.now.is_practice else self.screen.both
        simulated = both is not None and (both.first.simulated or both.second.simulated)
        return [self.tr("Simulated hand: this is not a patient’s, and does not count.")] if simulated else []
