"""The report as the clinic's own, read back by poppler: letterhead, paper, parts, comment, sentences."""

from __future__ import annotations

import re
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import pytest
from PySide6.QtGui import QColor, QImage, QPageSize
from PySide6.QtPrintSupport import QPrinter
from PySide6.QtWidgets import QVBoxLayout

from carpus.app.session_commands import read_report_form
from carpus.core.measures.manual_measurements import ManualValue
from carpus.core.model.errors import ConcurrentChange
from carpus.core.model.phrase import phrase
from carpus.core.records.clinic_records import read_form, save_form
from carpus.core.records.store import Store
from carpus.core.records.values import Patient
from carpus.core.results.report_form import PAPER_PT, Letterhead, ReportForm
from carpus.ui.kit import numbers
from carpus.ui.kit.language import use_language
from carpus.ui.kit.layouts import STRETCH
from carpus.ui.kit.table import TableColumn
from carpus.ui.report import session_page
from carpus.ui.report.home_page import build_home_progress
from carpus.ui.report.letter_page import LetterReport
from carpus.ui.report.page import column, legal_line, paged_table, write_report
from carpus.ui.report.page import layout_pages as pages_of_report
from carpus.ui.report.progress_page import build_progress_report
from carpus.ui.report.session_page import SECTIONS, ReportSection, SessionReport, build_session_report
from carpus.ui.screens.report.panel import fill_sentence
from carpus.ui.screens.report.screen import PAGE_SIZES, default_file_name, make_printer, print_pages
from carpus.ui.screens.settings.report_card import LogoError, logo_png
from carpus.ui.words.patient import task_words
from carpus.ui.words.session import warning_lines
from carpus.ui.words.terms import LEGAL_SENTENCE
from tests.results.days import with_ranges
from tests.ui.fakes import FakeSessions, home_report
from tests.ui.hand_fakes import FakeHandSessions
from tests.ui.printed import count_pages, measure_reach, page_words, read_words, tool, write_session_report

LONG = "\n".join(f"Line {number} of what the therapist says." for number in range(120))


def picture(path: Path, side: int = 200) -> Path:
    image = QImage(3 * side, side, QImage.Format.Format_RGB32)
    image.fill(QColor("#1560bd"))
    image.save(str(path))
    return path


def report(**look: object) -> SessionReport:
    store = FakeSessions()
    return build_session_report(store.session("session-7"), history=store.history("linden"), **look)  # type: ignore[arg-type]


def test_report_with_letterhead_is_not_cut_on_letter_paper(tmp_path: Path) -> None:
    logo = logo_png(picture(tmp_path / "logo.png"))
    head = Letterhead("W" * 60, ("12 Riverside Road", "Y" * 80, "Vienna", "Phone 12 34 56"), logo)
    path = write_session_report(report(form=ReportForm(head, "letter"), comment=LONG), tmp_path / "x.pdf")
    width, height = PAPER_PT["letter"]
    (size,) = re.findall(r"Page size:\s+([\d.]+) x ([\d.]+)", tool("pdfinfo", str(path)))
    assert tuple(map(float, size)) == pytest.approx((width, height), abs=1.0)
    left, top, right, foot = measure_reach(path)
    assert min(left, width - right, height - foot) >= 28.0
    assert top >= 20.0
    words, pages = read_words(path), count_pages(path)
    assert pages >= 4
    assert words.count("12 Riverside Road") == words.count(LEGAL_SENTENCE) == pages
    assert f"page {pages} of {pages}" in words
    for number in range(120):
        assert f"Line {number} of what" in words
    assert tool("pdfimages", "-list", str(path)).count("image") >= 1


def test_report_last_pages_are_the_comment_behind_any_other(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    rows = [(f"Row {number}", "5°") for number in range(130)]

    def make_pages(shown: SessionReport) -> list[QVBoxLayout]:
        tables = paged_table(shown.form, (TableColumn(), TableColumn()), ("Row", "Value"), rows)
        return [column(one, STRETCH, legal_line()) for one in tables]

    section = ReportSection("rows", phrase("Rows"), make_pages=make_pages)
    monkeypatch.setattr(session_page, "SECTIONS", (*SECTIONS, section))
    path = write_session_report(report(comment=LONG), tmp_path / "x.pdf")
    words, pages = tool("pdftotext", "-layout", str(path), "-").split("\f"), count_pages(path)
    of_rows = [number for number, page in enumerate(words, 1) if "Row 1" in page or "Row 9" in page]
    of_comment = [number for number, page in enumerate(words, 1) if "of what the therapist says" in page]
    assert of_comment == [pages - 2, pages - 1, pages]
    assert "The therapist’s comment is on the last 3 pages." in words[0]
    assert len(of_rows) > 1
    assert max(of_rows) < pages - 2
    told = re.findall(r"Row (\d+)", "".join(words))
    assert list(map(int, told)) == list(range(130)), "each row once, in order"
    left_out = replace(report(comment="Short."), form=ReportForm(excluded_sections=frozenset({"rows"})))
    assert "Row 1" not in page_words(left_out)


def test_progress_report_lists_all_manual_values_that_have_no_room() -> None:
    names = ("FLEXION", "EXTENSION", "RADIAL", "ULNAR", "PRONATION", "SUPINATION")
    days = [date(2026, 8, 1) + timedelta(days=number) for number in range(70)]
    values = [ManualValue(names[number % 6], "active", "right", day, (20.0,)) for number, day in enumerate(days)]
    course = build_progress_report(FakeSessions().history("linden"), manual_values=values)
    words = page_words(course)
    assert "see the next page for the complete list" in words
    assert words.count(LEGAL_SENTENCE) == len(pages_of_report(course)) > 2
    assert [day for day in days if numbers.format_date(day) not in words] == []


def test_report_mandatory_sections_stay() -> None:
    made = report(form=ReportForm(excluded_sections=frozenset(section.name for section in SECTIONS if section.label)))
    doubtful = replace(made, results=replace(made.results, is_simulated=True))
    words, sure = page_words(doubtful), "How reliable are these values?"
    for kept in (LEGAL_SENTENCE, "Simulated data", sure, "Method: 6 markers", "SD of a visible angle", "Carpus 1"):
        assert kept in words
    for gone in ("Range of motion", "Angles over time", "Pain, note", "ZYZ angles"):
        assert gone not in words


def test_form_is_kept_with_its_logo_and_second_person_s_change_is_reported(tmp_path: Path) -> None:
    with Store(tmp_path) as store:
        usual = ReportForm(paper="letter")
        assert read_form(store, "letter") == usual
        logo = logo_png(picture(tmp_path / "own.jpg"))
        form = ReportForm(Letterhead("Clinic", ("Here",), logo), "letter", frozenset({"bars"}), ("All {arc}.",))
        save_form(store, form, usual)
        (tmp_path / "own.jpg").unlink()
        assert read_form(store) == form
        with pytest.raises(ConcurrentChange):
            save_form(store, usual, usual)
        save_form(store, usual, form)
    assert read_report_form(tmp_path) == usual
    assert read_report_form(tmp_path / "nowhere") == ReportForm()


DRAWING = b'<svg xmlns="http://www.w3.org/2000/svg" width="200" height="200"><rect width="99" height="99"/></svg>'


def test_report_invalid_logo_is_refused(tmp_path: Path) -> None:
    large = QImage(7900, 7900, QImage.Format.Format_Mono)
    large.fill(0)
    assert large.save(str(tmp_path / "large.png"))
    assert (tmp_path / "large.png").stat().st_size < 100_000
    picture(tmp_path / "small.png", 8)
    refused = {"none.png": "cannot be read", "small.png": "too small", "large.png": "PNG or JPEG"}
    for number, content in enumerate((b"", b"no picture", b"<svg", DRAWING)):
        for name in (f"{number}.png", f"{number}.svg"):
            (tmp_path / name).write_bytes(content)
            refused[name] = "Choose a PNG or JPEG"
    for name, said in refused.items():
        with pytest.raises(LogoError, match=said):
            logo_png(tmp_path / name)


@pytest.mark.parametrize("hand", [False, True])
def test_letter_of_any_length_is_one_page(hand: bool, tmp_path: Path) -> None:
    """In German, which has the longest words."""
    store = FakeHandSessions() if hand else FakeSessions()
    stored = store.session("hand-7" if hand else "session-7")
    head = Letterhead("W" * 60, ("Y" * 80,) * 4, logo_png(picture(tmp_path / "logo.png")))
    form = ReportForm(head, "letter")
    made = build_session_report(stored, history=store.history("linden"), form=form, language="de", therapist="M. R.")
    made = replace(made, results=replace(made.results, is_simulated=True, is_recovered=True, is_excluded=True))
    named = Patient("Linden 42", "right", name="Real Name")
    for comment in ("Short, and kept.", LONG):
        letter = LetterReport(
            replace(made, comment=comment), "\n".join(["D" * 80] * 6), date(2026, 11, 22), named, "de"
        )
        path = write_report(letter, tmp_path / f"{len(comment)}.pdf")
        assert count_pages(path) == 1
        words = read_words(path)
        assert f"Real Name ({made.pseudonym})" in words
        assert f"Carpus {made.results.software_version}" in words
        assert ("Short, and kept." in words) == (comment != LONG)
        assert "Line 3 of" not in words
        _, _, right, foot = measure_reach(path)
        assert (right <= 612.0 - 28.0, foot <= 792.0 - 28.0) == (True, True)


@pytest.mark.parametrize(
    ("language", "names"),
    [("en", ("WRIST_FE",)), *((code, ("FIST_COMPOSITE", "THUMB_OPP", "FOREARM_PS")) for code in ("de", "it"))],
)
def test_dialog_for_home_is_one_page_in_patients_language(
    language: str, names: tuple[str, ...], tmp_path: Path
) -> None:
    path = write_report(home_report(language, "left", names), tmp_path / "home.pdf")
    assert count_pages(path) == 1
    words = read_words(path)
    with use_language(language):
        said = [task_words(name) for name in names]
    assert all(one in words for one in said)
    told = {"en": "You are more than halfway to our goal.", "de": "mehr als die Hälfte", "it": "oltre la metà"}[
        language
    ]
    assert told in words
    assert "11:30" in words
    assert "Linden 42" in words
    assert not re.search(r"\d\s?°", words), "no degrees for the patient"
    drawn = tool("pdftocairo", "-svg", str(path), "-")
    assert drawn.count("<path") > 60, "the exercises are drawings, not pictures of screens"
    assert "<image" not in drawn


def test_home_dialog_shows_no_deterioration() -> None:
    store = FakeSessions()
    history, goals = store.history("linden"), {("WRIST_FE", "right"): (60.0, -50.0)}
    last = next(one for one in history if one.session_id == "session-7")
    way = build_home_progress(last, history, goals)  # type: ignore[arg-type]
    assert way.has_improved
    assert way.goal_deg == 60.0
    assert len(way.days) == len(way.values_deg) >= 2
    assert build_home_progress(last, [last], {}) is None, "one session is no way"
    fair = [one for one in history if one.when.date() in way.days[1:-1]]
    fallen = [with_ranges(one, lambda row: {"mean": 2.0 * row.mean}) for one in fair]
    first = next(one for one in history if one.when.date() == way.days[0])
    as_at_first = replace(last, measures=first.measures)
    held = build_home_progress(as_at_first, [first], {})
    assert not held.has_improved
    assert build_home_progress(as_at_first, [first, *fallen], {}) is None, "what was reached in between is not held"
    worse = with_ranges(last, lambda row: {"mean": 0.3 * row.mean})
    assert build_home_progress(worse, history, {}) is None


def test_letter_names_no_one_unless_asked() -> None:
    made = report()
    words = page_words(LetterReport(made, "Dr A\nVienna", date(2026, 11, 22)))
    kept = ("Dr A", "Vienna", "22 Nov 2026", "Total arc", "± ", "first session on", LEGAL_SENTENCE[:60])
    assert all(one in words for one in (f"camera: {made.pseudonym} Dear", *kept))


def test_reports_print_the_real_name_in_their_language_where_asked() -> None:
    erika = Patient("Linden 42", "right", name="Erika Muster", birth_day=date(1981, 3, 12), record_number="PR-1")
    made = replace(report(), pseudonym="Linden 42")
    home, course = home_report("de"), build_progress_report(FakeSessions().history("linden"))
    pages = (
        (replace(made, printed_patient=erika), "born 12 Mar 1981, No. PR-1"),
        (replace(course, printed_patient=erika), "born 12 Mar 1981, No. PR-1"),
        (replace(home, report=replace(made, printed_patient=erika)), "geb. 12. März 1981, Nr. PR-1"),
    )
    for page, born in pages:
        assert f"Erika Muster, {born}" in page_words(page)
    assert "Erika" not in page_words(made)


def test_diagnosis_is_printed_only_where_clinic_wants_it() -> None:
    """With the weeks that had passed on the day of the session."""
    day = report().results.when.date() - timedelta(weeks=13)
    own = replace(report(), diagnosis="Wrist fracture, plate", onset="operation", onset_day=day)
    asked = replace(own, form=replace(own.form, excluded_sections=frozenset()))
    for one, printed in ((own, False), (asked, True)):
        said = page_words(one)
        assert [words in said for words in ("Wrist fracture, plate", "13 weeks before")] == [printed, printed]


def test_report_printed_on_other_paper_is_not_cut(tmp_path: Path) -> None:
    made = report(form=ReportForm(paper="a4"), comment="Splint.")
    pages = pages_of_report(made)
    printer = make_printer(made, len(pages))
    printer.setOutputFormat(QPrinter.OutputFormat.PdfFormat)
    printer.setOutputFileName(str(tmp_path / "p.pdf"))
    printer.setPageSize(QPageSize(PAGE_SIZES["letter"]))
    print_pages(printer, pages)
    assert count_pages(tmp_path / "p.pdf") == 2
    assert measure_reach(tmp_path / "p.pdf")[3] <= PAPER_PT["letter"][1] - 25.0
    assert "live values, not smoothed" in read_words(tmp_path / "p.pdf")


def test_places_of_a_sentence_take_figures_with_their_spread_or_say_not_measured() -> None:
    made = report()
    assert re.fullmatch(
        r"\d+° ± \d+° and not measured, {other}",
        fill_sentence("{flexion} and {radial}, {other}", made).replace("\u202f", " ").replace("\xa0", " "),
    )
    assert "13 Nov" in fill_sentence("{change}", made)
    assert fill_sentence("{change}", replace(made, previous=None)) == "Not measured."


def test_report_of_an_older_result_names_the_newer_one() -> None:
    store = FakeSessions()
    session = store.session("session-7")
    made = build_session_report(session).results
    newer = replace(made, session_id="newer", created=made.when + timedelta(days=1))
    said = "An older result: there is a newer one of the same recording."
    for history, is_older in (((), False), ((newer,), True), ((made, replace(newer, recording_id="another")), False)):
        assert (said in warning_lines(build_session_report(session, history=history).results)) is is_older


def test_reports_number_the_session_of_its_hand_and_show_the_other_one() -> None:
    history = FakeSessions().history("linden")
    right, (left,) = [one for one in history if one.side == "right"], [one for one in history if one.side == "left"]
    assert report().session_number == 7 == len(right)
    assert build_progress_report(right).progress.other_hand is None
    assert build_progress_report(right, other_hand=left).progress.other_hand is left
    assert build_progress_report(history).progress.other_hand is left


def test_report_of_a_pseudonym_with_slashes_has_a_name_of_one_file() -> None:
    figures = sorted(FakeSessions().history("linden"), key=lambda one: one.when)
    for pseudonym, start in (("Bäßler/Ö:*?\\ 1", "Bäßler-Ö-1_"), ("Linden 42", "Linden-42_"), ("../..", "patient_")):
        name = default_file_name(replace(build_progress_report(figures), pseudonym=pseudonym))
        assert name.startswith(start)
        assert Path(name).name == name
