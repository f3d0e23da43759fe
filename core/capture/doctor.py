"""Checks of what Carpus needs on this computer: one finding per need, with a remedy if one is due."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import platform
import shutil
import sys
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from itertools import pairwise
from pathlib import Path

import numpy as np

from carpus.core.capture.devices.cameras import (
    CAMERAS,
    CameraKind,
    UsbCamera,
    choose_kind,
    load_camera_kind,
    open_camera,
    parse_kind,
)
from carpus.core.capture.files.raw import MB_PER_MINUTE
from carpus.core.capture.source import SourceInfo
from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.model.fault_text import format_fault
from carpus.core.model.installation import Finding, State, install_hint, is_packed
from carpus.core.model.phrase import phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import Frame
from carpus.core.platform.disks import check_disk_encryption, detect_encryption

PACKAGES = ("numpy", "scipy", "opencv-python-headless", "h5py", "PyYAML", "platformdirs", "threadpoolctl")
WINDOW_LIBRARIES = ("GL", "EGL", "fontconfig", "dbus-1", "xkbcommon", "xcb-cursor")
SYSTEM_LIBRARIES = ("GL", "EGL")
"""Libraries that a packaged program does not bring: they belong to the graphics card."""
RULES_FOLDERS = tuple(Path(root) / "udev/rules.d" for root in ("/etc", "/run", "/usr/lib", "/lib"))
RULE_FILE = "/etc/udev/rules.d/60-carpus-cameras.rules"
LOW_DISK_BYTES = 2_000_000_000
MIN_SPEED_MBIT = 480
MAX_CLOCK_DRIFT, CLOCK_TOLERANCE_S = 0.02, 0.3
GOOD_FPS = 29.0
MIN_FPS = 20.0
MEASURE_S = 3.0

_REMEDIES: dict[type[CarpusFault], str] = {
    errors.CameraMissing: phrase("Plug the camera in."),
    errors.CameraMismatch: phrase("Plug in the camera named in the settings, or change the settings."),
    errors.CameraBusy: phrase("Close the other program that uses the camera."),
    errors.CameraPermission: phrase("Install the camera permissions named above and plug the camera in again."),
    errors.CameraLost: phrase("Plug the camera in again, into another port, without a hub."),
}
"""Remedies that are more specific here than the general texts."""


def examine(data_folder: Path, *, camera_uri: str | None = None, measure_s: float = MEASURE_S) -> Iterator[Finding]:
    """Yield all findings; at the end the camera is opened for ``measure_s`` seconds."""
    system = f"{platform.python_version()}, {platform.system()} {platform.machine()}"
    yield Finding(phrase("Python"), "good", system)
    yield check_packages()
    yield check_compiled_parts()
    yield check_window()
    yield check_fonts()
    yield check_data_folder(data_folder)
    yield check_disk_space(data_folder, shutil.disk_usage(_existing_ancestor(data_folder)).free)
    yield check_disk_encryption(detect_encryption(data_folder))
    on_linux = sys.platform.startswith("linux")
    named = parse_kind(camera_uri) if camera_uri else ""
    yield from check_drivers(loads_library=True, wanted_kind=named)
    if on_linux:
        yield from check_permissions(RULES_FOLDERS, wanted_kind=named)
    plugged_in = [(kind, camera) for kind in _camera_kinds() for camera in kind.find_connected()]
    if on_linux:  # other systems do not list cameras
        yield from check_cameras(plugged_in, named)
    if plugged_in or camera_uri or not on_linux:
        yield from check_open_camera(camera_uri or "", measure_s)


def examine_at_start(data_folder: Path, *, needs_camera: bool = True) -> Iterator[Finding]:
    """Yield the findings that matter before the first session; nothing is opened.

    ``data_folder`` may not exist yet. The window adds its own check of the screen.
    """
    on_linux = needs_camera and sys.platform.startswith("linux")
    if on_linux:  # other systems do not list cameras
        yield from check_cameras([(kind, camera) for kind in _camera_kinds() for camera in kind.find_connected()])
    if needs_camera:
        yield from check_drivers(loads_library=False)
    if on_linux:
        yield from check_permissions(RULES_FOLDERS)
    yield check_data_folder(data_folder)
    yield check_disk_space(data_folder, shutil.disk_usage(_existing_ancestor(data_folder)).free)
    yield check_fonts()


def check_packages() -> Finding:
    """Check the packages that every command needs."""
    known, missing = [], []
    for name in PACKAGES:
        try:
            known.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            missing.append(name)
    if missing:
        return Finding(phrase("Packages"), "bad", "missing: " + ", ".join(missing), install_hint(*missing))
    return Finding(phrase("Packages"), "good", ", ".join(known))


def check_compiled_parts() -> Finding:
    """Check that the compiled modules are there: without them tracking is impossible."""
    try:
        import_module("carpus.core.compiled")
    except errors.CompiledPartMissing as fault:
        missing = phrase("missing: {name}", name=fault.subject)
        return Finding(phrase("Compiled parts"), "bad", missing, phrase("Install Carpus again."))
    return Finding(phrase("Compiled parts"), "good", phrase("complete"))


def check_window() -> Finding:
    """Check what the desktop window needs, without loading it."""
    name = phrase("Window")
    try:
        qt = version("PySide6-Essentials")
        version("pyqtgraph")
    except PackageNotFoundError as cause:
        return Finding(name, "warning", phrase("missing: {name}", name=cause.name), install_hint(cause.name))
    if tuple(int(part) for part in qt.split(".")[:2]) >= (6, 12) and sys.version_info < (3, 12):
        found = phrase("Qt {qt}, which stops the program on Python 3.11", qt=qt)
        return Finding(name, "bad", found, install_hint('"PySide6-Essentials<6.12"'))
    if not sys.platform.startswith("linux"):
        return Finding(name, "good", f"Qt {qt}")
    wanted = SYSTEM_LIBRARIES if is_packed() else WINDOW_LIBRARIES
    missing = ", ".join(f"lib{library}" for library in wanted if ctypes.util.find_library(library) is None)
    if missing:
        remedy = phrase("Install the packages that contain these libraries.")
        if not is_packed():
            remedy = phrase("Run: installer/setup.sh run. Or: install the packages that contain these libraries.")
        return Finding(name, "warning", f"Qt {qt}; missing: {missing}", remedy)
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or os.environ.get("QT_QPA_PLATFORM")):
        remedy = phrase("Start Carpus from a desktop session. The commands for files work without a screen.")
        return Finding(name, "warning", phrase("Qt {qt}; no screen", qt=qt), remedy)
    return Finding(name, "good", f"Qt {qt}")


def check_fonts() -> Finding:
    """Check the typefaces that come with Carpus."""
    folder = files("carpus.resources").joinpath("fonts")
    faces = [each.name for each in folder.iterdir() if each.name.endswith(".otf")] if folder.is_dir() else []
    if not faces:
        remedy = phrase("Install Carpus again: part of it is missing.")
        return Finding(phrase("Fonts"), "bad", phrase("no fonts of Carpus"), remedy)
    return Finding(phrase("Fonts"), "good", phrase("{count} faces", count=len(faces)))


def check_data_folder(folder: Path) -> Finding:
    """Check that recordings can be stored, and that no other user can read them."""
    name, there = phrase("Data folder"), _existing_ancestor(folder)
    if not os.access(there, os.W_OK | os.X_OK) or not there.is_dir():
        found = phrase("{folder}: cannot write to {there}", folder=folder, there=there)
        return Finding(name, "bad", found, phrase("Allow writing there, or choose another folder in the settings."))
    if not folder.exists():
        return Finding(name, "good", phrase("{folder}, created at the first recording", folder=folder))
    if os.name == "posix" and folder.stat().st_mode & 0o077:
        remedy = phrase(
            "Others on this computer can read it. In its properties, remove all rights of the group and of others,"
            " or run: chmod 700 '{folder}'",
            folder=folder,
        )
        return Finding(name, "warning", str(folder), remedy)
    return Finding(name, "good", str(folder))


def check_disk_space(folder: Path, free_bytes: int) -> Finding:
    """Check the space for recordings."""
    free, minutes = (format_rounded(free_bytes / 1e9, 1), format_rounded(free_bytes / (1e6 * MB_PER_MINUTE)))
    text = phrase("{free} GB free, about {minutes} minutes with video", free=free, minutes=minutes)
    if free_bytes < LOW_DISK_BYTES:
        remedy = phrase("Free space on the disk of {folder}.", folder=_existing_ancestor(folder))
        return Finding(phrase("Disk"), "warning", text, remedy)
    return Finding(phrase("Disk"), "good", text)


def check_drivers(*, loads_library: bool, wanted_kind: str = "") -> Iterator[Finding]:
    """Check the libraries of all kinds of cameras.

    A bad library of another kind is only a warning if a connected or wanted kind needs none of it.
    """
    kinds = _camera_kinds()
    wanted = [
        bool(kind.find_connected()) or (wanted_kind != "" and kind is load_camera_kind(wanted_kind)) for kind in kinds
    ]
    for kind, is_wanted in zip(kinds, wanted, strict=True):
        finding = kind.check_driver(loads_library, is_wanted)
        if finding is None:
            continue
        if finding.state == "bad" and any(wanted) and not is_wanted:
            finding = replace(finding, state="warning")
        yield finding


def check_permissions(folders: tuple[Path, ...], *, wanted_kind: str = "") -> Iterator[Finding]:
    """Check that users may open the connected cameras and the wanted kind, else the default kind.

    Each kind is checked by its own rules, since a rule for one kind does not cover another.
    """
    asked = [
        kind
        for kind in _camera_kinds()
        if kind.find_connected() or (wanted_kind and kind is load_camera_kind(wanted_kind))
    ]
    for kind in asked or _camera_kinds()[:1]:
        yield check_udev_rules(kind, folders)


def check_udev_rules(kind: CameraKind, folders: tuple[Path, ...]) -> Finding:
    """Check that udev rules let users open a camera of this kind."""
    name = phrase("Camera permissions, {title}", title=kind.title)
    for folder in folders:
        for rules in sorted(folder.glob("*.rules")) if folder.is_dir() else []:
            text = rules.read_text(encoding="utf-8", errors="replace").lower()
            of_all = "idproduct" not in text and ("idvendor" in text or "id_vendor_id" in text)
            if any(vendor in text and (of_all or product in text) for vendor, product in kind.models):
                return Finding(name, "good", str(rules))
    remedy = phrase(
        "As root, write into {file}: {rule}. Run: udevadm control --reload. Then plug the camera in again.",
        file=RULE_FILE,
        rule=kind.udev_rules,
    )
    return Finding(name, "warning", phrase("no udev rules for the camera"), remedy)


def check_cameras(connected: list[tuple[CameraKind, UsbCamera]], wanted_kind: str = "") -> list[Finding]:
    """Check the cameras on the bus before any is opened."""
    if not connected:
        port = load_camera_kind(wanted_kind or parse_kind("")).port_advice
        remedy = phrase("Plug the camera in, preferably directly into the computer. {port}", port=port)
        return [Finding(phrase("Camera"), "warning", phrase("none plugged in"), remedy)]
    return [check_camera(kind, camera) for kind, camera in connected]


def check_camera(kind: CameraKind, camera: UsbCamera) -> Finding:
    """Check a camera on the bus before it is opened."""
    text = phrase(
        "{name} ({vendor}:{product}) at {node}, {speed_mbit} Mbit/s",
        name=camera.name,
        vendor=camera.vendor,
        product=camera.product,
        node=camera.node,
        speed_mbit=camera.speed_mbit,
    )
    state: State = "good"
    remedy = ""
    if not camera.can_open:
        state, remedy = "bad", phrase(
            "You have no permission to open {node}. Install the camera permissions named above, then plug "
            "the camera in again.",
            node=camera.node,
        )  # fmt: skip
    elif camera.is_claimed:
        text = phrase("{text}, in use", text=text)
        state, remedy = "warning", phrase("Close the other program that uses the camera.")
    elif 0 < camera.speed_mbit < MIN_SPEED_MBIT:
        state, remedy = "bad", phrase("This port is too slow. {port}", port=kind.port_advice)
    elif 0 < camera.speed_mbit < kind.needed_mbit:
        state, remedy = "warning", phrase("This port is slow for this camera. {port}", port=kind.port_advice)
    return Finding(phrase("Camera"), state, text, remedy)


def check_open_camera(uri: str, measure_s: float) -> list[Finding]:
    """Check frames and settings of the opened camera."""
    frames: list[Frame] = []
    arrived_s: list[float] = []
    try:
        source = open_camera(uri, patience_s=0.0)
    except CarpusFault as fault:
        return [_camera_fault_finding(fault, uri)]
    ending = threading.Timer(measure_s + 2.0, source.close)
    ending.start()
    start_s = time.monotonic()
    try:
        for frame in source.frames():
            frames.append(frame)
            arrived_s.append(time.monotonic())
            if time.monotonic() - start_s > measure_s:
                break
    except CarpusFault as fault:
        return [_camera_fault_finding(fault, uri)]
    finally:
        ending.cancel()
        source.close()
        ending.join()
    further = load_camera_kind(choose_kind(uri)).check_settings(source.info.settings)
    return [check_frames(frames), *check_camera_settings(source.info, frames, arrived_s), *further]


def check_frames(frames: list[Frame]) -> Finding:
    """Check rate, gaps and depth of some seconds of frames."""
    name = phrase("Frames")
    if len(frames) < 2:
        remedy = phrase("Plug the camera in again, into another port, without a hub.")
        return Finding(name, "bad", phrase("{count} frames", count=len(frames)), remedy)
    gaps_s = np.array([later.timestamp_s - earlier.timestamp_s for earlier, later in pairwise(frames)])
    fps = 1.0 / float(gaps_s.mean())
    missing = sum(frame.dropped_before for frame in frames)
    with_depth = sum(frame.depth_raw is not None for frame in frames)
    height, width = frames[0].color_rgb.shape[:2]
    text = phrase(
        "{width}x{height}, {fps} fps, {missing} missing, depth in {with_depth} of {count}",
        width=width,
        height=height,
        fps=format_rounded(fps, 1),
        missing=missing,
        with_depth=with_depth,
        count=len(frames),
    )
    remedy = phrase("Use another USB port, without a hub or other cameras. Close other demanding programs.")
    if fps < MIN_FPS or with_depth < len(frames) // 2:
        return Finding(name, "bad", text, remedy)
    if fps < GOOD_FPS or missing:
        remedy = phrase("{remedy} In a dark room the camera slows down: add light.", remedy=remedy)
        return Finding(name, "warning", text, remedy)
    return Finding(name, "good", text)


def check_camera_settings(info: SourceInfo, frames: list[Frame], arrived_s: list[float]) -> list[Finding]:
    """Check registration, mirroring and clock of a camera that ran for some seconds."""
    settings, findings = info.settings, []
    registered, name = settings.get("registered", ""), phrase("Depth registration")
    if registered == "no":
        remedy = phrase("This camera does not align depth with colour, so depths at the markers will be wrong.")
        findings.append(Finding(name, "warning", phrase("depth and colour are not aligned"), remedy))
    elif registered:
        found = phrase("depth and colour are aligned, {registered}", registered=registered)
        findings.append(Finding(name, "good", found))
    turned = settings.get("mirrored", "no") != "no"
    findings.append(Finding(phrase("Mirror"), "good", phrase("on; Carpus corrects it") if turned else phrase("off")))
    if len(frames) > 1:
        own_s, here_s = frames[-1].timestamp_s - frames[0].timestamp_s, arrived_s[-1] - arrived_s[0]
        findings.append(check_clock(own_s, here_s, settings.get("clock", "")))
    return findings


def check_clock(camera_s: float, computer_s: float, clock: str) -> Finding:
    """Check the camera's clock against the computer's; the tolerance covers the transfer of images."""
    own_s, here_s = format_rounded(camera_s, 2), format_rounded(computer_s, 2)
    text = phrase("camera clock {own_s} s, computer clock {here_s} s", own_s=own_s, here_s=here_s)
    remedy = ""
    if clock == "computer":
        remedy = phrase(
            "This camera sends no time stamps. Carpus uses the time at which each frame arrives, so "
            "speeds are approximate."
        )
    elif abs(camera_s - computer_s) > MAX_CLOCK_DRIFT * computer_s + CLOCK_TOLERANCE_S:
        remedy = phrase("Plug the camera in again. If this persists, times and speeds of this camera are not reliable.")
    return Finding(phrase("Clock"), "warning" if remedy else "good", text, remedy)


def _camera_kinds() -> list[CameraKind]:
    return [load_camera_kind(name) for name in CAMERAS]


def _camera_fault_finding(fault: CarpusFault, uri: str) -> Finding:
    """Return the finding for a fault of the camera; a missing driver has the remedy of its own check."""
    words = format_fault(fault)
    remedy = _REMEDIES.get(type(fault), words.remedy)
    if isinstance(fault, errors.DriverMissing | errors.ExtraMissing):
        driver = load_camera_kind(choose_kind(uri)).check_driver(False, True)
        remedy = driver.remedy if driver is not None and driver.remedy else remedy
    return Finding(phrase("Frames"), "bad", words.summary, remedy)


def _existing_ancestor(folder: Path) -> Path:
    return next((each for each in (folder, *folder.parents) if each.exists()), Path.cwd())
