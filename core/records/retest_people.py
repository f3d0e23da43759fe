"""Who takes part in the clinic's test and retest, and the study of them from what is stored."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from datetime import date

from carpus.core.agreement.limits_file import store_limits
from carpus.core.agreement.retest import Restated, RetestPlan, StudyFigures, as_if_complete, plan_of, restated
from carpus.core.errors import CarpusFault
from carpus.core.records.library import Library
from carpus.core.results.figures import SessionFigures


class RetestPeople:
    """Called in the background: reads sessions."""

    def __init__(self, library: Library) -> None:
        self._library = library

    def candidates(self) -> Sequence[tuple[str, str, int]]:
        """Everybody in the list of patients: identity, pseudonym, number of sessions."""
        return [
            (one.patient_id, one.entry.pseudonym, one.session_count)
            for one in sorted(self._library.patients.listed(), key=lambda one: one.entry.pseudonym.casefold())
        ]

    def chosen(self) -> Sequence[str]:
        return self._library.patients.taking_part()

    def choose(self, patient_ids: Sequence[str]) -> None:
        """Let these take part from now on. Raises the faults of writing."""
        self._library.patients.let_take_part(patient_ids)

    def exercises(self) -> Sequence[str]:
        """Those that were measured of anybody who takes part, most sessions first."""
        found = [entry.exercise for one in self.chosen() for entry in self._library.sessions(one)]
        return sorted(dict.fromkeys(found), key=lambda one: (-found.count(one), one))

    def plan(self, exercise: str, today: date) -> RetestPlan:
        """The study of one exercise as it stands."""
        chosen = set(self.chosen())
        people = [
            (patient_id, pseudonym, self._figures(patient_id, exercise))
            for patient_id, pseudonym, _ in self.candidates()
            if patient_id in chosen
        ]
        return plan_of(people, exercise, self._raters(), today)

    def patients(self, study: StudyFigures) -> Sequence[tuple[str, str]]:
        """Identity and pseudonym of those who take no part and of whom limits of this study may say something: with
        two sessions or more of its exercise."""
        taking_part, out = set(self.chosen()), []
        for patient_id, pseudonym, _ in self.candidates():
            if patient_id not in taking_part:
                own = [one for one in self._library.sessions(patient_id) if one.exercise == study.exercise]
                if sum(not one.simulated for one in own) > 1:
                    out.append((patient_id, pseudonym))
        return out

    def restated(self, patient_id: str, pseudonym: str, study: StudyFigures) -> Sequence[Restated]:
        """What is said of a patient today and would be by the limits of a study; reads the sessions."""
        figures = self._figures(patient_id, study.exercise)
        return restated(pseudonym, figures, as_if_complete(study.study(date.min.isoformat())))

    def _figures(self, patient_id: str, exercise: str) -> list[SessionFigures]:
        figures = []
        for entry in self._library.sessions(patient_id):
            if entry.exercise == exercise:
                with suppress(CarpusFault):  # a damaged file takes no part; opening it alone tells
                    figures.append(self._library.figures(entry))
        return figures

    def _raters(self) -> dict[str, str]:
        """Initials of who recorded each session."""
        people = [entry for one in self.chosen() for entry in self._library.sessions(one)]
        return {entry.session_id: entry.by for entry in people if entry.by}

    def store(self, study: StudyFigures, today: date) -> None:
        """Put the limits of a study into force, as ``carpus retest --store`` does. Raises the faults of writing."""
        store_limits(self._library.folder, [study.study(today.isoformat())])
        self._library.limits_changed()
