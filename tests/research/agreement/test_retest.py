"""Test and retest: the error that was put in is found, stored, and changes what is called a change."""

from __future__ import annotations

import csv
import json
import math
import shutil
import subprocess
import uuid
from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, date, datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING, cast

import numpy as np
import pytest
from PySide6.QtWidgets import QFileDialog, QWidget
from pytestqt.qtbot import QtBot

from carpus.app.desktop.window import Desktop
from carpus.core.measures.change_limits import ErrorLimits, MeasuredLimit, RetestStudy
from carpus.core.model import so3
from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.types import TrackStatus
from carpus.core.records.clinic_records import LIMITS_FILE, read_limits, save_limits
from carpus.core.research.agreement.retest import analyse_retests, compute_retest
from carpus.core.results.progress import compare_ranges
from carpus.core.results.session_results import SessionResults
from carpus.core.session.values import new_header
from carpus.ui.kit.text import Text
from tests.commands import Command
from tests.moments import with_moment
from tests.results.days import with_ranges
from tests.session.samples import begin_session, make_calibration, make_frame
from tests.ui.fakes import figures_once, session

if TYPE_CHECKING:
    from carpus.ui.screens.settings.flow import SettingsFlow

pytestmark = pytest.mark.xdist_group("retest")  # one folder of sessions for all
FIRST = datetime(2026, 11, 2, 9, 0, tzinfo=UTC)


def readings(rng: np.random.Generator, people: int, times: int, error: float, rater: float = 0.0) -> np.ndarray:
    truth = rng.normal(60.0, 8.0, (people, 1))
    return truth + rng.normal(0.0, error, (people, times)) + rng.normal(0.0, rater, (1, times))


@pytest.mark.parametrize(("times", "rater"), [(3, 0.0), (4, 2.0)])
def test_retest_interval_has_its_coverage(times: int, rater: float) -> None:
    rng = np.random.default_rng(times)
    true = math.hypot(2.0, rater)
    found = [compute_retest(readings(rng, 12, times, 2.0, rater).tolist()) for _ in range(300)]
    held = float(np.mean([one.sem_interval[0] <= true <= one.sem_interval[1] for one in found]))
    # With four raters who differ the few means decide, and Satterthwaite's interval is an approximation.
    assert (0.93 if rater == 0.0 else 0.85) <= held <= 0.975


def test_retest_rater_differences_are_in_sem_not_in_intra_rater() -> None:
    rng = np.random.default_rng(3)
    values, names = [], []
    for truth in rng.normal(60.0, 8.0, 500):
        offset = {"MK": 0.0, "JS": 4.0}
        who = ["MK", "MK", "JS", "JS"]
        values.append([truth + offset[one] + rng.normal(0.0, 1.5) for one in who])
        names.append(who)
    found = compute_retest(values, names)
    assert found.intra_rater_sem == pytest.approx(1.5, abs=0.1)
    assert found.sem > 2.4


def test_retest_excludes_single_and_unknown_readings() -> None:
    found = compute_retest([[60.0, 62.0], [71.0], [55.0, math.nan], [64.0, 66.0, 65.0], [70.0, 71.0]])
    assert (found.people, found.readings) == (3, 7)
    assert math.isnan(compute_retest([[60.0, 61.0]]).sem)


def write_session(folder: Path, person: int, time: int, when: datetime, reach_deg: float) -> Path:
    """Flexion to and fro by ``reach_deg`` to both sides, four times."""
    header = new_header(
        hand="right", protocol=make_calibration().clicks.protocol, subject_id=f"P{person:02d}",
        exercise="WRIST_FE", now=when, session_id=uuid.uuid4(),
    )  # fmt: skip
    path = folder / f"P{person:02d}-{time}.h5"
    set_up = make_calibration()
    seen_from_above = np.diag([1.0, -1.0, -1.0])
    set_up = replace(set_up, verdict=replace(set_up.verdict, findings=()), rotation_w0_cam=seen_from_above)
    with begin_session(path, header, calibration=set_up) as writer:
        for row in range(64):
            angle = math.radians(reach_deg) * math.sin(2.0 * math.pi * row / 16.0)
            turn = so3.exp(np.array([0.0, angle, 0.0]))
            moved = with_moment(
                make_frame(row), rotation_w2_w0=turn, position_m=np.zeros(3), w0_turn_rad=np.zeros(3),
                angles_rad=np.array([0.0, angle, 0.0]), angles_sd_rad=np.radians([0.5, 1.0, 1.0]),
            )  # fmt: skip
            seen = {"timestamp_s": row / 30.0, "status": TrackStatus.TRACKED, "dropped_before": 0}
            writer.append(replace(moved, **seen, marker_measured_px=np.full((6, 2), 300.0)))
    return path


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Ten people twice, a week apart, and two who take no part: measured once, and too late."""
    folder, rng = tmp_path_factory.mktemp("retest"), np.random.default_rng(4)
    for person in range(1, 12):
        reach = rng.normal(45.0, 6.0)
        for time in (1, 2):
            if (person, time) != (11, 2):
                when = FIRST + timedelta(days=7 * (time - 1), hours=person)
                write_session(folder, person, time, when, reach + rng.normal(0.0, 1.0))
    write_session(folder, 1, 3, FIRST + timedelta(days=40), 70.0)
    return folder


def make_results(person: int, day: int, flexion_deg: float) -> SessionResults:
    made = with_ranges(figures_once(session(seconds=26.0)), lambda _: {"mean": flexion_deg})
    name = f"P{person:02d}-{day}"
    return replace(
        made, subject_id=name[:3], session_id=name, recording_id=name, when=FIRST + timedelta(days=day, hours=person)
    )


@pytest.fixture(scope="module")
def measured() -> list[SessionResults]:
    """Ten people twice, a week apart, and two sessions that take no part: measured once, and too late."""
    pairs = readings(np.random.default_rng(4), 10, 2, 1.0)
    taken = [make_results(person, 7 * k, mean) for person, pair in enumerate(pairs, 1) for k, mean in enumerate(pair)]
    return [*taken, make_results(1, 40, 70.0), make_results(11, 0, 60.0)]


def test_retest_command_stores_limits_for_reports(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: Command
) -> None:
    monkeypatch.setenv("CARPUS_DATA", str(tmp_path))
    raters, table, output = tmp_path / "raters.csv", tmp_path / "table.csv", tmp_path / "progress.pdf"
    raters.write_text("session,rater\nP01-1,MK\nP01-2,JS\nnobody,MK\n", encoding="utf-8")
    done = command("retest", folder, "--output", table, "--raters", raters, "--store")
    assert done.code == 0
    assert "10 people, 20 sessions, 2 raters" in done.out
    assert "no session is called nobody" in done.err
    with table.open(encoding="utf-8", newline="") as file:
        rows = {(row["of"], row["movement"]): row for row in csv.DictReader(file)}
    (study,) = read_limits(tmp_path).studies
    assert (study.people, study.made) == (10, date.today().isoformat())
    own = study.limit_deg("flexion", "arc")
    assert own == math.ceil(float(rows[("flexion", "arc")]["mdc95_deg"]))
    assert command("report", folder / "P01-1.h5", folder / "P01-2.h5", "--output", output).code == 0
    read = subprocess.run(["pdftotext", str(output), "-"], capture_output=True, text=True, check=True).stdout
    words = " ".join(read.split())
    assert all(said in words for said in ("This clinic measured", "with 10 people", f"measurement error of {own:.0f}°"))


def test_retest_command_few_people_set_no_limits(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: Command
) -> None:
    monkeypatch.setenv("CARPUS_DATA", str(tmp_path))
    paths = sorted(folder.glob("P0[1-4]-[12].h5"))
    done = command("retest", *paths, "--store")
    assert (done.code, "4 people" in done.err) == (1, True)
    assert not (tmp_path / LIMITS_FILE).exists()
    assert command("retest", paths[0]).code == 1


def make_limits(mdc_deg: float, people: int = 12) -> ErrorLimits:
    one = MeasuredLimit("flexion", "arc", people, mdc_deg / 2.77, (1.0, 4.0), mdc_deg, (2.0, 9.0))
    return ErrorLimits((RetestStudy("wrist6", "WRIST_FE", "zyx", "2026-11-27", people, 2 * people, 2, (one,)),))


def test_comparison_uses_the_clinics_limit(measured: list[SessionResults]) -> None:
    before, after = measured[0], make_results(1, 1, measured[0].find("flexion", "arc").mean + 8.9)

    def arc(measured: ErrorLimits) -> tuple[str, float]:
        found = {item.after.quantity: item for item in compare_ranges(before, replace(after, error_limits=measured))}
        assert found["flexion"].limit_deg == pytest.approx(10.0), "what the study has not keeps the default"
        return found["arc"].verdict, round(found["arc"].limit_deg, 1)

    assert arc(ErrorLimits()) == ("no_change", 14.1)
    assert arc(make_limits(6.6)) == ("improved", 7.0)
    assert arc(make_limits(9.0)) == ("no_change", 9.0)
    assert arc(make_limits(6.6, people=9)) == ("no_change", 14.1)
    other_order = replace(make_limits(6.6).studies[0], angle_order="isb")
    assert arc(ErrorLimits((other_order,))) == ("no_change", 14.1)


def test_error_limits_are_read_back_and_replaced_by_kind(tmp_path: Path) -> None:
    assert read_limits(tmp_path) == ErrorLimits()
    old, new = make_limits(6.6).studies[0], make_limits(5.0).studies[0]
    other = replace(old, exercise="WRIST_RU")
    save_limits(tmp_path, [old, other])
    assert read_limits(tmp_path).studies == (old, other)
    save_limits(tmp_path, [new])
    assert read_limits(tmp_path).studies == (other, new)
    assert [path.name for path in tmp_path.iterdir()] == [LIMITS_FILE]


def test_error_limits_damaged_file_is_refused(tmp_path: Path) -> None:
    save_limits(tmp_path, make_limits(6.6).studies)
    negative = json.loads((tmp_path / LIMITS_FILE).read_text())
    negative["studies"][0]["limits"][0]["mdc95_deg"] = -3
    nothing = '{"format": "carpus-error-limits", "format_version": 1, "studies": [{}]}'
    for text in ("", "[]", '{"format": "else"}', nothing, json.dumps(negative)):
        (tmp_path / LIMITS_FILE).write_text(text)
        with pytest.raises(SettingsInvalid):
            read_limits(tmp_path)


def collect_texts(widget: QWidget) -> str:
    return " ".join(text.text() for text in widget.findChildren(Text) if not text.isHidden())


def test_settings_compute_and_store_error_limits(
    open_desktop: Callable[..., Desktop], qtbot: QtBot, folder: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    study = tmp_path / "study"
    shutil.copytree(folder, study)
    (study / "damaged.h5").write_bytes(b"no session")
    desktop = open_desktop(today=date(2026, 11, 27))
    desktop.controller.navigator.open_screen("settings", "measuring")
    settings = cast("SettingsFlow", desktop.controller.navigator.flow("settings"))
    answers = iter(["", str(study)])
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", staticmethod(lambda *_: next(answers)))
    settings.screen.retest_button.click()
    assert settings.screen.retest_button.isEnabled(), "the person thought better of it"
    settings.screen.retest_button.click()
    assert not settings.screen.retest_button.isEnabled()
    qtbot.waitUntil(settings.retest_dialog.isVisible)
    said = collect_texts(settings.retest_dialog)
    for piece in (
        "People: 10, sessions: 20.", "1 (measured once)", "1 (more than 14 days later)", "Unreadable sessions: 1",
    ):  # fmt: skip
        assert piece in said
    assert read_limits(tmp_path / "data").studies == ()
    settings.retest_dialog.accept_button.click()
    qtbot.waitUntil(lambda: bool(desktop.library.error_limits.studies))
    (stored,) = read_limits(tmp_path / "data").studies
    assert (stored.people, stored.made) == (10, "2026-11-27")
    qtbot.waitUntil(lambda: "Measured on 27 Nov 2026 with 10 people in 20 sessions" in collect_texts(settings.screen))


def test_retest_few_or_simulated_people_are_not_usable(measured: list[SessionResults]) -> None:
    people = [one for one in measured if one.subject_id != "P11"]
    assert [one.is_usable for one in analyse_retests(people)] == [True]
    assert [one.is_usable for one in analyse_retests([one for one in people if one.subject_id != "P10"])] == [False]
    assert [one.is_usable for one in analyse_retests([replace(one, is_simulated=True) for one in people])] == [False]
    assert [one.is_usable for one in analyse_retests(people[:1])] == [False]


def test_analyse_retests_builds_a_study(measured: list[SessionResults]) -> None:
    (one,) = analyse_retests(measured)
    assert (one.people, one.sessions) == (10, 20)
    assert sorted(left.reason for left in one.excluded) == ["once", "too_late"]
    first, second = np.array([figures.find("flexion", "flexion").mean for figures in measured[:20]]).reshape(-1, 2).T
    assert one.results["flexion", "flexion"].sem == pytest.approx(math.sqrt(float(((second - first) ** 2).mean()) / 2))
