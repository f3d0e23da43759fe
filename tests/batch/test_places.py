"""Which recordings a batch finds, and where their sessions go."""

from __future__ import annotations

from pathlib import Path

from carpus.app.sources import is_batch, is_recording, plan_inputs


def folder_of(root: Path, *names: str) -> Path:
    for name in names:
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    return root


def names(found) -> list[tuple[str, str]]:  # type: ignore[no-untyped-def]
    return [(place.recording.name, place.name) for place in found]


def test_folder_is_searched(tmp_path: Path) -> None:
    root = folder_of(
        tmp_path / "in", "b/rgb.txt", "b/depth.txt", "a/c/rgb.txt", "a/x.oni", "a/y.carpusraw", "a/old.h5",
        "a/notes.txt", "sim/truth.h5", ".hidden/rgb.txt", "out/z.oni",
    )  # fmt: skip
    found = plan_inputs([root], root / "out")
    assert names(found) == [
        ("c", "a/c.h5"), ("x.oni", "a/x.h5"), ("y.carpusraw", "a/y.h5"), ("b", "b.h5"),
    ]  # fmt: skip
    assert [place.session for place in found] == [root / "out" / place.name for place in found]
    by_name = {place.name: place.clicks for place in found}
    assert by_name["a/c.h5"] == root / "a/c/calibration.json"
    assert by_name["a/x.h5"] == root / "a/x.calibration.json"


def test_named_recording_counts_once_in_order(tmp_path: Path) -> None:
    root = folder_of(tmp_path, "p1/rec/rgb.txt", "p2/rec/rgb.txt", "p3/s.h5", "p2/rec.oni")
    named = [root / "p1/rec", root / "p2", root / "p2/rec", root / "p3/s.h5", root / "gone"]
    found = plan_inputs(named, root / "out")
    assert names(found) == [
        ("rec", "p1/rec.h5"), ("rec", "p2/rec.h5"), ("rec.oni", "p2/rec.oni.h5"), ("s.h5", "p3/s.h5"),
        ("gone", "gone.h5"),
    ]  # fmt: skip
    assert found[3].clicks is None
    assert len({place.session for place in found}) == len(found)


def test_recordings_of_one_or_many_paths(tmp_path: Path) -> None:
    root = folder_of(tmp_path, "in/a/rgb.txt", "s.h5")
    (root / "there").mkdir()
    assert is_batch([root / "in/a", root / "s.h5"], root / "x")
    assert is_batch([root / "in"], root / "out")
    assert is_batch([root / "in/a"], root / "there")
    assert not is_batch([root / "in/a"], root / "out")
    assert not is_batch([root / "in/a"], root / "new.h5")
    assert not is_batch([root / "in"], root / "new.h5")
    assert is_recording(root / "in/a")
    assert not is_recording(root / "in")
