"""FHIR R4: the bundle is what the models of an independent library accept, and holds the session's own values."""

from __future__ import annotations

import base64
import json
from dataclasses import replace
from pathlib import Path

import pytest
from fhirclient.models.bundle import Bundle

from carpus.core.formats import fhir
from carpus.core.model.types import SIMULATED
from carpus.core.results.measure import summarise_values
from tests.formats.takes import build_take, hand_take, wrist_take
from tests.ui.fakes import session as flexing


def read_bundle(path: Path) -> dict[str, list]:  # type: ignore[type-arg]
    """Return the resources by type, after every one was built by its model, which checks names and types."""
    found: dict[str, list] = {}  # type: ignore[type-arg]
    for entry in Bundle(json.loads(path.read_text())).entry:
        found.setdefault(entry.resource.resource_type, []).append(entry.resource)
    return found


@pytest.mark.parametrize("protocol", ["wrist6", "hand21"])
def test_bundle_of_a_session_holds_each_measure_once(tmp_path: Path, protocol: str) -> None:
    take = build_take(flexing()) if protocol == "wrist6" else hand_take(tmp_path)
    resources = read_bundle(fhir.write(take, tmp_path / "out")[0])

    rows = [row for row in take.results.measures if row.group in ("range", "task")]
    observations = resources["Observation"]
    assert len(observations) == len(rows) > 0
    for row, observation in zip(rows, observations, strict=True):
        known = row.mean
        if known == known:
            assert observation.valueQuantity.value == pytest.approx(known, abs=5e-4)
            is_smallest = row.wrist_angle < 0 and row.quantity == "extension"
            limit = ("<=" if is_smallest else ">=") if row.is_lower_bound else None
            assert observation.valueQuantity.comparator == limit
        else:
            assert observation.dataAbsentReason.coding[0].code == "unknown"
        joint = observation.bodySite.text.partition(" ")[2]
        assert joint in ("wrist", "hand") or joint == row.subject.partition("_")[0]
    references = {entry["reference"] for entry in (item.as_json() for item in resources["DiagnosticReport"][0].result)}
    assert len(references) == len(rows)
    side = resources["BodyStructure"][0].locationQualifier[0].coding[0].display
    assert side.lower().startswith(take.results.side)


def test_measure_of_no_single_joint_is_of_the_hand(tmp_path: Path) -> None:
    take = wrist_take(tmp_path)
    subjects = ("rms", "reach", "TAM3", "PIP2_flexion, PIP3_flexion", "MCP3_flexion")
    rows = tuple(summarise_values("task", subject, "lag", "s", (1.0,)) for subject in subjects)
    take = replace(take, results=replace(take.results, measures=rows))
    found = [entry.bodySite.text for entry in read_bundle(fhir.write(take, tmp_path / "out")[0])["Observation"]]

    side = take.results.side
    assert found == [f"{side} hand"] * 4 + [f"{side} MCP3"]


def test_bundle_names_nobody_but_the_pseudonym(tmp_path: Path) -> None:
    take = wrist_take(tmp_path)
    patient = read_bundle(fhir.write(take, tmp_path / "out")[0])["Patient"][0].as_json()

    assert set(patient) == {"resourceType", "identifier"}
    assert patient["identifier"][0]["value"] == take.session.header.subject_id


def test_bundle_of_a_simulated_session_is_tagged_as_test_data(tmp_path: Path) -> None:
    take = wrist_take(tmp_path)
    assert not take.session.header.is_simulated
    assert all("meta" not in entry["resource"] for entry in fhir.build_bundle(take)["entry"])

    header = replace(take.session.header, parameters=json.dumps({"source": {SIMULATED: "yes"}}))
    simulated = replace(take, session=replace(take.session, header=header))
    resources = read_bundle(fhir.write(simulated, tmp_path / "simulated")[0])
    assert {one.meta.tag[0].code for found in resources.values() for one in found} == {"HTEST"}


def test_report_in_the_folder_is_attached(tmp_path: Path) -> None:
    (tmp_path / "one.pdf").write_bytes(b"%PDF-1.4 of this session")
    report = read_bundle(fhir.write(wrist_take(tmp_path), tmp_path)[0])["DiagnosticReport"][0]

    assert base64.b64decode(report.presentedForm[0].data) == b"%PDF-1.4 of this session"
