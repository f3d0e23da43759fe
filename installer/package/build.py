"""``make package``: the program with its own Python in one folder, as an archive and as a Debian package.

usage: python3 installer/package/build.py [--keep-folder]

Makes an environment of its own from the locked packages and the wheel, packs it by PyInstaller, and writes to ``dist/``
the archive, on Linux the .deb, and the list of parts (CycloneDX). On Windows the folder is what windows/build.ps1 goes
on with.
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
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
WORK = ROOT / "build" / "package"
DIST = ROOT / "dist"
WINDOWS = sys.platform == "win32"
LARGEST_BYTES = 350_000_000
sys.path.insert(0, str(HERE))


def say(text: str) -> None:
    """One line for whoever waits."""
    print(f"package: {text}", flush=True)


def run(*command: str | Path, **options: object) -> str:
    """A command that must succeed; what it printed."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=ROOT, **options)  # type: ignore[call-overload]
    if done.returncode:
        sys.exit(f"package: {Path(str(command[0])).name} failed\n{(done.stdout + done.stderr)[-3000:]}")
    return str(done.stdout)


def version() -> str:
    """From the one place where it stands."""
    face = (ROOT / "carpus" / "__init__.py").read_text(encoding="utf-8")
    found = re.search(r'^__version__ = "(.+)"', face, re.MULTILINE)
    assert found is not None
    return found[1]


def commit_date() -> str:
    """Of the last commit, so that the same source makes the same package; today's where there is no git."""
    done = subprocess.run(["git", "log", "-1", "--format=%cs"], cwd=ROOT, capture_output=True, text=True, check=False)
    return done.stdout.strip() or time.strftime("%Y-%m-%d")


def environment() -> Path:
    """The Python of an environment with the locked packages and the tools; made anew when a lock changes."""
    folder = WORK / "venv"
    python = folder / ("Scripts/python.exe" if WINDOWS else "bin/python")
    stamp = folder / ".made-of"
    lock = HERE / "hashes.lock"  # requirements.lock and tools.lock with the hash of every file: nothing else is packed
    mark = hashlib.sha256(lock.read_bytes()).hexdigest()
    if not stamp.exists() or stamp.read_text() != mark:
        say("an environment with the locked packages")
        shutil.rmtree(folder, ignore_errors=True)
        run(sys.executable, "-m", "venv", folder)
        run(python, "-m", "pip", "install", "--quiet", "--require-hashes", "-r", lock)
        stamp.write_text(mark)
    run(python, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--force-reinstall", ROOT)
    return python


def pack(python: Path) -> Path:
    """The folder with the program, its Python and all libraries."""
    say("PyInstaller packs")
    run(
        python, "-P", "-m", "PyInstaller", "--noconfirm", "--log-level", "ERROR", "--distpath", WORK, "--workpath",
        WORK / "work", HERE / "carpus.spec",
    )  # fmt: skip
    return WORK / "carpus"


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


def write_deb(folder: Path, python: Path, number: str) -> Path:
    """The Debian package around the folder."""
    import debian

    root = WORK / "deb"
    shutil.rmtree(root, ignore_errors=True)
    date = commit_date()
    page = run(
        python, "-P", "-c",
        "import sys; sys.path.insert(0, sys.argv[1]); from man_page import man_page; from carpus import __version__;"
        "from carpus.app.commands import COMMANDS; print(man_page(__version__, sys.argv[2], COMMANDS), end='')",
        HERE, date,
    )  # fmt: skip
    notice = (ROOT / "LICENSE").read_text(encoding="utf-8")
    notice = f"Carpus. The licences of all bundled parts: /opt/carpus/licences.txt\n\n{notice}"
    debian.lay_out(root, page, HERE, debian.metainfo(HERE, number, date), notice)
    shutil.copytree(folder, root / debian.PROGRAM_FOLDER, symlinks=True, copy_function=os.link)
    import slim

    architecture = run("dpkg", "--print-architecture").strip()
    control = debian.control(number, slim.size(root), architecture)
    (root / "DEBIAN" / "control").write_text(control, encoding="utf-8")
    path = DIST / f"carpus_{debian.debian_version(number)}_{architecture}.deb"
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
    bill = DIST / f"carpus-{number}-{sys.platform}.cdx.json"
    run(python, HERE / "parts_list.py", folder, bill)
    size = slim.size(folder)
    verdict = "" if size < LARGEST_BYTES else f"; {LARGEST_BYTES / 1e6:.0f} MB were wanted"
    say(f"installed {size / 1e6:.0f} MB{verdict}")
    if only_folder or WINDOWS:
        say(str(folder))
        return 0
    for path in (
        write_archive(folder, f"carpus-{number}-linux-{platform.machine()}"),
        write_deb(folder, python, number),
        bill,
    ):
        say(f"{path.relative_to(ROOT)} ({path.stat().st_size / 1e6:.1f} MB)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
