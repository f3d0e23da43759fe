"""``carpus track --filter paper``: one preset, kept by the session, undone by the default filter."""

from __future__ import annotations

import json
from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.app.__main__ import main
from carpus.core.model.types import FloatArray, TrackStatus
from carpus.core.session.reader import read_session
from carpus.core.simulation.recording import CLICKS_FILE
from tests.rendered import LEFT_DEVIATION, Rendered


@pytest.fixture(scope="module")
def recording(rendered: Rendered) -> Path:
    return rendered(LEFT_DEVIATION)


def tracked(recording: Path, output: Path, *options: str) -> Path:
    assert main(["track", str(recording), *options, "--output", str(output)]) == 0
    return output


def first(recording: Path, output: Path, *options: str) -> Path:
    return tracked(recording, output, "--calibration", str(recording / CLICKS_FILE), *options)


@pytest.fixture(scope="module")
def by_paper(recording: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return first(recording, tmp_path_factory.mktemp("paper") / "once.h5", "--filter", "paper")


def angles(path: Path) -> FloatArray:
    with h5py.File(path) as file:
        return np.asarray(file["wrist/angles"])


def test_preset_is_stored_and_repeated(by_paper: Path, tmp_path: Path) -> None:
    session = read_session(by_paper)
    told = json.loads(session.header.parameters)["settings"]
    assert told["paper"]["palm"] == "flat"
    assert session.smoothed is None, "the papers do not look back"
    assert np.mean(session.status == TrackStatus.TRACKED) > 0.9
    assert np.nanmax(np.degrees(np.abs(session.motion.angles_rad[:, 0]))) > 10.0

    with h5py.File(by_paper) as file:
        rotation, translation = file["calibration/rotation"][()], file["calibration/translation"][()]
        wrist = file["wrist/position"][()] @ rotation.T + translation
        assert np.allclose(wrist, file["markers/position_camera"][:, 0], atol=1e-4, equal_nan=True)

    again = tracked(by_paper, tmp_path / "again.h5")
    assert np.array_equal(angles(again), angles(by_paper), equal_nan=True)
    assert json.loads(read_session(again).header.parameters)["settings"]["paper"] == told["paper"]
    brisk = tracked(by_paper, tmp_path / "brisk.h5", "--profile", "brisk")
    assert not np.array_equal(angles(brisk), angles(by_paper), equal_nan=True)


def test_two_filters_undo_each_other(recording: Path, by_paper: Path, tmp_path: Path) -> None:
    """Through the stored detections, to and fro: what each stands on is not what the other left."""
    default = first(recording, tmp_path / "default.h5", "--no-smooth")
    paper = tracked(default, tmp_path / "paper.h5", "--filter", "paper")
    with h5py.File(paper) as one, h5py.File(by_paper) as other, h5py.File(default) as known:
        assert np.allclose(one["calibration/rotation"], other["calibration/rotation"], atol=1e-7)
        assert not np.allclose(one["calibration/rotation"], known["calibration/rotation"], atol=1e-3)
        assert np.allclose(one["calibration/rotation"][()].T @ one["calibration/rotation"][()], np.eye(3))
    back = tracked(paper, tmp_path / "back.h5", "--filter", "default", "--no-smooth")
    assert np.degrees(np.abs(angles(back) - angles(default))).max() < 0.01
    with h5py.File(back) as one, h5py.File(default) as known:
        assert np.allclose(one["calibration/rotation"], known["calibration/rotation"], atol=1e-6)
        assert np.allclose(one["calibration/marker_position"], known["calibration/marker_position"], atol=1e-6)


@pytest.mark.parametrize("option", [("--depth",), ("--dip", "free"), ("--discs", "on-skin"), ("--smooth",)])
def test_papers_unsupported_options_are_errors(
    option: tuple[str, ...], recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["track", str(recording), "--calibration", str(recording / CLICKS_FILE), "--filter", "paper", *option]
    assert main([*words, "--output", str(tmp_path / "s.h5")]) == 2
    assert " ".join(option) in capsys.readouterr().err
    assert not (tmp_path / "s.h5").exists()


def test_papers_colour_only_gives_a_warning(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    once = first(recording, tmp_path / "once.h5", "--filter", "paper", "--no-depth", "--no-smooth", "--dip", "coupled")
    assert capsys.readouterr().err.count("mirror image") == 1
    tracked(once, tmp_path / "again.h5")
    assert capsys.readouterr().err.count("mirror image") == 1
