"""The PDF, read back by poppler's tools: text, fonts, pages; and its faults."""

from __future__ import annotations

import json
import pickle
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from carpus.core.calibration.result import CalibrationFinding
from carpus.core.model.errors import OutputExists, OutputNotWritable
from carpus.core.results.repetition_rows import RepetitionChoices
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


def test_foot_says_by_which_revision_and_of_which_recording(tmp_path: Path) -> None:
    made = session()
    said = {"provenance": {"revision": "0123456789" * 4}, "source": {"sha256": "ab12" + "0" * 56 + "cd34"}}
    header = replace(made.header, parameters=json.dumps(said), software_version="10.11.12")
    path = write_session_report(replace(made, header=header), tmp_path / "foot.pdf")
    foot, research = read_words(path, 1), read_words(path, 2)
    assert "Carpus 10.11.12" in foot
    assert "ab12" not in foot, "digests are on the page for research"
    assert "revision 0123456" in research
    assert "recording ab12…cd34" in research
    assert "live values, not smoothed" in foot, "the end of the line is on the page"
    (*_, end) = re.findall(r'xMax="([\d.]+)"[^>]*>live</word>', tool("pdftotext", "-bbox", "-l", "1", str(path), "-"))
    assert float(end) <= 595.0 - 42.0, "nothing leaves the margin on the right"


def test_simulated_and_doubtful_session_says_so_and_shows_its_targets(report: Path, tmp_path: Path) -> None:
    stored = session()
    parameters = json.dumps({"source": {"simulated": "yes"}, "set_up": {"targets_deg": [45.0, -30.0]}})
    verdict = replace(stored.calibration.verdict, findings=(CalibrationFinding("tilt", (), 22.0, 15.0, "deg"),))
    stored = replace(
        stored,
        header=replace(stored.header, parameters=parameters),
        calibration=replace(stored.calibration, verdict=verdict),
    )
    doubted, usual = read_words(write_session_report(stored, tmp_path / "report.pdf")), read_words(report)
    for words in (
        "Simulated data: no patient was measured.",
        "Measured although uncertain: The hand is tilted 22° to the camera",
        "Warning at the top of the page",
        "Flexion 45°, Extension 30°",
        "dashed: goal",
    ):
        assert words in doubted
        assert words not in usual


def test_long_names_and_reasons_and_many_warnings_make_the_page_smaller_and_nothing_is_lost(tmp_path: Path) -> None:
    stored, pseudonym = session(), "Blue Hummingbird Mountain 42 and more of"
    markers = stored.header.protocol.markers
    findings = tuple(CalibrationFinding("residual", (name,), 5.0, 2.0, "mm") for name in markers)
    findings += (CalibrationFinding("tilt", (), 22.0, 15.0, "deg"), CalibrationFinding("distance", (), 1.22, 1.1, "m"))
    doubtful = replace(stored.calibration, verdict=replace(stored.calibration.verdict, findings=findings))
    choices = RepetitionChoices(dict.fromkeys(range(4), "pain, and looked away from the screen"))
    made = replace(stored, calibration=doubtful)
    path = write_session_report(made, tmp_path / "x.pdf", choices=choices, pseudonym=pseudonym)
    assert count_pages(path) == 2
    words = read_words(path)
    assert words.count("from its expected position") == len(markers)
    for kept in (pseudonym, LEGAL_SENTENCE, f"Session {stored.header.session_id[:8]}"):
        assert kept in words
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

    monkeypatch.setattr("carpus.ui.report.page.Page.paint", refuse)
    with pytest.raises(RuntimeError, match="no page"):
        write_session_report(short, tmp_path / "x.pdf")
    assert [path.name for path in tmp_path.iterdir()] == ["there.pdf"]
    assert there.read_bytes() == b"mine"


class Killed(BaseException):
    """Stands for a SIGKILL."""


def test_kill_leaves_no_half_report_and_next_one_is_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    output = tmp_path / "out.pdf"

    def killed(half: Path, _: Path) -> None:
        assert half.read_bytes().rstrip().endswith(b"%%EOF")
        raise Killed

    with monkeypatch.context() as patched:
        patched.setattr("os.link", killed)
        with pytest.raises(Killed):
            write_session_report(session(), output)
    assert not output.exists()
    write_session_report(session(), output)
    assert [path.name for path in tmp_path.iterdir()] == ["out.pdf"]


def test_report_is_written_without_any_display(tmp_path: Path) -> None:
    program = (
        "import pickle, sys; from pathlib import Path\n"
        "from tests.ui.printed import write_session_report\n"
        "write_session_report(pickle.loads(Path(sys.argv[1]).read_bytes()), Path(sys.argv[2]))"
    )
    (tmp_path / "session").write_bytes(pickle.dumps(session(seconds=12.0)))
    subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "session"), str(tmp_path / "x.pdf")],
        cwd=ROOT, capture_output=True, text=True, check=True, env={"PATH": "/usr/bin:/bin"},
    )  # fmt: skip
    assert (tmp_path / "x.pdf").stat().st_size > 10_000


@pytest.mark.parametrize("code", ["en", "de", "it"])
def test_report_words_do_not_overlap_in_any_language(tmp_path: Path, code: str) -> None:
    said = build_session_report(session(), language=code)
    pauses = {"pauses": 1.2, "pause time": 10.2}
    rows = [replace(row, mean=pauses.get(row.quantity, row.mean)) for row in said.results.measures]
    said = replace(said, results=replace(said.results, measures=tuple(rows)))
    assert overlapping_words(write_session_report(said, tmp_path / "x.pdf")) == []
