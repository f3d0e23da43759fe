"""What is written is for its owner only, and says nobody's name where it need not."""

from __future__ import annotations

import logging
import subprocess
import sys
import uuid
from contextlib import closing
from datetime import date
from pathlib import Path

import h5py
import pytest

from carpus.app.desktop.log import RedactingFormatter
from carpus.app.settings import load_valid_settings
from carpus.core.capture.files.raw import RawWriter
from carpus.core.capture.source import SourceInfo
from carpus.core.formats.export import FORMATS
from carpus.core.formats.output_files import TableDialect, write_new_table
from carpus.core.model.camera import Camera
from carpus.core.model.errors import RecordingUnreadable, SettingsInvalid
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.values import Patient
from carpus.core.session.writer import SessionWriter
from carpus.ui.report.page import write_report
from carpus.ui.report.session_page import build_session_report
from tests.commands import Command
from tests.formats.takes import store_session
from tests.records.samples import T0, store_patient
from tests.session.samples import CAMERA, make_calibration, make_frame, make_header, write_journal
from tests.ui.printed import read_words

ROOT = Path(__file__).parents[2]


def mode(path: Path) -> int:
    return path.stat().st_mode & 0o777


def test_sessions_and_raw_pictures_are_for_their_owner(tmp_path: Path) -> None:
    path = tmp_path / "s.h5"
    with SessionWriter.create(path, make_header(session_id=uuid.uuid4()), CAMERA, make_calibration()) as writer:
        (hidden,) = tmp_path.iterdir()
        assert mode(hidden) == 0o600
        writer.append(make_frame(0))
    assert mode(path) == 0o600
    write_journal(tmp_path / "s.journal").close()
    assert mode(tmp_path / "s.journal") == 0o600
    with RawWriter(tmp_path / "s.carpusraw", SourceInfo("x", Camera(500, 500, 320, 240), True, None, 30.0, {})):
        assert mode(tmp_path / "s.carpusraw") == 0o600


def test_log_names_no_one(tmp_path: Path, own_folders: Path) -> None:
    library = DataFolder(tmp_path)
    born = date(1931, 2, 17)
    library.patients.add(Patient("Linden Birke", "right", "right", "", "Ada Miller", born, "QX-1"))
    lines = RedactingFormatter()
    lines.find_names = library.identifying_texts
    try:
        path = tmp_path / "sessions" / "Linden-Birke" / "Linden-Birke_2026-11-13_153000_wrist-flexion_left.h5"
        try:
            words = "of ADA MILLER, QX-1, 1931-02-17, linden birke, Linden-Birke_2026-11-13_153000_x_left.h5"
            raise SettingsInvalid(path, words)
        except SettingsInvalid as fault:
            info = (type(fault), fault, fault.__traceback__)
        record = logging.LogRecord("carpus", logging.WARNING, "x.py", 1, "told %s", (str(path),), info)
        said = lines.format(record)
    finally:
        library.close()
    assert "SettingsInvalid" in said
    for part in ("linden", "miller", "birke", "qx-1", "1931"):
        assert part not in said.casefold()


def _unpacked(one: h5py.Group | h5py.Dataset) -> bytes:
    """All texts of a part of an HDF5 file, which may be compressed in it."""
    held = one[()].tolist() if isinstance(one, h5py.Dataset) and one.dtype.kind in "OSV" else ""
    return repr([*one.attrs.values(), held]).encode()


def test_identity_is_in_no_byte_outside_the_store(tmp_path: Path, own_folders: Path, command: Command) -> None:
    """Sessions, what lies beside them, every export, reports, tables and the log: searched as written and unpacked."""
    secret = Patient(
        "Linden 42", "right", name="Zyxnamovich Quarz", birth_day=date(1931, 2, 17), record_number="QX-99417",
        sex="diverse", diagnosis="Kienboeck",
    )  # fmt: skip
    data, out = tmp_path / "data", tmp_path / "out"
    patient_id = store_patient(data, secret, (store_session(tmp_path, frames=40), T0, "AB"))
    with closing(DataFolder(data)) as library:
        (entry,) = library.sessions(patient_id)
        library.save_comment(entry.session_id, "Less swelling.")
        for deidentified in (False, True):
            folder = out / str(deidentified)
            library.export(entry.session_id, str(folder), [*FORMATS], deidentified=deidentified)
        report = build_session_report(library.session(entry.session_id), history=library.history(patient_id))
        write_report(report, out / "report.pdf")
    assert command("report", entry.path, "--output", out / "again.pdf").code == 0
    assert command("log", "--data-folder", data, "--output", out / "log.csv").code == 0
    files = [one for one in tmp_path.rglob("*") if one.is_file() and not one.name.startswith("records.sqlite3")]
    assert len(files) > 12
    spelled = ("zyxnamovich", "quarz", "qx-99417", "1931-02", "feb 1931", "02.1931", "kienboeck", "diverse")
    for path in files:
        texts = [path.name.encode(), path.read_bytes()]
        if path.suffix == ".h5":
            with h5py.File(path) as file:
                file.visititems(lambda _, one, texts=texts: texts.append(_unpacked(one)))
        if path.suffix == ".pdf":
            texts.append(read_words(path).encode())
        found = [word for word in spelled for text in texts if word.encode() in text.lower()]
        assert found == [], path


@pytest.mark.parametrize("separator", [",", "\t"])
def test_written_tables_contain_no_formulas(tmp_path: Path, separator: str) -> None:
    path = write_new_table(
        tmp_path / "t.tsv", ("a", "b", "c"), [("=1+2", "-3.5", "@SUM(A1)"), ("-2+3", "+", "x")], TableDialect(separator)
    )
    assert [line.split(separator) for line in path.read_text().splitlines()[1:]] == [
        ["'=1+2", "-3.5", "'@SUM(A1)"], ["'-2+3", "'+", "x"],
    ]  # fmt: skip


WRITES = """
import os, sys
from pathlib import Path
from carpus.core.calibration.result import Clicks
from carpus.core.calibration.clicks_file import write_clicks
from carpus.core.model.camera import Camera
from carpus.core.capture.camera_info import write_camera_info
from carpus.core.capture.files.tum import TumWriter
from carpus.core.capture.source import SourceInfo
from carpus.core.platform.durable import replace_file
from carpus.core.formats.export import FORMATS
from carpus.core.formats.output_files import write_new_text
from carpus.core.model.hand.protocols import WRIST6
import numpy as np
camera = Camera(500, 500, 320, 240)
for umask in ("000", "022", "277"):
    folder = Path(sys.argv[1]) / umask
    folder.mkdir()
    os.umask(int(umask, 8))
    write_clicks(folder / "clicks.json", Clicks("right", WRIST6, np.zeros((6, 2))))
    write_camera_info(folder / "camera.yaml", camera)
    replace_file(folder / "replaced", lambda part: part.write_text("x"))
    write_new_text(folder / "new.txt", "x")
    if umask != "277":  # which takes the folders that it makes from their owner
        TumWriter(folder / "tum", SourceInfo("x", camera, True, None, 30.0, {})).abandon()
    os.umask(0o022)
"""


def test_files_are_private_with_any_umask(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-c", WRITES, str(tmp_path)], cwd=ROOT, check=True, capture_output=True)
    for umask in ("000", "022", "277"):
        written = [path for path in (tmp_path / umask).rglob("*") if path.is_file()]
        assert len(written) >= 4
        assert {path.name: oct(mode(path)) for path in written if mode(path) != 0o600} == {}, umask


@pytest.mark.parametrize("name", ["/etc/hostname", "../../secret.png", "rgb/../../x.png", "rgb/a\0b.png"])
def test_list_of_frames_stays_in_its_folder(tmp_path: Path, name: str) -> None:
    from carpus.core.capture.files.tum import TumFolder

    (tmp_path / "rgb.txt").write_text(f"1.0 {name}\n")
    with pytest.raises(RecordingUnreadable, match="outside the folder"):
        TumFolder(tmp_path, requires_depth=False)


@pytest.mark.parametrize(
    "text",
    [
        "a = " + "[" * 3000 + "]" * 3000,
        "[screen]\ntext_scale = nan",
        "[screen]\ntext_scale = -1.0",
        "[live]\nrows_waiting = -1",
        "[detection]\nmarker_radius_m = inf",
        "[tracker]\n" + "x = " + "9" * 5000,
        '[recording]\nfolder = "a\\u0000b"',
        "\udcff",
    ],
)
def test_settings_invalid_are_reported_and_ignored(tmp_path: Path, text: str) -> None:
    (tmp_path / "settings.toml").write_bytes(text.encode("utf-8", "surrogateescape"))
    (tmp_path / "preferences.toml").write_text('[report]\ntherapist = "AB"\n')
    settings, faults = load_valid_settings(tmp_path)
    assert settings.report.therapist == "AB"
    assert [type(fault) for fault in faults] == [SettingsInvalid]
    (tmp_path / "settings.toml").write_text('[recording]\nfolder = "~nobody-at-all/x"\n')
    settings, faults = load_valid_settings(tmp_path)
    assert (settings.data_folder, faults) == (Path("~nobody-at-all/x"), []), "a home that nobody has"
