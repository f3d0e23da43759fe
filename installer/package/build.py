"""``make package``: the program with its own Python in one folder, as an archive and as two Debian packages.

usage: python3 installer/package/build.py [--keep-folder]

Makes an environment of its own from the locked packages and the wheel, packs it by PyInstaller, and writes to ``dist/``
the archive, on Linux the .deb, that of the further cameras, and the list of parts (CycloneDX). On Windows the folder is
what windows/build.ps1 goes on with.
"""

from __future__ import annotations

import argparse
import gzip
import hashlib
import os
import platform
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
WORK = ROOT / "build" / "package"
DIST = ROOT / "dist"
WINDOWS = sys.platform == "win32"
LARGEST_BYTES = 380_000_000
"""Of the first package, installed, on Linux; a build that is larger fails."""
EXTRA = ("pyorbbecsdk", "pyorbbecsdk2-*.dist-info", "pyrealsense2", "pyrealsense2-*.dist-info")
NOT_OF_EXTRA = (
    "examples",
    "shared",
    "*.pyi",
    "*.pxd",
    "*.debug",
    "pyrealdds*",
    "pyrsutils*",
    "__pycache__",
    "libOrbbecSDK.so",
    "libOrbbecSDK.so.2.?*",
)
"""Orbbec's package has its library three times."""
EXTRA_NOTICE = """The makers' libraries, unchanged: pyorbbecsdk2 and pyrealsense2 (Apache 2.0). What is not below:
/usr/share/common-licenses.

"""
sys.path.insert(0, str(HERE))


def say(text: str) -> None:
    """One line for whoever waits."""
    print(f"package: {text}", flush=True)


def run(*command: str | Path, **options: object) -> str:
    """Run a command that must succeed; return what it printed."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=ROOT, **options)  # type: ignore[call-overload]
    if done.returncode:
        sys.exit(f"package: {Path(str(command[0])).name} failed\n{(done.stdout + done.stderr)[-3000:]}")
    return str(done.stdout)


def version() -> str:
    """From the one place where it stands."""
    face = (ROOT / "core" / "platform" / "version.py").read_text(encoding="utf-8")
    found = re.search(r'^__version__ = "(.+)"', face, re.MULTILINE)
    assert found is not None
    return found[1]


def commit_date() -> str:
    """Of the last commit, so that the same source makes the same package; today's where there is no git."""
    done = subprocess.run(["git", "log", "-1", "--format=%cs"], cwd=ROOT, capture_output=True, text=True, check=False)
    return done.stdout.strip() or time.strftime("%Y-%m-%d")


def environment() -> Path:
    """Return the Python of an environment with the locked packages and tools, made anew if the lock changed."""
    folder = WORK / "venv"
    python = folder / ("Scripts/python.exe" if WINDOWS else "bin/python")
    stamp = folder / ".made-of"
    lock = HERE / "hashes.lock"  # requirements.lock and tools.lock with the hash of every file: nothing else is packed
    mark = hashlib.sha256(lock.read_bytes()).hexdigest()
    if not stamp.exists() or stamp.read_text() != mark:
        say("an environment with the locked packages")
        shutil.rmtree(folder, ignore_errors=True)
        run(sys.executable, "-m", "venv", folder)
        run(python, "-m", "pip", "install", "--quiet", "--no-deps", "--require-hashes", "-r", lock)
        stamp.write_text(mark)
    run(python, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--force-reinstall", ROOT)
    return python


def pack(python: Path) -> Path:
    """Pack the program, its Python and all libraries into a folder."""
    say("PyInstaller packs")
    if WINDOWS:
        from windows.resources import version_resource

        (WORK / "version.txt").write_text(version_resource(version()), encoding="utf-8")
        draw_icons(python, {256: WORK / "carpus.ico"})
    run(
        python, "-P", "-m", "PyInstaller", "--noconfirm", "--log-level", "ERROR", "--distpath", WORK, "--workpath",
        WORK / "work", HERE / "carpus.spec",
    )  # fmt: skip
    return WORK / "carpus"


def try_start(folder: Path) -> None:
    """Start what was packed, and let it make a store: what is read as a file, not imported, may be missing."""
    with tempfile.TemporaryDirectory() as made:
        data, place = Path(made, "data"), Path(made, "backup")
        (data / "sessions").mkdir(parents=True)
        program = folder / ("carpus.exe" if WINDOWS else "carpus")
        run(program, "backup", place, env=os.environ | {"CARPUS_DATA": str(data)})


def write_archive(folder: Path, name: str) -> Path:
    """``name.tar.gz`` of the folder, which is called ``name`` inside; nobody's names, one date for all."""

    def plain(entry: tarfile.TarInfo) -> tarfile.TarInfo:
        entry.uid = entry.gid = 0
        entry.uname = entry.gname = "root"
        return entry

    path = DIST / f"{name}.tar.gz"
    with (
        gzip.GzipFile(path, "wb", compresslevel=6, mtime=0) as packed,
        tarfile.open(fileobj=packed, mode="w") as archive,
    ):
        archive.add(folder, name, filter=plain)
    return path


def draw_icons(python: Path, places: dict[int, Path]) -> None:
    """Save the program's icon in several sizes; the ending of a path says in which format."""
    for path in places.values():
        path.parent.mkdir(parents=True, exist_ok=True)
    draw = "import sys; from carpus.ui.kit.icons import program_icon_image\n"
    draw += "assert program_icon_image(int(sys.argv[1])).save(sys.argv[2])"
    for size_px, path in places.items():
        run(python, "-P", "-c", draw, str(size_px), path)


def write_deb(folder: Path, python: Path, number: str) -> Path:
    """Write the Debian package of the packed folder."""
    import debian

    root = WORK / "deb"
    shutil.rmtree(root, ignore_errors=True)
    date = commit_date()
    told = run(
        python, "-P", "-c",
        "import sys; sys.path.insert(0, sys.argv[1]); from man_page import man_page; from carpus import __version__;"
        "from carpus.app.commands import COMMANDS; from carpus.core.capture.devices.cameras import format_udev_rules;"
        "print(man_page(__version__, sys.argv[2], COMMANDS), format_udev_rules(), sep=chr(0), end='')",
        HERE, date,
    )  # fmt: skip
    page, _, rules = told.partition("\0")
    notice = "Carpus. The licences of all bundled parts: /opt/carpus/licences.txt\n\n"
    day = datetime.fromisoformat(date).replace(tzinfo=UTC)
    texts = {
        "usr/share/doc/carpus/copyright": notice + (ROOT / "LICENSE").read_text(encoding="utf-8"),
        "usr/share/doc/carpus/changelog.gz": (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"),
        "usr/share/doc/carpus/changelog.Debian.gz": debian.changelog(number, day),
        "usr/share/man/man1/carpus.1.gz": page,
        "usr/share/metainfo/carpus.metainfo.xml": debian.metainfo(HERE, number, date),
        "usr/lib/udev/rules.d/60-carpus-cameras.rules": rules,
    }
    debian.lay_out(root, texts, HERE, ROOT / "resources")
    icons = root / "usr/share/icons/hicolor"
    draw_icons(python, {size: icons / f"{size}x{size}" / "apps" / "carpus.png" for size in debian.ICONS_PX})
    shutil.copytree(folder, root / debian.PROGRAM_FOLDER, symlinks=True, copy_function=os.link)
    return build_deb(root, "carpus", number, debian.control)


def write_extra(python: Path, number: str) -> Path:
    """Write the second package: the other cameras' libraries, as their makers' wheels lay them out."""
    import debian

    root = WORK / "extra"
    shutil.rmtree(root, ignore_errors=True)
    parts = root / debian.PROGRAM_FOLDER / "parts"
    installed = Path(run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").strip())
    for name in EXTRA:
        for path in installed.glob(name):
            shutil.copytree(path, parts / path.name, ignore=shutil.ignore_patterns(*NOT_OF_EXTRA))
    notice = root / "usr/share/doc" / debian.CAMERAS_EXTRA / "copyright"
    notice.parent.mkdir(parents=True)
    texts = [path.read_text(encoding="utf-8") for path in sorted(parts.glob("*.dist-info/licenses/LICENSE*"))]
    notice.write_text(EXTRA_NOTICE + "\n".join(texts), encoding="utf-8")
    return build_deb(root, debian.CAMERAS_EXTRA, number, debian.extra_control)


def build_deb(root: Path, name: str, number: str, control: Callable[[str, int, str], str]) -> Path:
    """Build a Debian package of the files below ``root``, and remove them."""
    import slim

    import debian

    architecture = run("dpkg", "--print-architecture").strip()
    (root / "DEBIAN").mkdir(exist_ok=True)
    (root / "DEBIAN" / "control").write_text(control(number, slim.size(root), architecture), encoding="utf-8")
    path = DIST / f"{name}_{debian.debian_version(number)}_{architecture}.deb"
    run("dpkg-deb", "--root-owner-group", "-Zxz", "-z3", "--build", root, path)
    shutil.rmtree(root)
    return path


def main() -> int:
    """All of it."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--keep-folder", action="store_true", help="only the folder, no archive and no .deb")
    only_folder = arguments.parse_args().keep_folder
    os.umask(0o022)
    number = version()
    WORK.mkdir(parents=True, exist_ok=True)
    DIST.mkdir(exist_ok=True)
    python = environment()
    folder = pack(python)
    import slim

    parts = folder / "parts"
    if not WINDOWS:
        say(f"{slim.slim(parts) / 1e6:.0f} MB left out that nothing calls")
    try_start(folder)
    bill = DIST / f"carpus-{number}-{sys.platform}.cdx.json"
    run(python, HERE / "parts_list.py", folder, bill)
    size = slim.size(folder)
    say(f"installed {size / 1e6:.0f} MB")
    if size > LARGEST_BYTES and not WINDOWS:  # there the cameras' libraries are in it
        sys.exit(f"package: at most {LARGEST_BYTES / 1e6:.0f} MB are wanted; find what grew, or raise the limit")
    if only_folder or WINDOWS:
        say(str(folder))
        return 0
    for path in (
        write_archive(folder, f"carpus-{number}-linux-{platform.machine()}"),
        write_deb(folder, python, number),
        write_extra(python, number),
        bill,
    ):
        say(f"{path.relative_to(ROOT)} ({path.stat().st_size / 1e6:.1f} MB)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
