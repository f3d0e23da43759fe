"""The PDF, read back by poppler's tools: text, fonts, pages; and its faults."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from carpus.core.calibration.result import CalibrationFinding
from carpus.core.model.errors import OutputExists, OutputNotWritable
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.ui.report.page import save_pdf
from carpus.ui.report.session_page import build_session_report
from carpus.ui.words.terms import LEGAL_SENTENCE
from tests.ui.fakes import FakeSessions, figures_once, session
from tests.ui.printed import (
    count_pages,
    measure_reach,
    overlapping_words,
    read_words,
    tool,
    write_session_report,
)

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    store = FakeSessions()
    path = tmp_path_factory.mktemp("report") / "linden.pdf"
    choices = RepetitionChoices({6: "pain"})
    return write_session_report(
        store.session("session-7"), path, choices=choices, history=store.history("linden"), therapist="M. R."
    )


def test_report_is_two_pages_of_a4_in_embedded_fonts_and_vectors(report: Path) -> None:
    assert count_pages(report) == 2
    assert "A4" in tool("pdfinfo", str(report))
    fonts = tool("pdffonts", str(report)).splitlines()[2:]
    assert fonts
    for line in fonts:
        assert line.startswith("CarpusInter")
        embedded, _, unicode_map = line.split()[-5:-2]
        assert (embedded, unicode_map) == ("yes", "yes")
    assert tool("pdfimages", "-list", str(report)).splitlines()[2:] == []
    first, second = (read_words(report, page).split() for page in (1, 2))
    assert {"Radial", "Ulnar", "Rotation"} <= set(first)
    assert {"mm/s", "+100°/s", "Rotation"} <= set(second)
    assert overlapping_words(report) == []
    paths = [tool("pdftocairo", "-svg", "-f", page, "-l", page, str(report), "-").count("<path") for page in "12"]
    assert min(paths) > 400, "about 70 and 240 of them are the plots'"


def test_values_on_page_are_those_of_session(report: Path) -> None:
    words = read_words(report)
    figures = figures_once(FakeSessions().session("session-7"), RepetitionChoices({6: "pain"}))
    for row in figures.wrist_ranges:
        assert f"{row.mean:.0f}° ± {max(1, round(row.sd))}°" in words
    assert "mean of 8 repetitions; repetition 7 excluded: pain" in words
    assert "within MDC (14°)" in words
    assert "Linden 42" in words
    assert "20 Nov 2026, 11:36" in words
    assert re.search(r"2 ?/ ?3", words)
    assert "Repetition 7 stopped for pain." in words
    assert words.count(LEGAL_SENTENCE) == 2, "word for word on each page"


def test_doubtful_session_says_all_on_a_smaller_page(report: Path, tmp_path: Path) -> None:
    stored, pseudonym = session(), "Blue Hummingbird Mountain 42 and more of"
    markers = stored.header.protocol.markers
    said = {
        "provenance": {"revision": "0123456789" * 4},
        "source": {"simulated": "yes", "sha256": "ab12" + "0" * 56 + "cd34"},
        "set_up": {"targets_deg": [45.0, -30.0]},
    }
    findings = tuple(CalibrationFinding("residual", (name,), 5.0, 2.0, "mm") for name in markers)
    findings += (CalibrationFinding("tilt", (), 22.0, 15.0, "deg"), CalibrationFinding("distance", (), 1.22, 1.1, "m"))
    made = replace(
        stored,
        header=replace(stored.header, parameters=json.dumps(said), software_version="10.11.12"),
        calibration=replace(stored.calibration, verdict=replace(stored.calibration.verdict, findings=findings)),
    )
    choices = RepetitionChoices(dict.fromkeys(range(4), "pain, and looked away from the screen"))
    path = write_session_report(made, tmp_path / "x.pdf", choices=choices, pseudonym=pseudonym)
    assert count_pages(path) == 2
    first, research, usual = read_words(path, 1), read_words(path, 2), read_words(report)
    for words in (
        "Simulated data: no patient was measured.", "The hand is tilted 22° to the camera",
        "Warning at the top of the page", "Flexion 45°, Extension 30°", "dashed: goal",
    ):  # fmt: skip
        assert words in first
        assert words not in usual
    assert first.count("from its expected position") == len(markers)
    for kept in (pseudonym, LEGAL_SENTENCE, f"Session {stored.header.session_id[:8]}", "Carpus 10.11.12"):
        assert kept in first
    assert "ab12" not in first, "digests are on the page for research"
    assert "revision 0123456" in research
    assert "recording ab12…cd34" in research
    assert "live values, not smoothed" in first, "the end of the last line"
    left, _, right, foot = measure_reach(path)
    assert left >= 42.52 - 2.0
    assert right <= 595.28 - 42.52 + 2.0
    assert foot < 841.9 - 28.3, "a centimetre of margin"


def test_session_without_any_tracked_frame_still_gives_honest_page(tmp_path: Path) -> None:
    path = write_session_report(session(seconds=10.0, lost=[(0.0, 99.0)]), tmp_path / "x.pdf")
    words = read_words(path)
    assert "No range of motion could be measured." in words
    assert "0.0 % of" in words
    assert "of an angle is about" not in words, "nothing is known"


def test_report_failure_leaves_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    there = tmp_path / "there.pdf"
    there.write_bytes(b"mine")
    short = session(seconds=10.0)
    with pytest.raises(OutputExists):
        write_session_report(short, there)
    with pytest.raises(OutputNotWritable):
        write_session_report(short, tmp_path / "no" / "x.pdf")

    def refuse(*_: object) -> None:
        raise RuntimeError("no page")

    with monkeypatch.context() as killed:
        killed.setattr("os.link", refuse)
        with pytest.raises(RuntimeError, match="no page"):
            save_pdf(tmp_path / "x.pdf", b"whole")
    monkeypatch.setattr("carpus.ui.report.page.Page.paint", refuse)
    with pytest.raises(RuntimeError, match="no page"):
        write_session_report(short, tmp_path / "x.pdf")
    assert [path.name for path in tmp_path.iterdir()] == ["there.pdf"]
    assert there.read_bytes() == b"mine"


def test_report_is_written_without_any_display() -> None:
    program = "from carpus.ui.report.page import ensure_application; print(ensure_application().platformName())"
    environment = {"PATH": "/usr/bin:/bin"}
    done = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, env=environment)
    assert done.stdout == "offscreen\n"


@pytest.mark.parametrize("code", ["de", "it"])
def test_report_words_do_not_overlap_in_a_longer_language(tmp_path: Path, code: str) -> None:
    said = build_session_report(session(), language=code)
    pauses = {"pauses": 1.2, "pause time": 10.2}
    rows = [replace(row, mean=pauses.get(row.quantity, row.mean)) for row in said.results.measures]
    said = replace(said, results=replace(said.results, measures=tuple(rows)))
    assert overlapping_words(write_session_report(said, tmp_path / "x.pdf")) == []
