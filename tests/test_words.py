"""Every fault and every finding has words, and the words keep the rules of the house."""

from __future__ import annotations

import importlib
import pkgutil
import re
import string
from itertools import product

import pytest

import carpus.core
from carpus.core.calibration.result import (
    FINDING_TEXTS,
    CalibrationFinding,
    finding_sentence,
    finding_words,
)
from carpus.core.model.errors import CarpusFault
from carpus.core.model.fault_text import format_fault, format_fault_line, join_marker_names, marker_name
from carpus.core.model.hand.protocols import HAND21
from tests.fault_page import PAGE, all_faults, fault_page

JARGON = re.compile(r"\b(exception|abort|aborted|null|None|nan)\b", re.IGNORECASE)
"""Words of programmers, which no clinician reads."""


def all_kinds() -> set[type[CarpusFault]]:
    """Faults are defined in core.model.errors, but a kind that hides in another module is found too."""
    for module in pkgutil.walk_packages(carpus.core.__path__, "carpus.core."):
        importlib.import_module(module.name)
    return {kind for kind in all_faults() if kind.__module__.startswith("carpus.core.")}


KINDS = sorted(all_faults(), key=lambda kind: kind.__name__)


def texts() -> list[str]:
    spoken = [text for kind in KINDS for text in (kind.summary, kind.data_safety, kind.remedy)]
    return spoken + [text for words in FINDING_TEXTS.values() for text in words]


def test_fault_classes_state_summary_and_remedy() -> None:
    assert set(KINDS) == all_kinds()
    assert [kind.__name__ for kind in KINDS if not {"summary", "remedy"} <= vars(kind).keys()] == []


def test_fault_classes_state_data_safety() -> None:
    assert not hasattr(CarpusFault, "data_safety")
    assert [kind.__name__ for kind in KINDS if "data_safety" not in vars(kind)] == []
    nothing_lost = {kind.__name__ for kind in KINDS if "othing is lost" in kind.data_safety}
    assert nothing_lost <= {
        "ClickOutsideImage", "ClickOnNoMarker", "MarkerWithoutDepth", "CalibrationImpossible", "CameraUnknown",
        "CameraMissing", "CameraBusy", "CameraPermission", "PinUncheckable",
    }  # fmt: skip


def test_fault_codes_each_class_has_one_of_its_own() -> None:
    assert [kind.__name__ for kind in KINDS if not re.fullmatch(r"C-\d{3}", vars(kind).get("code", ""))] == []
    assert len({kind.code for kind in KINDS}) == len(KINDS)
    assert all(kind.title for kind in KINDS)
    assert all(kind.code in str(kind("x")) for kind in KINDS), "the log has it"


def test_fault_page_is_that_of_the_classes() -> None:
    assert PAGE.read_text(encoding="utf-8") == fault_page(), "python -m tests.fault_page"


SUPPORT = re.compile(r"carpus [a-z]|--\w|\.yaml|\.json|\bpip\b|\bsudo\b|chmod|[“„]")


def test_fault_sentences_for_clinicians_name_no_command_or_file_of_the_program() -> None:
    assert [text for text in texts() if SUPPORT.search(text)] == []


def test_fault_summaries_are_unique() -> None:
    assert len({kind.summary for kind in KINDS}) == len(KINDS)


FACTS = {"subject", "detail", "markers", "first", "second", "value", "limit", "unit"}


def keeps_the_rules(text: str) -> bool:
    named = {name for _, name, _, _ in string.Formatter().parse(text) if name}
    begins = text[0].isupper() or text.startswith("{")
    return not JARGON.search(text) and begins and text.endswith(".") and len(text) < 120 and named <= FACTS


def test_fault_texts_follow_wording_rules() -> None:
    assert [text for text in texts() if not keeps_the_rules(text)] == []
    assert not any(map(keeps_the_rules, ("A null value.", "small.", "No stop", "x" * 121, "A {thing}.")))


def test_format_fault_with_or_without_facts_is_a_sentence() -> None:
    for kind, facts in product(KINDS, (("/a/place", "line 7"), ("/a/place",), (), ("", "line\n7"))):
        words, line = format_fault(kind(*facts)), format_fault_line(kind(*facts))
        for text in (words.summary, words.data_safety, words.remedy, line):
            assert not re.search(r"\(\)|  | [.;:,)]|[{}]|\n", text), text
            assert not re.search(r"\b(for|at|to|in|named|the)[.;,]", text), text
        assert line.removesuffix(f" ({kind.code})").endswith("."), kind
        assert words.remedy[1:] in line, kind
    for kind in KINDS:
        assert "{odd}" in format_fault_line(kind("{odd}", "{odd}")) or "{subject}" not in kind.summary, kind
        if kind.__name__.startswith(("Recording", "Picture", "Output", "Clicks", "Session", "DiskFull", "CameraFile")):
            assert "/a/place" in format_fault_line(kind("/a/place", "line 7")), kind


def test_marker_names_are_clinical() -> None:
    called = {
        "WRIST": "wrist", "MCP1": "thumb MCP", "IP1": "thumb IP", "DIP3": "middle finger DIP",
        "TIP4": "ring fingertip", "elsewhere": "elsewhere", "CMC1": "thumb CMC", "MCP2": "index MCP",
        "MCP3": "middle finger MCP", "MCP4": "ring finger MCP", "MCP5": "little finger MCP",
    }  # fmt: skip
    assert {name: marker_name(name) for name in called} == called
    assert (join_marker_names(("MCP4",)), join_marker_names(())) == ("ring finger MCP", "")
    assert len({marker_name(name) for name in HAND21.markers}) == 21


@pytest.mark.parametrize("kind", FINDING_TEXTS)
def test_findings_state_marker_and_number(kind: str) -> None:
    finding = CalibrationFinding(kind, ("MCP2", "MCP3"), 22.26, 15.0, "mm")
    words = finding_words(finding)
    assert words.summary[0].isupper()
    assert "{" not in words.summary
    if "{value}" in FINDING_TEXTS[kind][0]:
        assert "22.3" in words.summary
        assert "15" in words.summary
    if "{markers}" in FINDING_TEXTS[kind][0]:
        assert "ndex and middle finger MCP" in words.summary
    line = finding_sentence(finding)
    assert line.endswith(words.remedy[1:])
    assert "\n" not in line
