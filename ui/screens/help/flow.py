"""Controller of the help, which opens at the page of the current screen."""

from __future__ import annotations

from carpus.ui.screens.help.screen import HelpScreen
from carpus.ui.shell.flow import Flow, ScreenContext


class HelpFlow(Flow):
    """Controller of the help, an overlay."""

    screen_name = "help"
    screen: HelpScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, HelpScreen(context.theme))
        self.screen.back_button.clicked.connect(context.navigator.navigate_back)
        self.screen.fault_raised.connect(context.messages.show_fault)

    def open(self) -> None:
        way = self.context.navigator
        if way.can_open_overlay():
            self.screen.start_folder = self.context.recent_locations.folder("reports")
            self.screen.show_page(way.current_flow.guide_page)
            way.open_overlay("help")
