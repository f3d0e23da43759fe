"""Texts that say who a patient is."""

from __future__ import annotations

from datetime import date

from carpus.core.records.values import Patient
from carpus.core.results.norms import Person
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import tr


def birth_words(patient: Patient) -> str:
    """Return ``born 12 Mar 1981``; empty if unknown."""
    return tr("born {day}").format(day=numbers.format_date(patient.birth_day)) if patient.birth_day else ""


def to_person(patient: Patient | None, day: date) -> Person | None:
    """Return sex and age on a day, None if the age is not known."""
    if patient is None or patient.birth_day is None:
        return None
    born = patient.birth_day
    return Person(patient.sex, day.year - born.year - ((day.month, day.day) < (born.month, born.day)))


def record_number_words(patient: Patient) -> str:
    """Return ``No. 4711``; empty if there is none."""
    return tr("No. {number}").format(number=patient.record_number) if patient.record_number else ""


def identity_words(patient: Patient) -> str:
    """Return ``born 12 Mar 1981, female, No. 4711``."""
    sex = {"female": tr("female"), "male": tr("male"), "diverse": tr("other")}.get(patient.sex, "")
    return ", ".join(part for part in (birth_words(patient), sex, record_number_words(patient)) if part)


def printed_name(patient: Patient) -> str:
    """Return ``Erika Mustermann, born 12 Mar 1981, female, No. 4711``."""
    return ", ".join(part for part in (patient.name, identity_words(patient)) if part)
