"""What a Debian package says and where its files lie; the packing itself is :mod:`build`'s."""

from __future__ import annotations

from pathlib import Path

# On Debian 12 and Ubuntu 24.04 by these names (Ubuntu's t64 packages provide them). The packed folder brings all else.
NEEDS = (
    "libc6 (>= 2.36)", "libgl1", "libegl1", "libxcb1", "libwayland-client0", "libwayland-cursor0", "libwayland-egl1",
    "fontconfig-config", "xkb-data", "shared-mime-info", "desktop-file-utils",
)  # fmt: skip
ALSO = ("libopenni2-0",)
"""Needed for a camera and its recordings; brings the udev rules, so that a camera opens without being root."""
PROGRAM_FOLDER = "opt/carpus"

POSTINST = """#!/bin/sh
set -e
if [ "$1" = configure ]; then
    update-mime-database /usr/share/mime || true
    update-desktop-database -q /usr/share/applications || true
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
    """The control file. ``installed_bytes`` of all files."""
    return f"""Package: carpus
Version: {debian_version(version)}
Section: science
Priority: optional
Architecture: {architecture}
Installed-Size: {-(-installed_bytes // 1024)}
Maintainer: The Carpus developers <carpus@localhost>
Depends: {", ".join(NEEDS + ALSO)}
Description: Measures how a wrist and a hand move, for hand rehabilitation
 A depth camera looks down on a hand with blue paper discs on it. Carpus follows
 them and reports the angles of wrist and fingers with their standard
 deviations, live, in session files, as progress and as PDF reports.
 .
 For research and education. Not a medical device.
"""


def lay_out(root: Path, page: str, here: Path, metainfo: str, copyright_text: str) -> None:
    """Everything of the package but the program's own folder."""

    def put(place: str, content: str | bytes, mode: int = 0o644) -> None:
        path = root / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
        path.chmod(mode)

    linux = here / "linux"
    put("usr/share/applications/carpus.desktop", (linux / "carpus.desktop").read_bytes())
    put("usr/share/mime/packages/carpus.xml", (linux / "carpus.xml").read_bytes())
    put("usr/share/icons/hicolor/scalable/apps/carpus.svg", (linux / "carpus.svg").read_bytes())
    put("usr/share/metainfo/carpus.metainfo.xml", metainfo)
    put("usr/share/doc/carpus/copyright", copyright_text)
    put("usr/share/man/man1/carpus.1", page)
    put("DEBIAN/postinst", POSTINST, 0o755)
    put("DEBIAN/postrm", POSTRM, 0o755)
    (root / "usr/bin").mkdir(parents=True, exist_ok=True)
    (root / "usr/bin/carpus").symlink_to("../../opt/carpus/carpus")


def metainfo(here: Path, version: str, date: str) -> str:
    """The AppStream file of a version; ``date`` as ISO writes it."""
    text = (here / "linux" / "carpus.metainfo.xml.in").read_text(encoding="utf-8")
    return text.replace("@VERSION@", version).replace("@DATE@", date)
