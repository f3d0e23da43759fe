"""What grows by one line, done in a copy: a further marker protocol is simulated, tracked, stored, read
back, exported, reported on and tracked again."""

from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import sys
from importlib import import_module
from inspect import signature
from pathlib import Path

import pytest

from carpus.core.capture.devices.cameras import CAMERAS, load_camera_kind, parse_kind
from carpus.core.formats.export import FORMATS
from carpus.core.model.hand.exercises import EXERCISES, exercises_for_protocol, get_exercise
from carpus.core.model.hand.protocols import PALM_MARKERS, PROTOCOLS, MarkerProtocol, protocol_names
from carpus.core.simulation.motions import MOTIONS
from tests.sources import ROOT, nodes

GIVEN = {"uri", "camera", "patience_s", "notice"}
"""What a camera's opening is given."""

BEFORE = "(WRIST6, HAND21)"
FURTHER = "MarkerProtocol('fingers18', PALM_MARKERS + tuple(name for chain in CHAIN_NAMES[1:] for name in chain[2:]))"

WALK = """
import json
from pathlib import Path

import carpus
import numpy as np
from carpus.app.__main__ import main
from carpus.core.model.hand.protocols import get_protocol
from carpus.core.model.hand.exercises import exercises_for_protocol
from carpus.ui.words.terms import protocol_name


def done(*arguments):
    assert main([str(one) for one in arguments]) == 0, arguments


if __name__ == "__main__":
    protocol = get_protocol("fingers18")
    assert [one.id for one in exercises_for_protocol(protocol)] == ["FIST_COMPOSITE", "FIST_HOOK", "FINGER_ABAD"]
    assert protocol_name(protocol) == "Some fingers · 18 markers"
    done("simulate", "--output", "take", "--protocol", "fingers18", "--motion", "fist", "--seconds", "1.2",
         "--fps", "15", "--seed", "4")
    clicks = json.loads(Path("take/calibration.json").read_text(encoding="utf-8"))["markers"]
    proposed = carpus.propose_clicks("take", protocol="fingers18").markers
    assert len(proposed) >= 12
    assert all(np.hypot(*np.subtract(pixel, clicks[name])) < 6.0 for name, pixel in proposed.items()), proposed
    done("track", "take", "--calibration", "take/calibration.json", "--exercise", "FIST_COMPOSITE", "--output", "s.h5")
    session, truth = carpus.open_session("s.h5"), carpus.open_session("take/truth.h5")
    names = protocol.joint_names()
    assert session.header.joint_names == truth.header.joint_names == names and len(names) == 12
    assert session.motion.joint_position_m.shape[1:] == session.markers.position_cam_m.shape[1:] == (18, 3)
    assert (session.status == 0).all()
    for motion in (session.motion, session.smoothed):
        off = np.degrees(motion.joint_angles_rad - truth.motion.joint_angles_rad)
        assert np.sqrt((off**2).mean()) < 4.0, off
    assert session.quality.measured_share.shape[1] == 12
    of = {row.of for row in session.measures()}
    assert {"TAM3", *names} <= of and not of & {"TAM1", "MCP1_flexion", "CMC1_abduction"}, of
    done("export", "s.h5", "--format", "csv,c3d,mot,bids,h5", "--output", "out")
    copy = carpus.open_session("out/s.h5")
    assert np.array_equal(copy.motion.joint_angles_rad, session.motion.joint_angles_rad)
    table = Path("out/s.joints.for-programs.csv").read_text(encoding="utf-8")
    assert "PIP5_flexion" in table and "CMC1" not in table
    done("report", "s.h5", "--output", "report.pdf")
    done("track", "s.h5", "--output", "again.h5")
"""


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The program with one more protocol in the line where they are registered."""
    folder = tmp_path_factory.mktemp("grown")
    shutil.copytree(ROOT / "carpus", folder / "carpus", symlinks=True)
    (folder / "core").mkdir()
    for part in ("app", "ui", "resources"):
        (folder / part).symlink_to(ROOT / part)
    for part in (ROOT / "core").iterdir():
        if part.name != "model":
            (folder / "core" / part.name).symlink_to(part)
    model = folder / "core" / "model"
    shutil.copytree(ROOT / "core" / "model", model, ignore=shutil.ignore_patterns("__pycache__"))
    register = model / "hand" / "protocols.py"
    text = register.read_text(encoding="utf-8")
    assert text.count(BEFORE) == 1
    register.write_text(text.replace(BEFORE, BEFORE.replace(")", f", {FURTHER})")), encoding="utf-8")
    return folder


def test_marker_protocol_is_one_registered_line(copy: Path, tmp_path: Path) -> None:
    script = tmp_path / "walk.py"
    script.write_text(WALK, encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": str(copy), "QT_QPA_PLATFORM": "offscreen", "CARPUS_DEBUG": "1"}
    walked = subprocess.run(
        [sys.executable, str(script)], cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=170
    )
    assert walked.returncode == 0, walked.stdout[-2000:] + walked.stderr[-4000:]


def test_registered_lines_lead_to_their_files() -> None:
    for name, form in FORMATS.items():
        assert callable(import_module(f"carpus.core.formats.{form.module}").write), name
    for name in CAMERAS:
        kind = load_camera_kind(name)
        taken = signature(kind.open).parameters
        assert set(taken) >= GIVEN, name
        assert {key for key, one in taken.items() if one.default is one.empty} <= GIVEN, f"{name} needs what none gives"
        assert all(len(vendor) == len(product) == 4 for vendor, product in kind.models), name
        assert all((kind.title, kind.udev_rules, kind.port_advice)), name
        assert parse_kind(f"{name}:1") == name
    assert parse_kind("") == parse_kind("1d27/0601@1/2") == next(iter(CAMERAS)), "what an older settings file says"
    assert len(set(protocol_names())) == len(PROTOCOLS)
    for protocol in PROTOCOLS:
        assert exercises_for_protocol(protocol), protocol.name
    assert {one.id for protocol in PROTOCOLS for one in exercises_for_protocol(protocol)} == {
        one.id for one in EXERCISES
    }
    assert len({one.id for one in EXERCISES}) == len(EXERCISES)
    assert get_exercise("one of old").id == "FREE", "the last of them"
    assert {one.simulated_motion for one in EXERCISES} - set(MOTIONS) == set(), (
        "movements that the simulated patient does not know"
    )
    joints = {one.id: one.joint for one in EXERCISES if one.joint and one.joint not in one.protocol.joint_names()}
    assert joints == {}, "joints that their discs do not have"


REACHED_OTHERWISE = {
    "app.commands": "by the name of a command",
    "core.records.migrations": "by Alembic",
}


IMPORTS = r"from (?:cython\.cimports\.)?carpus\.([\w.]+) import (\([^)]*\)|[^\n]*)"


def test_modules_are_all_registered_or_imported() -> None:
    """A new file without its line would be heard of by nobody."""
    files = {
        ".".join(path.relative_to(ROOT).with_suffix("").parts): path.read_text(encoding="utf-8")
        for part in ("app", "core", "ui")
        for path in (ROOT / part).rglob("*.py")
    }
    reached: set[str] = set()
    for source in [*files.values(), (ROOT / "carpus" / "__init__.py").read_text(encoding="utf-8")]:
        for module, names in re.findall(IMPORTS, source):
            reached |= {module, *(f"{module}.{name}" for name in re.findall(r"\w+", names))}
        reached |= set(re.findall(r"import carpus\.([\w.]+)", source))
    reached |= {f"core.formats.{form.module}" for form in FORMATS.values()}
    reached |= {f"core.capture.devices.{module}" for module in CAMERAS.values()}
    alone = {name for name in files if name.rpartition(".")[2] not in ("__init__", "__main__")} - reached
    assert {name for name in alone if not name.startswith(tuple(REACHED_OTHERWISE))} == set()


def test_growth_table_names_existing_places() -> None:
    page = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    table = page.partition("| a new |")[2].partition("\n\n")[0]
    told = re.findall(r"((?:`\w+`(?:,| and)? )+)(?:in|of) `(\w+/[\w/]+\.py)`", table)
    assert len(told) > 10
    for names, path in told:
        there = {
            name.id if isinstance(name, ast.Name) else name.name
            for name in nodes(ROOT / path)
            if isinstance(name, ast.Name | ast.FunctionDef | ast.ClassDef)
        }
        assert set(re.findall(r"\w{2,}", names)) - {"and"} <= there, (names, path)


@pytest.mark.parametrize("markers", [("WRIST", "CMC1"), (*PALM_MARKERS, "TIP3"), (*PALM_MARKERS, "ELBOW")])
def test_discs_that_cannot_be_tracked_make_no_protocol(markers: tuple[str, ...]) -> None:
    with pytest.raises(ValueError, match="odd"):
        MarkerProtocol("odd", markers)
