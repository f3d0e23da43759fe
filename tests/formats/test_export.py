"""Many sessions into one folder: nothing overwritten, nobody found in a de-identified one, and it comes back."""

from __future__ import annotations

import errno
import uuid
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from carpus.core.formats import export
from carpus.core.formats.export import FORMATS, ExportRequest
from carpus.core.formats.export_provenance import Deidentifier, reproject_pixels
from carpus.core.model.camera import Camera
from carpus.core.model.errors import OutputExists, OutputNotWritable, SessionUnreadable
from carpus.core.model.hand.protocols import HAND21
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.reader import read_detections, read_session
from carpus.core.session.writer import SessionWriter
from tests.formats.takes import store_session
from tests.session.samples import begin_session, make_header

export_sessions = export.export_sessions


@pytest.mark.parametrize("deidentified", [False, True])
def test_export_all_formats_reimport_gives_same_charts(deidentified: bool, tmp_path: Path) -> None:
    path = store_session(tmp_path, HAND21)
    done = export_sessions([ExportRequest.from_file(path)], tmp_path / "out", list(FORMATS), deidentified=deidentified)
    assert not done.refused
    (copy,) = (tmp_path / "out").glob("*.h5")
    old, new = read_session(path), read_session(copy)
    start_s = old.timestamp_s[0] if deidentified else 0.0
    assert np.allclose(new.timestamp_s, old.timestamp_s - start_s, atol=1e-6)
    for name in ("angles_rad", "joint_angles_rad", "joint_angles_sd_rad", "rotation_w2_w0", "joint_position_m"):
        assert np.array_equal(getattr(new.motion, name), getattr(old.motion, name), equal_nan=True)
    seen = read_detections(path).blobs.pixel
    if deidentified:
        seen = reproject_pixels(seen, old.camera, new.camera)
    assert np.allclose(read_detections(copy).blobs.pixel, seen, atol=1e-3)
    mine, theirs = compute_session_results(old), compute_session_results(new)
    for one, other in zip(mine.measures_in_group("range"), theirs.measures_in_group("range"), strict=True):
        assert (one.key, one.count) == (other.key, other.count)
        assert np.allclose(one.mean, other.mean, atol=1e-4, equal_nan=True)


def test_export_to_read_only_disk_reports_each_session(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuses(*_: object, **__: object) -> None:
        raise OSError(errno.EROFS, "Read-only file system")

    wanted = [ExportRequest.from_file(store_session(tmp_path, name=name)) for name in ("one", "two")]
    (tmp_path / "out").mkdir()
    monkeypatch.setattr(Path, "unlink", refuses)
    monkeypatch.setattr(SessionWriter, "create", lambda path, *_: (_ for _ in ()).throw(OutputNotWritable(path)))
    for kind in ("h5", "csv"):
        refused = export_sessions(wanted, tmp_path / "out", [kind]).refused
        assert [type(one.fault) for one in refused] == [OutputNotWritable] * 2


def test_export_deidentified_contains_no_identity(tmp_path: Path) -> None:
    path = store_session(tmp_path)
    export_sessions([ExportRequest.from_file(path)], tmp_path / "out", list(FORMATS), deidentified=True)
    header = read_session(path).header
    secret = ["Linden", "Miller", "clinic-cam", "A00365", "2026-11-13", "20261113", header.session_id, "13050311"]
    files = [file for file in (tmp_path / "out").rglob("*") if file.is_file()]
    assert len(files) > 15
    for file in files:
        content = file.read_bytes()
        for text in secret:
            assert text.encode() not in content, (file.name, text)
            assert text not in str(file.relative_to(tmp_path / "out"))


def test_export_deidentified_cameras_are_alike(tmp_path: Path) -> None:
    cameras = (
        Camera(531.2, 529.8, 312.4, 247.1, distortion=(0.03, -0.1, 0.001, 0.002, 0.0)),
        Camera(523.9, 526.1, 325.7, 236.4, distortion=(0.05, -0.2, 0.0, 0.001, 0.1)),
    )
    path = store_session(tmp_path)
    session, said = read_session(path), []
    place = session.markers.position_cam_m[0]
    for camera in cameras:
        said.append(Deidentifier().deidentify(replace(session, camera=camera)).camera)
        moved = reproject_pixels(camera.distort(camera.project(place)), camera, said[-1])
        assert np.allclose(moved, said[-1].project(place), atol=0.05)
    assert said[0] == said[1]
    export_sessions([ExportRequest.from_file(path)], tmp_path / "out", ["h5", "json"], deidentified=True)
    (copy,) = (tmp_path / "out").glob("*.h5")
    camera = read_session(copy).camera
    assert (camera.fx_px, camera.cx_px, camera.is_distorted) == (575.0, 319.5, False)
    (text,) = (tmp_path / "out").glob("*.json")
    assert f"{session.camera.fx_px}" not in text.read_text(encoding="utf-8")


def test_export_deidentified_patient_consistent_days_counted(tmp_path: Path) -> None:
    paths = []
    for day in (20, 13):
        header = make_header(session_id=uuid.uuid4())
        header = replace(header, recorded=f"2026-11-{day}T09:00:00+01:00", recording_id=str(uuid.uuid4()))
        paths.append(tmp_path / f"day{day}.h5")
        begin_session(paths[-1], header, 1).close()
    export_sessions([ExportRequest.from_file(path) for path in paths], tmp_path / "out", ["h5"], deidentified=True)
    found = [read_session(path).header for path in sorted((tmp_path / "out").glob("*.h5"))]
    assert len({header.subject_id for header in found}) == 1
    assert [header.recorded[:10] for header in found] == ["1900-01-01", "1900-01-08"]
    assert len({header.session_id for header in found}) == 2


def test_export_never_overwrites_and_continues(tmp_path: Path) -> None:
    good, missing = store_session(tmp_path), tmp_path / "missing.h5"
    heard: list[tuple[int, int]] = []
    done = export_sessions(
        [ExportRequest.from_file(missing), ExportRequest.from_file(good)],
        tmp_path / "out",
        ["mot", "json"],
        progress=lambda *at: heard.append(at),
    )
    assert [refused.path for refused in done.refused] == [missing]
    assert isinstance(done.refused[0].fault, SessionUnreadable)
    assert heard[-1] == (2, 4)
    before = {path: path.read_bytes() for path in done.files}
    again = export_sessions([ExportRequest.from_file(good)], tmp_path / "out", ["mot"])
    assert isinstance(again.refused[0].fault, OutputExists)
    assert {path: path.read_bytes() for path in done.files} == before
    assert not list((tmp_path / "out").rglob("*.half"))


def test_export_equal_names_get_numbers(tmp_path: Path) -> None:
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
    paths = [store_session(tmp_path / "a"), store_session(tmp_path / "b")]
    export_sessions([ExportRequest.from_file(path) for path in paths], tmp_path / "out", ["c3d"])
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"one.c3d", "one-2.c3d"}


def test_export_cancelled_stops(tmp_path: Path) -> None:
    asked = iter((False, True))
    done = export_sessions(
        [ExportRequest.from_file(store_session(tmp_path))],
        tmp_path / "out",
        ["mot", "trc"],
        cancelled=lambda: next(asked),
    )
    assert done.cancelled
    assert {path.suffix for path in done.files} == {".mot", ".json", ".txt"}
