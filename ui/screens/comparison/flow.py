"""Controller of the comparison of two sessions."""

from __future__ import annotations

from carpus.ui.kit.background import Background
from carpus.ui.screens.comparison.screen import ComparisonScreen
from carpus.ui.shell.flow import Flow, ScreenContext


class ComparisonFlow(Flow):
    """Controller of the comparison; ``origin`` is the screen it was opened from."""

    screen_name, guide_page, parent_tab = "comparison", "sessions", "review"
    screen: ComparisonScreen

    def __init__(self, context: ScreenContext) -> None:
        self._background = Background()  # a slow read of the session list must not delay frames
        super().__init__(context, ComparisonScreen(context.theme, self._background, context.library))
        self.origin = "sessions"
        self.screen.fault_raised.connect(context.messages.show_fault)

    def open(self, one: str, other: str) -> None:
        """Compare two sessions; Back returns to the current screen."""
        if self.context.navigator.screen_name != "comparison":
            self.origin = self.context.navigator.screen_name
        patient = self.context.current.patient
        self.screen.load_sessions((one, other), patient.side if patient is not None else "")
        self.context.navigator.switch_screen("comparison")

    def navigate_back(self) -> None:
        patient = self.context.current.patient
        if self.origin == "review" or patient is None:
            self.return_to_session()
        else:
            self.context.navigator.open_screen("sessions", patient.patient_id)

    def on_leave(self) -> None:
        self.screen.playing.stop()

    def close(self) -> None:
        self.screen.playing.stop()
        self._background.join()

    def banner_lines(self) -> list[str]:
        both = None if self.context.current.is_practice else self.screen.comparison
        simulated = both is not None and (both.first.is_simulated or both.second.is_simulated)
        return [self.tr("Simulated data: no patient was measured. Excluded from analysis.")] if simulated else []
