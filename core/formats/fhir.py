"""FHIR R4: a session as a collection of patient, observations and a diagnostic report.

Each range of motion and task measure is an Observation of its mean. Codes are SNOMED CT where a concept is known for
certain, else a text; no LOINC code for movements of the wrist and the fingers is known to us. A ``NAME.pdf`` that
lies in the folder already is attached.
"""

from __future__ import annotations

import base64
import math
import re
from pathlib import Path
from typing import Any
from uuid import NAMESPACE_URL, uuid5

from carpus.core.formats.export_item import ExportItem
from carpus.core.formats.output_files import write_new_json
from carpus.core.platform.version import __version__
from carpus.core.results.measure import Measure
from carpus.core.results.session_results import SessionResults

SNOMED, UCUM = "http://snomed.info/sct", "http://unitsofmeasure.org"
EXTENSIONS = "http://hl7.org/fhir/StructureDefinition"
TERMINOLOGY = "http://terminology.hl7.org/CodeSystem"
RANGE_OF_MOTION = ("364564000", "Range of joint movement (observable entity)")
SIDES = {"left": ("7771000", "Left (qualifier value)"), "right": ("24028007", "Right (qualifier value)")}
WRIST = ("74670003", "Wrist joint structure (body structure)")
MCP = ("70420003", "Metacarpophalangeal joint structure (body structure)")
HAND = ("85562004", "Hand structure (body structure)")
_JOINT = re.compile(r"(MCP|PIP|DIP|CMC|IP)\d")
TEST_DATA = {"system": f"{TERMINOLOGY}/v3-ActReason", "code": "HTEST", "display": "test health data"}
"""Tag of every resource of a simulated session, in which nobody was measured."""
UNITS = {"deg": "deg", "deg/s": "deg/s", "mm": "mm", "s": "s", "1": "1", "%": "%"}
"""Units of measures that UCUM has a code for."""


def write(take: ExportItem, folder: Path) -> list[Path]:
    """Write ``NAME.fhir.json``; return its path."""
    report = folder / f"{take.name}.pdf"
    pdf = report.read_bytes() if report.is_file() else b""
    return [write_new_json(folder / f"{take.name}.fhir.json", build_bundle(take, pdf))]


def build_bundle(take: ExportItem, pdf: bytes = b"", record_number: str = "") -> dict[str, Any]:
    """Return a Bundle of a session: Patient, Device, BodyStructures, Observations, DiagnosticReport.

    The patient is the pseudonym of the session file, which knows no other name, and the ``record_number`` of a practice
    system that asked. ``pdf`` is the printed report.
    """
    results, header = take.results, take.session.header
    when = results.when.astimezone().isoformat(timespec="seconds")
    patient: dict[str, Any] = {
        "resourceType": "Patient",
        "identifier": [{"use": "secondary", "type": {"text": "Pseudonym"}, "value": header.subject_id or "unknown"}],
    }
    if record_number:
        known = {"use": "usual", "type": {"text": "Record number"}, "value": record_number}
        patient["identifier"] = [known, *patient["identifier"]]
    device = {
        "resourceType": "Device",
        "deviceName": [{"name": "Carpus", "type": "user-friendly-name"}],
        "version": [{"value": __version__}],
    }
    bundle = _Bundle(header.session_id, is_simulated=header.is_simulated)
    subject, measuring = bundle.add("patient", patient), bundle.add("device", device)
    common = {"subject": subject, "effectiveDateTime": when, "device": measuring}
    observations = [
        bundle.add(
            f"observation/{row.subject}/{row.quantity}/{row.is_passive}",
            _build_observation(row, results) | common | _locate(bundle, row, results, subject),
        )
        for row in results.measures
        if row.group in ("range", "task")
    ]
    report = {
        "resourceType": "DiagnosticReport",
        "status": "final",
        "code": {"text": f"Hand motion analysis: {results.exercise.id}"},
        "subject": subject,
        "effectiveDateTime": when,
        "result": observations,
    }
    if pdf:
        attachment = {"contentType": "application/pdf", "data": base64.b64encode(pdf).decode(), "title": take.name}
        report["presentedForm"] = [attachment]
    bundle.add("report", report)
    return {"resourceType": "Bundle", "type": "collection", "timestamp": when, "entry": bundle.entries}


class _Bundle:
    """Entries of a bundle that refer to one another by addresses made from the session's id."""

    def __init__(self, session_id: str, *, is_simulated: bool) -> None:
        self._session_id = session_id
        self._tags = {"meta": {"tag": [TEST_DATA]}} if is_simulated else {}
        self.entries: list[dict[str, Any]] = []

    def add(self, name: str, resource: dict[str, Any]) -> dict[str, str]:
        """Add a resource once and return a reference to it."""
        address = f"urn:uuid:{uuid5(NAMESPACE_URL, f'carpus/{self._session_id}/{name}')}"
        if all(entry["fullUrl"] != address for entry in self.entries):
            self.entries.append({"fullUrl": address, "resource": resource | self._tags})
        return {"reference": address}


def _build_observation(row: Measure, results: SessionResults) -> dict[str, Any]:
    value = row.mean
    observation: dict[str, Any] = {
        "resourceType": "Observation",
        "status": "final",
        "category": [{"coding": [{"system": f"{TERMINOLOGY}/observation-category", "code": "exam"}]}],
        "code": {"text": f"{row.subject} {row.quantity}, {'passive' if row.is_passive else 'active'}"},
        "method": {"text": f"Optical tracking of skin markers, {'smoother' if results.is_smoothed else 'filter'}"},
    }
    if row.group == "range":
        observation["code"]["coding"] = [_code(RANGE_OF_MOTION)]
    if not math.isfinite(value):
        absent = {"system": f"{TERMINOLOGY}/data-absent-reason", "code": "unknown"}
        return observation | {"dataAbsentReason": {"coding": [absent], "text": row.unknown_reason or "not measured"}}
    quantity: dict[str, Any] = {"value": round(value, 3), "unit": row.unit}
    if row.unit in UNITS:
        quantity |= {"system": UCUM, "code": UNITS[row.unit]}
    if row.comparator:
        quantity["comparator"] = row.comparator
    if math.isfinite(row.measurement_sd):
        quantity["extension"] = [
            {"url": f"{EXTENSIONS}/iso21090-uncertainty", "valueDecimal": round(row.measurement_sd, 3)},
            {"url": f"{EXTENSIONS}/iso21090-uncertaintyType", "valueCode": "N"},
        ]
    return observation | {"valueQuantity": quantity}


def _locate(bundle: _Bundle, row: Measure, results: SessionResults, subject: dict[str, str]) -> dict[str, Any]:
    """Return the body site of an observation, with its side in a BodyStructure."""
    joint = "wrist" if row.wrist_angle >= 0 else row.subject.partition("_")[0]
    joint = joint if joint == "wrist" or (_JOINT.fullmatch(joint) and "," not in row.subject) else "hand"
    code = {"wrist": WRIST, "hand": HAND}.get(joint) or (MCP if joint.startswith("MCP") else None)
    location: dict[str, Any] = {"text": joint} | ({"coding": [_code(code)]} if code else {})
    structure = {
        "resourceType": "BodyStructure",
        "location": location,
        "locationQualifier": [{"coding": [_code(SIDES[results.side])]}],
        "patient": subject,
    }
    reference = bundle.add(f"body/{joint}", structure)
    return {
        "extension": [{"url": f"{EXTENSIONS}/bodySite", "valueReference": reference}],
        "bodySite": location | {"text": f"{results.side} {joint}"},
    }


def _code(concept: tuple[str, str]) -> dict[str, str]:
    return {"system": SNOMED, "code": concept[0], "display": concept[1]}
