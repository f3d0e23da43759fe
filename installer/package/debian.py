"""What a Debian package says and where its files lie; the packing itself is :mod:`build`'s."""

from __future__ import annotations

import gzip
from collections.abc import Mapping
from datetime import datetime
from email.utils import format_datetime
from pathlib import Path

CAMERAS_EXTRA = "carpus-cameras-extra"
MAINTAINER = "The Carpus developers <carpus@localhost>"

# On Debian 12, 13 and Ubuntu 24.04 by these names (Ubuntu's t64 packages provide them). The packed folder brings all
# else, but nothing that a library of the system, such as OpenNI2, needs as new as itself.
NEEDS = (
    "libc6 (>= 2.36)", "libgl1", "libegl1", "libxcb1", "libwayland-client0", "libwayland-cursor0", "libwayland-egl1",
    "libstdc++6 (>= 12)", "libgcc-s1", "libudev1", "libusb-1.0-0", "fontconfig-config", "xkb-data",
    "shared-mime-info", "desktop-file-utils",
)  # fmt: skip
ALSO = ("libopenni2-0",)
"""Needed for a camera and its recordings; brings the udev rules, so that a camera opens without being root."""
PROGRAM_FOLDER = "opt/carpus"
ICONS_PX = (16, 32, 48, 64, 128, 256)

POSTINST = """#!/bin/sh
set -e
if [ "$1" = configure ]; then
    update-mime-database /usr/share/mime || true
    update-desktop-database -q /usr/share/applications || true
    udevadm control --reload 2>/dev/null && udevadm trigger --subsystem-match=usb || true
fi
"""
POSTRM = """#!/bin/sh
set -e
# Patients' data lie in the users' own folders and stay there.
if [ "$1" = remove ]; then
    update-mime-database /usr/share/mime 2>/dev/null || true
    update-desktop-database -q /usr/share/applications 2>/dev/null || true
fi
"""


def debian_version(version: str) -> str:
    """As Debian orders them: ``1.0rc1`` and ``1.0.dev2`` come before ``1.0``."""
    for mark, written in ((".dev", "~~dev"), ("rc", "~rc"), ("b", "~b"), ("a", "~a")):
        head, found, number = version.partition(mark)
        if found:
            return f"{head}{written}{number}"
    return version


def control(version: str, installed_bytes: int, architecture: str) -> str:
    """Return the control file; ``installed_bytes`` is the size of all files."""
    return _control("carpus", version, installed_bytes, architecture, ", ".join(NEEDS + ALSO)) + (
        "Description: Measures how a wrist and a hand move, for hand rehabilitation\n"
        " A depth camera looks down on a hand with blue paper discs on it. Carpus follows\n"
        " them and reports the angles of wrist and fingers with their standard\n"
        " deviations, live, in session files, as progress and as PDF reports.\n"
        " .\n"
        " For research and education. Not a medical device.\n"
    )


def extra_control(version: str, installed_bytes: int, architecture: str) -> str:
    """Return the control file of the second package, whose libraries fit one version of the first."""
    needs = f"carpus (= {debian_version(version)})"
    return _control(CAMERAS_EXTRA, version, installed_bytes, architecture, needs) + (
        "Description: RealSense and Orbbec cameras for Carpus\n"
        " The makers' libraries for Intel's RealSense D400 series and for Orbbec's Femto,\n"
        " Gemini and Astra 2 cameras.\n"
    )


def _control(name: str, version: str, installed_bytes: int, architecture: str, needs: str) -> str:
    return (
        f"Package: {name}\nVersion: {debian_version(version)}\nSection: science\nPriority: optional\n"
        f"Architecture: {architecture}\nInstalled-Size: {-(-installed_bytes // 1024)}\n"
        f"Maintainer: {MAINTAINER}\nDepends: {needs}\n"
    )


def changelog(version: str, date: datetime) -> str:
    """As Debian wants it; what changed stands in the program's own, which is packed beside it."""
    return (
        f"carpus ({debian_version(version)}) unstable; urgency=medium\n\n  * Carpus {version}; see changelog.gz.\n\n"
        f" -- {MAINTAINER}  {format_datetime(date)}\n"
    )


def lay_out(root: Path, texts: Mapping[str, str], here: Path, resources: Path) -> None:
    """Everything of the package but the program's own folder and its icons as pixels; ``texts`` by place."""

    def put(place: str, content: bytes, mode: int = 0o644) -> None:
        path = root / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(gzip.compress(content, 9, mtime=0) if place.endswith(".gz") else content)
        path.chmod(mode)

    put("usr/share/applications/carpus.desktop", (here / "linux" / "carpus.desktop").read_bytes())
    put("usr/share/mime/packages/carpus.xml", (here / "linux" / "carpus.xml").read_bytes())
    put("usr/share/icons/hicolor/scalable/apps/carpus.svg", (resources / "carpus.svg").read_bytes())
    for place, text in texts.items():
        put(place, text.encode("utf-8"))
    put("DEBIAN/postinst", POSTINST.encode(), 0o755)
    put("DEBIAN/postrm", POSTRM.encode(), 0o755)
    (root / "usr/bin").mkdir(parents=True, exist_ok=True)
    (root / "usr/bin/carpus").symlink_to("../../opt/carpus/carpus")


def metainfo(here: Path, version: str, date: str) -> str:
    """Return the AppStream file of a version; ``date`` in ISO 8601."""
    text = (here / "linux" / "carpus.metainfo.xml.in").read_text(encoding="utf-8")
    return text.replace("@VERSION@", version).replace("@DATE@", date)
