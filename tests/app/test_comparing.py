"""In the real window: a session is compared with a table of another program, told which column is which, and saved."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from datetime import UTC, date, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from carpus.app.desktop.window import Desktop
from carpus.app.settings import ScreenSettings, Settings
from carpus.core.agreement.clocks import Stopped, WorkWatch
from carpus.core.agreement.compared_files import compare_files
from carpus.core.agreement.reference import outline_of
from carpus.core.records.log import read_log
from carpus.core.results.report_form import ReportSettings
from carpus.core.session.reader import read_session
from tests.agreement.test_retest import written
from tests.records.samples import LINDEN, kept

NOW = datetime(2026, 11, 20, 9, 0, tzinfo=UTC)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Twelve seconds of flexion to and fro by 45 degrees."""
    return written(tmp_path_factory.mktemp("session"), 1, 1, NOW, 45.0)


@pytest.fixture(scope="module")
def optical(recorded: Path) -> Path:
    """The same movement as another program writes it: other names, other sign, 2 degrees more, 100 a second."""
    session = read_session(recorded)
    time_s = session.timestamp_s - session.timestamp_s[0]
    even_s = np.arange(0.0, time_s[-1], 0.01)
    flexion = np.degrees(np.interp(even_s, time_s, session.motion.angles_rad[:, 1]))
    path = recorded.with_name("optical.csv")
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["Frame", "Zeit", "FlexExt"])
        table.writerows(
            (k, f"{t:.3f}", f"{2.0 - angle:.3f}") for k, (t, angle) in enumerate(zip(even_s, flexion, strict=True))
        )
    return path


@pytest.fixture(scope="module")
def earlier(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same by 42 degrees, a day before."""
    return written(tmp_path_factory.mktemp("earlier"), 1, 2, NOW - timedelta(days=1), 42.0)


@pytest.fixture
def desktop(
    open_desktop: Callable[..., Desktop], qtbot: QtBot, recorded: Path, earlier: Path, tmp_path: Path
) -> Desktop:
    patient = kept(tmp_path / "data", LINDEN, (recorded, NOW, ""), (earlier, NOW - timedelta(days=1), ""))
    settings = Settings(screen=ScreenSettings("light"), report=ReportSettings(agreement_limit_deg=5.0))
    opened = open_desktop(settings, today=date(2026, 11, 20))
    opened.journey.review.show("", patient)
    qtbot.waitUntil(lambda: opened.journey.review.screen.shown)
    return opened


def choosing(monkeypatch: pytest.MonkeyPatch, file: Path, folder: Path) -> None:
    """The person's answers to the system's own dialogs."""
    monkeypatch.setattr(QFileDialog, "getOpenFileName", staticmethod(lambda *_: (str(file), "")))
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", staticmethod(lambda *_: str(folder)))


def test_from_the_review_to_saved_tables(
    qtbot: QtBot, desktop: Desktop, optical: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    journey = desktop.journey
    screen, comparing = journey.agreement.screen, journey.agreement
    choosing(monkeypatch, optical, tmp_path)
    journey.review.screen.card.export_button.click()
    journey.review.exporting.formats.compare_button.click()
    assert journey.place == "agreement"
    assert comparing.reference.isVisible()
    comparing.reference.file_button.click()
    qtbot.waitUntil(comparing.columns.isVisible)  # no column is called as ours are
    assert not comparing.columns.take.isEnabled()
    times = comparing.columns.boxes["time"]
    assert [times.itemText(row) for row in range(times.count())] == ["–", "Frame", "Zeit", "FlexExt"]
    for name, column in (("time", "Zeit"), ("flexion", "FlexExt")):
        box = comparing.columns.boxes[name]
        box.setCurrentIndex(box.findData(column))
    assert comparing.columns.take.isEnabled()
    comparing.columns.signs["flexion"].click()
    comparing.columns.take.click()
    qtbot.waitUntil(lambda: screen.compared is not None)
    (pairs,) = screen.compared.pairs
    assert pairs.figures_deg.bias == pytest.approx(2.0, abs=0.05)
    assert screen.answer.text() == "Flexion–extension agrees within 5°."
    assert screen.chart.plot is not None
    head, rows = screen.chart.table()
    assert len(list(rows)) == pairs.figures_deg.count
    assert head[0] == "angle"
    # What was said of the columns is proposed again.
    screen.columns_button.click()
    assert comparing.columns.chosen() == {"time": "Zeit", "flexion": "-FlexExt"}
    comparing.columns.leave()
    screen.save_button.click()
    qtbot.waitUntil(lambda: journey.messages.busy)
    names = sorted(path.name.rpartition("against-")[2] for path in tmp_path.glob("*against-optical*"))
    assert names == [
        "optical.agreement.csv", "optical.agreement.json", "optical.flexion.png", "optical.pairs.csv", "optical.pdf",
    ]  # fmt: skip
    said = json.loads(next(tmp_path.glob("*.agreement.json")).read_text(encoding="utf-8"))
    assert said["angles"][0]["bias_deg"] == pytest.approx(pairs.figures_deg.bias)
    exported = [entry for entry in read_log(desktop.library.store) if entry.did == "exported"]
    assert [entry.facts["files"] for entry in exported] == [5]


def test_with_another_session_with_what_is_none_and_given_up(
    qtbot: QtBot, desktop: Desktop, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, optical: Path
) -> None:
    journey, comparing, screen = desktop.journey, desktop.journey.agreement, desktop.journey.agreement.screen
    sheet, asked = comparing.reference, list[bool]()
    journey.sessions.show(journey.now.patient.patient_id)
    journey.sessions.screen.reference_button.click()
    assert journey.place == "agreement"
    assert [sheet.box.itemText(row) for row in range(sheet.box.count())] == [
        "19 Nov 2026, 09:00 · Wrist flexion–extension"
    ]
    sheet.session_button.click()
    qtbot.waitUntil(lambda: screen.compared is not None)
    assert screen.compared.pairs[0].figures_deg.largest == pytest.approx(3.0, abs=0.1)
    assert not screen.columns_button.isVisible(), "a session has no columns to be told"
    journey.way.back()
    assert journey.place == "review"

    held, real = tmp_path / "movement.csv", WorkWatch.at
    held.write_text(optical.read_text(encoding="utf-8").replace("Zeit,FlexExt", "time,flexion"), encoding="utf-8")
    choosing(monkeypatch, held, tmp_path)
    comparing.show(journey.now.session_id)

    def at(watch: WorkWatch, share: float) -> None:
        if share == 0.0 and not asked:
            asked.append(True)
            comparing.leave()  # as the way back does
        real(watch, share)

    with monkeypatch.context() as patched:
        patched.setattr(WorkWatch, "at", at)
        sheet.file_button.click()
        qtbot.waitUntil(lambda: bool(asked))
        qtbot.waitUntil(screen.other_button.isEnabled)
    assert screen.compared is None
    assert not journey.messages.busy, "who stops it needs no message"

    held.write_text("one line only\n", encoding="utf-8")
    comparing.show(journey.now.session_id)
    sheet.file_button.click()
    qtbot.waitUntil(lambda: journey.messages.busy)
    assert screen.compared is None
    assert screen.other_button.isEnabled()


def test_progress_rises_and_a_stop_writes_nothing(recorded: Path, optical: Path) -> None:
    heard: list[int] = []
    columns = {"time": "Zeit", "flexion": "-FlexExt"}
    watched = WorkWatch(lambda done, _: heard.append(done))
    compare_files(recorded, optical, columns=columns, watch=watched)
    assert heard == sorted(heard)
    assert heard[0] == 0
    assert heard[-1] == 100
    assert len(heard) > 2
    with pytest.raises(Stopped):
        compare_files(recorded, optical, columns=columns, watch=WorkWatch(cancelled=lambda: True))


@pytest.mark.parametrize(
    ("name", "text", "kind", "found"),
    [
        ("a.csv", "time_s,flexion_deg,other\n0,1,2\n1,2,3\n", "angles", {"time": "time_s", "flexion": "flexion_deg"}),
        ("b.csv", "movement;reading_deg\nflexion;40\n", "readings", {}),
        ("c.tsv", "Zeit\tFE\n0\t1\n1\t2\n", "angles", {"time": "Zeit"}),
    ],
)
def test_the_outline_says_what_is_known_by_its_name(
    tmp_path: Path, name: str, text: str, kind: str, found: dict[str, str]
) -> None:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    outline = outline_of(path)
    assert (outline.kind, dict(outline.found)) == (kind, found)
