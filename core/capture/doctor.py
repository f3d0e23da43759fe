"""Examines what Carpus needs on this computer: one finding per need, each with a remedy where one is due."""

from __future__ import annotations

import ctypes
import ctypes.util
import multiprocessing
import os
import platform
import shutil
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from itertools import pairwise
from pathlib import Path
from typing import Literal

import numpy as np

from carpus.core.capture.openni2 import library_version, load_library
from carpus.core.capture.raw import MB_PER_MINUTE
from carpus.core.capture.xtion import XtionSource
from carpus.core.capture.xtion_usb import UsbCamera, usb_cameras
from carpus.core.errors import CameraBusy, CameraMissing, CameraPermission, CarpusFault, DriverMissing
from carpus.core.types import Frame

State = Literal["good", "warning", "bad"]

PACKAGES = ("numpy", "scipy", "opencv-python-headless", "h5py", "PyYAML", "platformdirs", "threadpoolctl")
WINDOW_LIBRARIES = ("GL", "EGL", "fontconfig", "dbus-1", "xkbcommon", "xcb-cursor")
PACKED_WITHOUT = ("GL", "EGL")
"""Of these what a packed program does not bring: they belong to the graphics card."""
RULES_FOLDERS = tuple(Path(root) / "udev/rules.d" for root in ("/etc", "/run", "/usr/lib", "/lib"))
LOW_DISK_BYTES = 2_000_000_000
NEEDED_MBIT = 480
WANTED_FPS = 29.0
NEEDED_FPS = 20.0
MEASURE_S = 3.0

_REMEDIES: dict[type[CarpusFault], str] = {
    CameraMissing: "Plug the camera in.",
    CameraBusy: "Close the other program that uses the camera.",
    CameraPermission: "Install the camera rights named above and plug the camera in again.",
}


@dataclass(frozen=True, slots=True)
class Finding:
    """One need. ``found`` is the fact; ``remedy`` what to do, empty when nothing is to be done."""

    name: str
    state: State
    found: str
    remedy: str = ""


def examine(data_folder: Path, *, camera_uri: str | None = None, measure_s: float = MEASURE_S) -> Iterator[Finding]:
    """All findings, each as soon as it is known; the camera is opened for ``measure_s`` seconds at the end."""
    yield python_finding(sys.version_info[:3])
    yield packages_finding()
    yield window_finding()
    yield fonts_finding()
    yield data_folder_finding(data_folder)
    yield disk_finding(data_folder, shutil.disk_usage(_existing(data_folder)).free)
    driver = driver_finding()
    yield driver
    if sys.platform.startswith("linux"):
        yield rules_finding(RULES_FOLDERS)
    cameras = usb_cameras()
    yield camera_finding(cameras)
    if driver.state == "good" and (cameras or camera_uri or not sys.platform.startswith("linux")):
        yield rates_finding(camera_uri, measure_s)


def examine_at_start(data_folder: Path) -> Iterator[Finding]:
    """What a person must know before the first session; nothing is opened, so it takes no time and disturbs nobody.

    ``data_folder`` need not be there yet. What only the window knows, its screen, is not among it.
    """
    on_linux = sys.platform.startswith("linux")
    if on_linux:  # elsewhere only opening it tells
        yield camera_finding(usb_cameras())
    yield driver_finding(asks_version=False)
    if on_linux:
        yield rules_finding(RULES_FOLDERS)
    yield data_folder_finding(data_folder)
    yield disk_finding(data_folder, shutil.disk_usage(_existing(data_folder)).free)
    yield fonts_finding()


def python_finding(found: tuple[int, int, int]) -> Finding:
    """Python itself."""
    text = ".".join(map(str, found)) + f", {platform.system()} {platform.machine()}"
    if found < (3, 11, 0):
        return Finding("Python", "bad", text, "Install Python 3.11 or newer and install Carpus with it.")
    return Finding("Python", "good", text)


def packages_finding(names: tuple[str, ...] = PACKAGES) -> Finding:
    """The packages that every command needs."""
    known, missing = [], []
    for name in names:
        try:
            known.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            missing.append(name)
    if missing:
        return Finding("Packages", "bad", "missing: " + ", ".join(missing), "Run: pip install " + " ".join(missing))
    return Finding("Packages", "good", ", ".join(known))


def window_finding() -> Finding:
    """What the desktop window needs, found out without loading it."""
    try:
        qt = version("PySide6-Essentials")
        version("pyqtgraph")
    except PackageNotFoundError as cause:
        return Finding("Window", "warning", f"missing: {cause.name}", f"For the window, run: pip install {cause.name}")
    if tuple(int(part) for part in qt.split(".")[:2]) >= (6, 12) and sys.version_info < (3, 12):
        remedy = 'This version stops the program on Python 3.11. Run: pip install "PySide6-Essentials<6.12"'
        return Finding("Window", "bad", f"Qt {qt}", remedy)
    if not sys.platform.startswith("linux"):
        return Finding("Window", "good", f"Qt {qt}")
    is_packed = getattr(sys, "frozen", False)
    wanted = PACKED_WITHOUT if is_packed else WINDOW_LIBRARIES
    missing = [name for name in wanted if ctypes.util.find_library(name) is None]
    if missing:
        remedy = "Install the packages that bring these libraries."
        remedy = remedy if is_packed else f"Run: installer/setup.sh run. Or: {remedy[0].lower()}{remedy[1:]}"
        return Finding("Window", "warning", f"Qt {qt}; missing: " + ", ".join(f"lib{name}" for name in missing), remedy)
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or os.environ.get("QT_QPA_PLATFORM")):
        remedy = "Start the window from a desktop. The commands for files work without a screen."
        return Finding("Window", "warning", f"Qt {qt}; no screen", remedy)
    return Finding("Window", "good", f"Qt {qt}")


def fonts_finding() -> Finding:
    """The typefaces that come with Carpus."""
    folder = files("carpus.resources").joinpath("fonts")
    faces = [each.name for each in folder.iterdir() if each.name.endswith(".otf")] if folder.is_dir() else []
    if not faces:
        return Finding("Fonts", "bad", "none of the program's own", "Install Carpus again: part of it is missing.")
    return Finding("Fonts", "good", f"{len(faces)} faces")


def data_folder_finding(folder: Path) -> Finding:
    """Whether recordings can be stored, and nobody else can read them."""
    there = _existing(folder)
    if not os.access(there, os.W_OK | os.X_OK) or not there.is_dir():
        remedy = "Give yourself the right to write there, or choose another folder in the settings."
        return Finding("Data folder", "bad", f"{folder}: {there} cannot be written to", remedy)
    if not folder.exists():
        return Finding("Data folder", "good", f"{folder}, made at the first recording")
    if os.name == "posix" and folder.stat().st_mode & 0o077:
        remedy = (
            "Others on this computer can look into it. In its properties, take away every right of the group and of "
            f"others; or run: chmod 700 '{folder}'"
        )
        return Finding("Data folder", "warning", str(folder), remedy)
    return Finding("Data folder", "good", str(folder))


def disk_finding(folder: Path, free_bytes: int) -> Finding:
    """Room for recordings."""
    minutes = free_bytes / (1e6 * MB_PER_MINUTE)
    text = f"{free_bytes / 1e9:.1f} GB free, about {minutes:.0f} minutes with pictures"
    if free_bytes < LOW_DISK_BYTES:
        return Finding("Disk", "warning", text, f"Free space on the disk of {_existing(folder)}.")
    return Finding("Disk", "good", text)


def driver_finding(*, asks_version: bool = True) -> Finding:
    """The OpenNI2 library; loaded, but not started. ``asks_version``, in a process of its own, takes half a second."""
    try:
        load_library()
    except DriverMissing as fault:
        remedy = (
            "Run: sudo apt-get install libopenni2-0"
            if sys.platform.startswith("linux")
            else "Install OpenNI2 from the camera's maker, then start Carpus again."
        )
        return Finding(
            "Driver", "bad", fault.detail or "not found", f"Needed for live cameras and .oni files. {remedy}"
        )
    if not asks_version:
        return Finding("Driver", "good", "OpenNI2")
    try:
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as other:
            return Finding("Driver", "good", f"OpenNI2 {other.submit(library_version).result()}")
    except BrokenProcessPool:
        return Finding("Driver", "bad", "OpenNI2 ends when it is asked for its version", "Install it again.")


def rules_finding(folders: tuple[Path, ...]) -> Finding:
    """Whether the system lets everybody open the camera."""
    for folder in folders:
        for rules in sorted(folder.glob("*.rules")) if folder.is_dir() else []:
            if "1d27" in rules.read_text(encoding="utf-8", errors="replace").lower():
                return Finding("Camera rights", "good", str(rules))
    remedy = "Run: sudo apt-get install libopenni2-0, which brings them. Then plug the camera in again."
    return Finding("Camera rights", "warning", "no udev rules for the camera", remedy)


def camera_finding(cameras: list[UsbCamera]) -> Finding:
    """The camera on the bus, before anything opens it."""
    if not cameras:
        remedy = (
            "Plug the camera in, at best straight into the computer. It needs a USB 2 port; some USB 3 ports refuse "
            "cameras with old firmware."
        )
        return Finding("Camera", "warning", "none plugged in", remedy)
    camera = cameras[0]
    text = f"{camera.name} (1d27:{camera.product}) at {camera.node}, {camera.speed_mbit} Mbit/s"
    if not camera.may_open:
        remedy = f"You may not open {camera.node}. Install the camera rights named above and plug it in again."
        return Finding("Camera", "bad", text, remedy)
    if camera.is_claimed:
        return Finding("Camera", "warning", f"{text}, in use", "Close the other program that uses the camera.")
    if 0 < camera.speed_mbit < NEEDED_MBIT:
        return Finding("Camera", "bad", text, "This port is too slow. Plug the camera into a USB 2 or USB 3 port.")
    return Finding("Camera", "good", text)


def rates_finding(uri: str | None, measure_s: float) -> Finding:
    """What really comes from the camera."""
    frames: list[Frame] = []
    try:
        source = XtionSource(uri=uri, patience_s=0.0)
    except CarpusFault as fault:
        return Finding("Pictures", "bad", _fault_text(fault), _open_remedy(fault))
    ending = threading.Timer(measure_s + 2.0, source.close)
    ending.start()
    start_s = time.monotonic()
    try:
        for frame in source.frames():
            frames.append(frame)
            if time.monotonic() - start_s > measure_s:
                break
    except CarpusFault as fault:
        return Finding("Pictures", "bad", _fault_text(fault), _open_remedy(fault))
    finally:
        ending.cancel()
        source.close()
        ending.join()
    return frames_finding(frames, source.info.settings.get("registered", ""))


def frames_finding(frames: list[Frame], registered: str) -> Finding:
    """Rate, gaps and depth of some seconds of frames."""
    if len(frames) < 2:
        remedy = "Plug the camera in again, into another port, without a hub."
        return Finding("Pictures", "bad", f"{len(frames)} frames", remedy)
    gaps_s = np.array([later.timestamp_s - earlier.timestamp_s for earlier, later in pairwise(frames)])
    fps = 1.0 / float(gaps_s.mean())
    missing = sum(frame.dropped_before for frame in frames)
    with_depth = sum(frame.depth_raw is not None for frame in frames)
    height, width = frames[0].color_rgb.shape[:2]
    text = f"{width}x{height}, {fps:.1f} fps, {missing} missing, depth in {with_depth} of {len(frames)}"
    remedy = "Use another USB port, without a hub and without other cameras on it; end other heavy programs."
    if fps < NEEDED_FPS or with_depth < len(frames) // 2:
        return Finding("Pictures", "bad", text, remedy)
    if fps < WANTED_FPS or missing:
        return Finding("Pictures", "warning", text, remedy + " In a dark room the camera slows down: add light.")
    if registered == "no":
        remedy = "This camera does not lay depth on colour by itself; depths will be read beside the markers."
        return Finding("Pictures", "warning", text + ", depth not registered", remedy)
    return Finding("Pictures", "good", text)


def _fault_text(fault: CarpusFault) -> str:
    return f"{type(fault).__name__} {fault.detail}".strip()


def _open_remedy(fault: CarpusFault) -> str:
    return _REMEDIES.get(type(fault), "Plug the camera in again, into another port, without a hub.")


def _existing(folder: Path) -> Path:
    """``folder`` or the nearest folder above it that is there."""
    return next((each for each in (folder, *folder.parents) if each.exists()), Path.cwd())
