"""What is missing is told with what to do, from source by pip and in the packed program never by it."""

from __future__ import annotations

import shlex
import sys
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import pytest

from carpus.core.capture import doctor
from carpus.core.capture.devices import orbbec, realsense
from carpus.core.capture.devices.cameras import CAMERAS, format_udev_rules, load_camera_kind
from carpus.core.model.errors import ExtraMissing
from carpus.core.model.fault_text import format_fault_line
from carpus.core.model.installation import CAMERAS_EXTRA, install_hint


def missing(name: str) -> str:
    raise PackageNotFoundError(name)


def test_install_hint_from_source_is_a_command() -> None:
    line = install_hint("pylsl").removeprefix("Run “").removesuffix("”.")
    assert shlex.split(line) == [sys.executable, "-m", "pip", "install", "pylsl"]
    assert "--no-deps" in install_hint("pyorbbecsdk2"), "its own needs would break what Carpus runs on"


def test_install_hint_packed_never_names_pip(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    monkeypatch.setattr("importlib.metadata.version", missing)
    monkeypatch.setattr(doctor, "version", missing)
    packages = ("pyorbbecsdk2", "pyrealsense2", "pyarrow", "pylsl", "distributed")
    said = [format_fault_line(ExtraMissing(name)) for name in packages]
    findings = [kind.check_driver(False, True) for kind in (realsense.KIND, orbbec.KIND)]
    findings += [doctor.check_packages(), doctor.check_window()]
    said += [finding.remedy for finding in findings if finding is not None]
    assert all(said)
    assert not [text for text in said if "pip" in text.split()]
    if sys.platform.startswith("linux"):
        assert all(CAMERAS_EXTRA in text for text in said[:2])


def test_udev_rules_cover_every_camera(tmp_path: Path) -> None:
    (tmp_path / "60-carpus-cameras.rules").write_text(format_udev_rules(), encoding="utf-8")
    kinds = [load_camera_kind(name) for name in CAMERAS]
    assert [doctor.check_udev_rules(kind, (tmp_path,)).state for kind in kinds] == ["good"] * len(kinds)
    for kind in kinds:
        assert all(product in kind.udev_rules for _, product in kind.models)
