"""Therapists of the clinic: who they are, and who works now."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress

from PySide6.QtCore import QObject

from carpus.core.model.errors import CarpusFault
from carpus.core.records.clinic_records import read_therapists, save_therapists
from carpus.core.records.values import Therapist, read_or_default
from carpus.ui.screens.settings.therapist_card import TherapistCard
from carpus.ui.shell.flow import ScreenContext


class TherapistController(QObject):
    """The list in the store, and the initials of who works now, which the top bar and the lock ask for."""

    def __init__(self, context: ScreenContext, initials: Callable[[], str], choose: Callable[[str], None]) -> None:
        """Put the initials of earlier settings into an empty list; a therapist removed elsewhere is chosen no more.

        ``initials`` returns who works, ``choose`` saves it.
        """
        super().__init__(context.window)
        self._context, self._initials, self._choose = context, initials, choose
        self.card = TherapistCard(context.theme)
        self.card.changed.connect(self._save)
        self._button = context.window.top_bar.therapist_button
        self._button.menu().aboutToShow.connect(self._fill_menu)
        self._shown: Sequence[Therapist] = ()
        with suppress(CarpusFault):
            listed = [one.initials for one in read_therapists(context.library.store)]
            if initials() and not listed:
                save_therapists(context.library.store, [Therapist(initials())])
            elif initials() and initials() not in listed:
                choose("")
        context.navigator.screen_changed.connect(lambda name: self._show_list() if name == "settings" else None)
        context.window.top_bar.show_therapist(initials())

    def list_therapists(self) -> list[Therapist]:
        """Return all therapists; none while the clinic's server is away."""
        return read_or_default(lambda: read_therapists(self._context.library.store), [])

    @property
    def current(self) -> str:
        """Initials of who works now."""
        return self._initials()

    def choose(self, initials: str) -> None:
        """Set who works now."""
        if initials != self._initials():
            self._choose(initials)
            self._context.window.top_bar.show_therapist(initials)

    def _show_list(self) -> None:
        self._shown = self.list_therapists()
        self.card.show_therapists(self._shown)

    def _fill_menu(self) -> None:
        menu = self._button.menu()
        menu.clear()
        for one in self.list_therapists():
            action = menu.addAction(" · ".join(part for part in (one.initials, one.name) if part))
            action.setCheckable(True)
            action.setChecked(one.initials == self._initials())
            action.triggered.connect(lambda _=False, initials=one.initials: self.choose(initials))
        menu.addSeparator()
        menu.addAction(self.tr("Edit the list…")).triggered.connect(
            lambda: self._context.navigator.open_screen("settings", "report")
        )

    def _save(self, therapists: Sequence[Therapist]) -> None:
        """Save the list; the only one in it works now."""
        try:
            save_therapists(self._context.library.store, therapists, self._shown)
        except CarpusFault as fault:
            self._context.messages.show_fault(fault)
            return
        self._shown = therapists
        listed = [one.initials for one in self.list_therapists()]
        if len(listed) == 1 or self._initials() not in listed:
            self.choose(listed[0] if len(listed) == 1 else "")
