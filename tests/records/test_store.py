"""The store of what people type: private, searchable, its list of sessions made anew from files, safe to open twice."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import sqlite3
import stat
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from datetime import date, datetime, timedelta
from pathlib import Path

import pytest
from sqlalchemy import select, update

from carpus.core.measures.manual_measurements import ManualValue
from carpus.core.model.errors import (
    CarpusFault,
    ConcurrentChange,
    NameUnsuited,
    PatientListDamaged,
    PatientListMissing,
    PatientListRebuilt,
    PatientListVersionUnknown,
    PseudonymTaken,
    SessionUnreadable,
)
from carpus.core.model.names import normalize_name
from carpus.core.records import clinic_records, patients, schema, session_records
from carpus.core.records.changes import insert_row
from carpus.core.records.clinic_records import read_sets
from carpus.core.records.database import STORE_FILE, move_aside
from carpus.core.records.log import read_log
from carpus.core.records.patients import WORDS, goal_change, patient_columns, read_goals, suggest_pseudonym
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.store import Store, new_id
from carpus.core.records.values import HomePlan, Patient, Therapist, select_latest_versions
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.reader import read_outline
from tests.records.samples import HERON, LINDEN, T0, House, measure, open_store, record, strip_stored_fields

BESIDE = (".jpg", ".carpusraw")
"""What :func:`measure` puts beside a session, as the tests write it."""


def test_patient_saved_is_private_and_read_back_where_the_folder_is(tmp_path: Path) -> None:
    old, new = tmp_path / "old", tmp_path / "new"
    old.mkdir(mode=0o755)
    with open_store(old) as house:
        patient_id = house.patients.add(LINDEN)
        session_id = measure(house, patient_id, T0)
        found = {p: stat.S_IMODE(p.stat().st_mode) for p in (old, *old.rglob("*")) if p.suffix not in BESIDE}
        assert any(p.name.endswith("-wal") for p in found)
        assert {p: mode for p, mode in found.items() if mode != (0o700 if p.is_dir() else 0o600)} == {}
    assert {p.name for p in old.rglob("*") if p.is_file() and b"Mustermann" in p.read_bytes()} == {STORE_FILE}
    old.rename(new)
    with open_store(new) as house:
        (found,) = house.patients.search()
        assert (found.patient_id, strip_stored_fields(found)) == (patient_id, LINDEN)
        assert (found.session_count, found.last_session, found.last_exercise) == (1, T0, "WRIST_FE")
        (session,) = house.index.patient_sessions(patient_id)
        assert (session.session_id, session.created, session.hand, session.frames) == (session_id, T0, "right", 4)
        assert session.path.parent == new / "sessions" / patient_id
        assert session.duration_s == pytest.approx(0.1)
        assert session.initials == "AB"
        assert house.index.get(session_id) == session
        row = house.store.row(select(schema.SESSION))
        assert row.size == session.path.stat().st_size
        version = house.patients.get(patient_id).version
        measure(house, patient_id, T0)
        house.patients.change(
            Patient("Oak 11", "right", patient_id=patient_id, version=version)
        )  # a session is no change of it
        house.files.scan()
        assert house.names() == ["Oak 11"], "a new name keeps its sessions"
        assert len(house.index.patient_sessions(patient_id)) == 2


def test_patient_search_orders_by_last_session(tmp_path: Path) -> None:
    with open_store(tmp_path) as house:
        never = house.patients.add(Patient("Fir 12", "left"), T0 + timedelta(days=9))
        linden, heron = house.patients.add(LINDEN, T0), house.patients.add(HERON, T0)
        measure(house, linden, T0 + timedelta(days=2))
        measure(house, heron, T0 + timedelta(days=1))
        assert house.names() == ["Linden 42", "Heron 17", "Fir 12"]
        # another zone: ten in the morning in Sydney is before nine in the evening in London
        later = datetime.fromisoformat("2026-11-13T21:00:00+00:00")
        measure(house, linden, datetime.fromisoformat("2026-11-14T07:00:00+11:00"))
        measure(house, heron, later)
        assert house.names() == ["Heron 17", "Linden 42", "Fir 12"]
        assert house.patients.get(heron).last_session == later
        assert [s.created.day for s in house.index.patient_sessions(linden)] == [14, 11]
        assert house.index.patient_sessions(never) == []


def test_pseudonym_of_another_patient_is_refused(tmp_path: Path) -> None:
    with open_store(tmp_path) as house:
        linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
        for taken in ("LINDEN 42", " linden 42", "Ｌinden 42"):
            with pytest.raises(PseudonymTaken):
                house.patients.add(Patient(taken, "left"))
        with pytest.raises(PseudonymTaken):
            house.patients.change(Patient("linden 42", "left", patient_id=heron))
        house.patients.change(Patient("linden 42", "both", note="changed", patient_id=linden))
        assert house.patients.get(linden).note == "changed"
        assert strip_stored_fields(house.patients.get(heron)) == HERON
        assert house.patients.id_of_pseudonym("LINDEN 42") == linden
        with pytest.raises(ConcurrentChange):
            house.patients.change(Patient("Oak 11", "left", patient_id="nobody"))
        with pytest.raises(SessionUnreadable):
            house.patients.get("nobody")
        with pytest.raises(SessionUnreadable):
            house.index.get("nothing")


def test_scan_finds_new_files_and_keeps_missing_ones(tmp_path: Path) -> None:
    with open_store(tmp_path) as house:
        linden, folder = house.patients.add(LINDEN), house.store.sessions_folder
        away = house.index.get(measure(house, linden, T0))
        session_records.add_comment(house.store, away.session_id, "still written", "AB")
        away.path.rename(folder / "moved.h5")
        record(folder / "from elsewhere" / "a.h5", "linden 42", T0 + timedelta(days=1))
        record(folder / "b.h5", "Wren 33", T0, "left")
        record(folder / "c.h5", "Wren 33", T0, "right")
        record(folder / "d.h5", "", T0)
        (folder / "e.h5").write_bytes((folder / "d.h5").read_bytes())
        (folder / "junk.h5").write_text("not a session")
        (folder / "s.h5.12345678.part").write_text("being recorded")
        found = house.files.scan()
        assert (found.session_count, sorted(house.names())) == (5, ["Linden 42", "Wren 33"])
        assert [fault.subject for fault in found.faults] == [str(folder / "junk.h5")]
        assert strip_stored_fields(house.patients.get(linden)) == LINDEN
        assert [entry.path.name for entry in house.index.patient_sessions(linden)] == ["a.h5", "moved.h5"]
        assert house.patients.get(house.patients.id_of_pseudonym("Wren 33")).session_count == 2
        assert house.patients.get(house.patients.id_of_pseudonym("Wren 33")).side == "both"
        (folder / "moved.h5").unlink()
        again = house.files.scan()
        assert (again.session_count, again.faults, len(house.names())) == (0, (), 2)
        assert house.index.get(away.session_id).path == folder / "moved.h5", "opening it tells that its file is away"
        assert session_records.read_comments(house.store, away.session_id) == ["still written"]


@pytest.mark.parametrize("how", ["exchanged", "moved over", "copied over", "another's"])
def test_scan_lists_exchanged_files_by_content(tmp_path: Path, how: str) -> None:
    with open_store(tmp_path) as house:
        ids = [measure(house, house.patients.add(entry), T0) for entry in (LINDEN, HERON)]
        session_records.add_comment(house.store, ids[0], "mine", "AB")
        mine, other = (house.index.get(one).path for one in ids)
        if how == "exchanged":
            mine.rename(tmp_path / "aside")
            other.rename(mine)
            (tmp_path / "aside").rename(other)
        elif how == "moved over":
            other.rename(mine)
        elif how == "copied over":
            shutil.copy(other, mine)
        else:
            mine.unlink()
            record(mine, "Wren 12", T0 + timedelta(days=1))
        for path in (mine, other):
            if path.exists():
                os.utime(path, ns=(1, 1))
        for _ in range(2):
            house.files.scan()
            for session_id in ids:
                path = house.index.get(session_id).path
                assert not path.exists() or read_outline(path).header.session_id == session_id
            assert house.index.get(ids[1]).path.exists()
            assert session_records.read_comments(house.store, ids[0]) == ["mine"]
        assert house.names("Wren") == (["Wren 12"] if how == "another's" else [])


def test_store_used_by_threads_and_programs_at_once(tmp_path: Path) -> None:
    faults: list[BaseException] = []

    def work(house: House, start: int) -> None:
        try:
            for number in range(start, start + 20):
                house.patients.add(Patient(f"Oak {number}", "left"))
                house.patients.search("oak")
        except BaseException as fault:
            faults.append(fault)

    with open_store(tmp_path) as one, open_store(tmp_path) as other:
        threads = [
            threading.Thread(target=work, args=(house, start))
            for house, start in ((one, 100), (one, 200), (other, 300), (other, 400))
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert not faults
        assert len(one.names()) == len(other.names()) == 80


def test_suggest_pseudonym_is_free_without_end() -> None:
    assert len(set(WORDS)) == len(WORDS)
    assert all(word.isalpha() and len(word) <= 8 for word in WORDS)
    taken = {f"{word} {number}" for word in WORDS for number in range(10, 100)}
    free = sorted(taken)[17]
    assert suggest_pseudonym(taken - {free}) == free
    assert suggest_pseudonym({name.upper() for name in taken}) == f"{WORDS[0]} 100"
    assert len({suggest_pseudonym(()) for _ in range(50)}) > 40


def test_concurrent_change_second_is_refused(tmp_path: Path, url: str) -> None:
    with open_store(tmp_path, url) as one, open_store(tmp_path, url) as other:
        linden = one.patients.add(LINDEN)
        session_id = measure(one, linden, T0)
        read = other.patients.get(linden)
        one.patients.change(replace(read, note="mine"))
        with pytest.raises(ConcurrentChange):
            other.patients.change(replace(read, note="yours"))
        assert other.patients.get(linden).note == "mine"
        for mine, yours in (({0: "pain"}, {1: ""}), ({2: ""}, {3: ""})):
            _, version = session_records.read_choices(other.store, session_id)
            session_records.save_choices(one.store, session_id, RepetitionChoices(mine), version)
            with pytest.raises(ConcurrentChange):
                session_records.save_choices(other.store, session_id, RepetitionChoices(yours), version)
            assert session_records.read_choices(other.store, session_id)[0].excluded == mine


def test_recording_counts_once_by_newest_result(tmp_path: Path) -> None:
    with open_store(tmp_path) as house:
        linden = house.patients.add(LINDEN)
        folder, week = house.store.sessions_folder / linden, timedelta(days=7)
        for number, days in enumerate((1, 9, 2)):
            made = record(folder / f"{number}.h5", "Linden 42", T0, recording_id="r", created=T0 + timedelta(days=days))
            house.index.add(made, linden)
        other = record(folder / "other.h5", "Linden 42", T0 + week, created=T0 - timedelta(days=400))
        house.index.add(other, linden)
        found = house.patients.get(linden)
        assert (found.session_count, found.result_count) == (2, 4)
        assert found.last_session == T0 + week, "the last movement, not the last tracking"
        kept = select_latest_versions(house.index.patient_sessions(linden))
        assert [(entry.path.name, entry.recorded) for entry in kept] == [("other.h5", T0 + week), ("1.h5", T0)]
        house.files.scan()
        assert house.patients.get(linden).session_count == 2


UNSEEN = ("\u00ad", "\u200b", "\u202e", "\n", "\ud800", "\0", "\u3164", "\ufe0f")


def test_normalize_name_composes_and_refuses_invisible(tmp_path: Path) -> None:
    assert normalize_name("Zoe\u0308 3") == "Zo\u00eb 3"
    assert normalize_name("Fir  11") == "Fir 11"
    for name in ("Müller-Lüdenscheidt", "李 小龍", "Ольга 7", "O’Neill 12"):
        assert normalize_name(f"  {name} ") == name
    with open_store(tmp_path) as house:
        for text in (*(f"Lin{sign}den" for sign in UNSEEN), "\u202eLinden", "Fir\ufe0f", "x" * 101):
            for entry in (Patient(text, "left"), Patient("Oak 11", "left", name=text)):
                with pytest.raises(NameUnsuited):
                    house.patients.add(entry)
                assert house.names() == [], repr(text)


@pytest.mark.parametrize("how", ["deleted", "emptied"])
def test_store_missing_beside_sessions_is_reported(tmp_path: Path, how: str) -> None:
    with open_store(tmp_path) as house:
        measure(house, PRACTICE_PATIENT, T0)
    for with_session in (False, True):
        for path in tmp_path.glob(f"{STORE_FILE}*"):
            path.unlink() if how == "deleted" else path.write_bytes(b"")
        with open_store(tmp_path) as house:
            assert [type(one) for one in house.store.startup_faults] == [PatientListMissing] * with_session
            measure(house, house.patients.add(LINDEN), T0)
    with open_store(tmp_path) as house:
        assert house.store.startup_faults == []


def test_rescue_rows_keeps_readable_rows(tmp_path: Path) -> None:
    """One page of two hundred patients is lost; all others stay, with what was written of them."""
    with open_store(tmp_path) as house:
        people = [
            insert_row(schema.PATIENT, f"{one:032x}", **patient_columns(Patient(f"Oak {one}", "left", note="x" * 300)))
            for one in range(200)
        ]
        house.store.apply(people)
        ends = [measure(house, people[place].id, T0) for place in (0, 100, -1)]
        for session_id in ends:
            session_records.add_comment(house.store, session_id, "Less swelling.", "AB")
        house.log.write_entry("locked", "program")
    content = bytearray((tmp_path / STORE_FILE).read_bytes())
    page = content.index(b"oak 100Oak 100") // 4096 * 4096
    content[page : page + 4096] = bytes(4096)
    (tmp_path / STORE_FILE).write_bytes(content)
    with open_store(tmp_path) as house:
        (fault,) = house.store.startup_faults
        assert isinstance(fault, PatientListRebuilt)
        house.files.scan()
        found = {row.id for row in house.store.rows(select(schema.PATIENT))}
        assert 180 < len(found & {one.id for one in people}) < 200
        for place, session_id in zip((0, -1), (ends[0], ends[-1]), strict=True):
            assert house.index.owner_id(session_id) == people[place].id
            assert session_records.read_comments(house.store, session_id) == ["Less swelling."]
        assert house.patients.get(house.index.owner_id(ends[1])).pseudonym == "Oak 100"
        assert [one.action for one in read_log(house.store)] == ["locked"]


def test_store_unknown_version_is_reported_and_unchanged(tmp_path: Path) -> None:
    Store(tmp_path).close()
    for version in ("99", "", "0", "../x%"):
        with contextlib.closing(sqlite3.connect(tmp_path / STORE_FILE)) as database:
            database.execute("UPDATE alembic_version SET version_num = ?", (version,))
            database.commit()
        text = f"version {version or '?'}, but this version of Carpus reads up to"
        with pytest.raises(PatientListVersionUnknown, match=re.escape(text)):
            Store(tmp_path)
    assert not list(tmp_path.glob("*damaged*"))


@pytest.mark.parametrize("version", [1, 2])
def test_store_earlier_version_is_migrated(tmp_path: Path, version: int) -> None:
    """The golden files were made by these versions."""
    golden = Path(__file__).with_name("golden") / f"version-{version}.sqlite3"
    (tmp_path / STORE_FILE).write_bytes(golden.read_bytes())
    with open_store(tmp_path) as house:
        (linden,) = house.patients.search("muster")
        (session,) = house.index.patient_sessions(linden.patient_id)
        before = replace(LINDEN, note="flexor tendon (40-49)", birth_day=None, record_number="", sex="")
        assert (strip_stored_fields(linden), session.exercise) == (before, "WRIST_FE")
        assert (linden.session_count, linden.last_session) == (1, session.recorded)
        assert house.patients.id_of_pseudonym("linden 42") == linden.patient_id
        assert session_records.read_comments(house.store, session.session_id) == ["Less swelling."]
        house.patients.change(replace(LINDEN, patient_id=linden.patient_id, version=linden.version))
        assert strip_stored_fields(house.patients.get(linden.patient_id)) == LINDEN


def test_store_earlier_version_damaged_is_rescued(tmp_path: Path) -> None:
    content = bytearray(Path(__file__).with_name("golden").joinpath("version-2.sqlite3").read_bytes())
    page = content.index(b"Less swelling.") // 4096 * 4096
    content[page : page + 4096] = bytes(4096)
    (tmp_path / STORE_FILE).write_bytes(content)
    with open_store(tmp_path) as house:
        assert [type(one) for one in house.store.startup_faults] == [PatientListRebuilt]
        assert house.names() == ["Linden 42"]


def test_scan_assigns_file_by_patient_folder(tmp_path: Path, url: str) -> None:
    with open_store(tmp_path, url) as house:
        given = new_id()
        record(house.store.sessions_folder / given / "s.h5", HERON.pseudonym, T0)
        house.files.scan()
        (met,) = house.patients.search()
        assert (met.patient_id, met.session_count) == (given, 1), "the folder says who it is"
        assert house.patients.get(given).name == ""
        house.patients.change(replace(HERON, pseudonym="Heron 18", patient_id=given))
        record(house.store.sessions_folder / given / "t.h5", HERON.pseudonym, T0)
        house.files.scan()
        assert [(one.patient_id, one.session_count) for one in house.patients.search()] == [(given, 2)]


def test_home_plan_and_goals_are_saved_with_patient(tmp_path: Path) -> None:
    with open_store(tmp_path) as house:
        linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
        first = HomePlan(("WRIST_FE", "FIST_HOOK"), 10, 3, T0.date(), None, "", "", "it")
        for plan in (first, replace(first, times=5, again=date(2026, 10, 16), at="11:30", note="Bring the splint")):
            patients.save_home_plan(house.store, linden, plan)
            assert patients.read_home_plan(house.store, linden) == plan
        assert patients.read_home_plan(house.store, heron) is None
        house.store.apply([goal_change(linden, "WRIST_FE", "right", 40.0, 30.0)])
        assert read_goals(house.store, linden) == {("WRIST_FE", "right"): (40.0, 30.0)}
        assert read_goals(house.store, heron) == {}


def test_store_damaged_opened_twice_loses_nothing(tmp_path: Path) -> None:
    content, now = b"this is no store at all" * 100, datetime(2026, 10, 9)
    path = tmp_path / STORE_FILE
    path.write_bytes(content)
    aside = move_aside(path, now)
    path.write_bytes(b"another")
    assert move_aside(path, now) != aside
    assert aside.read_bytes() == content, "never onto a name that is there"
    path.write_bytes(content)
    with ThreadPoolExecutor(4) as programs:
        stores = list(programs.map(lambda _: Store(tmp_path), range(4)))
    assert sum(len(one.startup_faults) for one in stores) == 1, "one sets it aside, the others find the new one"
    for one in stores:
        one.close()


def test_valid_rows_skips_and_reports_damaged_row_once(tmp_path: Path) -> None:
    told: list[CarpusFault] = []
    with open_store(tmp_path, tell=told.append) as house:
        linden = house.patients.add(LINDEN)
        session_id = measure(house, linden, T0)
        session_records.save_choices(house.store, session_id, RepetitionChoices({0: "pain"}), 0)
        for day in (9, 10, 11):
            value = ManualValue("WRIST_ROUND", "", "right", date(2026, 10, day), (17.0,), "")
            patients.add_manual_measurements(house.store, linden, [value])
        measured = house.store.rows(
            select(schema.MANUAL_MEASUREMENT.c.id).order_by(schema.MANUAL_MEASUREMENT.c.entered_ns)
        )
        for row, damage in zip(measured, ({"tries": "[1"}, {"day": "yesterday"}), strict=False):
            house.store.execute_local(
                update(schema.MANUAL_MEASUREMENT).where(schema.MANUAL_MEASUREMENT.c.id == row.id).values(**damage)
            )
        house.store.execute_local(update(schema.CORRECTION).values(edges_s="no"))
        house.store.apply([insert_row(schema.EXERCISE_SET, "s", name="s", discs="wrist6", parts="[")])
        for _ in range(2):
            assert [one.day.day for one in patients.read_manual_measurements(house.store, linden)] == [11]
            assert session_records.read_choices(house.store, session_id)[0] == RepetitionChoices()
            assert read_sets(house.store) == ()
    assert [type(one) for one in told] == [PatientListDamaged] * 4


def test_therapists_of_two_computers_are_kept(tmp_path: Path) -> None:
    anna, katrin, maria = Therapist("AB", "Anna"), Therapist("KB"), Therapist("MR", "Maria")
    with open_store(tmp_path) as one, open_store(tmp_path) as other:
        clinic_records.save_therapists(one.store, [anna, katrin])
        clinic_records.save_therapists(other.store, [maria])
        clinic_records.save_therapists(one.store, [replace(anna, name="Anna B")], [anna, katrin])
        listed = [replace(anna, name="Anna B"), maria]
        assert clinic_records.read_therapists(other.store) == listed
        assert [clinic_records.therapist_words(one.store, one_) for one_ in ("AB", "XX")] == ["Anna B (AB)", "XX"]


def test_patient_search_finds_every_word(tmp_path: Path) -> None:
    with open_store(tmp_path) as house:
        house.patients.add(LINDEN)
        house.patients.add(HERON)
        linden, heron = {"Linden 42"}, {"Heron 17"}
        for search, found in {
            "": linden | heron, "lind": linden, "42 linden": linden, "MUSTER": linden, "tendon": linden, "17": heron,
            "4711": linden, "1981-03-12 erika": linden,
            "heron 42": set(), "%": set(),
        }.items():  # fmt: skip
            assert set(house.names(search)) == found, search


def test_new_path_is_free_and_in_patient_folder(tmp_path: Path) -> None:
    with open_store(tmp_path) as house:
        patient_id = house.patients.add(LINDEN)
        first = house.index.new_path(patient_id, "Linden 42", "wrist: up/down", "left", T0)
        assert first.name == "Linden-42_2026-10-09_095100_wrist-up-down_left.h5"
        first.write_text("")
        second = house.index.new_path(patient_id, "Linden 42", "wrist: up/down", "left", T0)
        assert second != first
        assert second.parent == first.parent
        folders = set()
        for pseudonym in ("Fir 11", "Fir-11", "Fir_11", "fir.11"):
            patient_id = house.patients.add(Patient(pseudonym, "left"))
            folders.add(house.index.new_path(patient_id, pseudonym, "WRIST_FE", "left", T0).parent)
        assert len(folders) == 4
