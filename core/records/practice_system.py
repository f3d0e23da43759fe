"""Patients whom a practice system sends: found by record number, or added."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from carpus.core.formats.gdt import GdtRequest
from carpus.core.records.patients import Patients
from carpus.core.records.values import Patient

UNREADABLE_SUFFIX = ".unreadable"


def save_requested_patient(patients: Patients, request: GdtRequest) -> Patient:
    """Return the patient of a request, with the identity that the practice system knows.

    A patient is recognised by the record number. A new one gets a random pseudonym; of a known one name, birth date and
    sex follow the request where it states them. Raises what :meth:`Patients.save` does.
    """
    name = " ".join(filter(None, (request.first_name, request.last_name)))
    known = patients.id_of_record_number(request.number)
    patient = patients.get(known) if known else Patient(patients.suggest_pseudonym(), "both")
    stated = replace(
        patient,
        record_number=request.number,
        name=name or patient.name,
        birth_day=request.birth_date or patient.birth_day,
        sex=request.sex or patient.sex,
    )
    return patients.get(patients.save(stated)) if stated != patient else patient


def set_aside(path: Path) -> None:
    """Rename a file that cannot be read, so that it is not read again. Raises OSError."""
    path.replace(path.with_name(path.name + UNREADABLE_SUFFIX))
