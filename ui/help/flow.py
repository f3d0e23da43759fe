"""The flow of the guide: the page of the screen that one is on, and back to it."""

from __future__ import annotations

from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.help.screen import HelpScreen


class HelpFlow(Flow):
    """Beside the way."""

    place = "help"
    screen: HelpScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, HelpScreen(context.theme))
        self.screen.back.clicked.connect(context.way.back)
        self.screen.told.connect(context.messages.fault)

    def show(self) -> None:
        way = self.context.way
        if way.may_aside():
            self.screen.start_folder = self.context.places.folder("reports")
            self.screen.show_page(way.here.guide)
            way.aside("help")
