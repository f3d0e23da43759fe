"""Builds the installer for Windows around a packed folder, on Windows or elsewhere by Debian's ``makensis``.

usage: python setup_program.py FOLDER [--makensis PATH]
       python setup_program.py --stand-in [--output SETUP.exe]   (a payload of small files)
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
LONGEST = 150
"""Letters of a path in the payload: with the user's own folder before it all stays below Windows' 260."""


def stand_in(folder: Path) -> Path:
    """Make a payload in the form of the real one: both programs, parts, deep and non-Latin names."""
    shutil.rmtree(folder, ignore_errors=True)
    deep = folder / "parts" / "carpus" / "Ordner für 手" / ("deep " * 8).strip()
    deep.mkdir(parents=True)
    for name in ("carpus.exe", "Carpus-window.exe", "licences.txt", "parts.cdx.json", "parts/python311.dll"):
        (folder / name).write_text(f"stand-in for {name}\n")
    (deep / "файл.txt").write_text("reached\n")
    return folder


def too_long(folder: Path) -> list[str]:
    """Paths of a payload that Windows might refuse below a user's folder."""
    return [str(path.relative_to(folder)) for path in folder.rglob("*") if len(str(path.relative_to(folder))) > LONGEST]


def main() -> int:
    """All of it."""
    from build import DIST, ROOT, WORK, version
    from resources import four_numbers

    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("folder", nargs="?", type=Path)
    options.add_argument("--stand-in", action="store_true")
    options.add_argument("--makensis", default="makensis")
    options.add_argument("--version", default=version())
    options.add_argument("--output", type=Path)
    options.add_argument("--target", default="", help="of makensis, as amd64-unicode: a 64-bit installer")
    arguments = options.parse_args()
    if not arguments.stand_in and arguments.folder is None:
        options.error("which folder?")
    number = arguments.version
    folder = stand_in(WORK / "stand-in") if arguments.stand_in else arguments.folder.resolve()
    if long := too_long(folder):
        sys.exit(f"these paths are too long for Windows: {', '.join(long[:5])}")
    output = arguments.output or DIST / f"Carpus-{number}-setup{'-stand-in' if arguments.stand_in else ''}.exe"
    output.parent.mkdir(parents=True, exist_ok=True)
    defined = {
        "VERSION": number,
        "VERSION4": ".".join(map(str, four_numbers(number))),
        "PAYLOAD": folder,
        "LICENCE": ROOT / "LICENSE",
        "OUTPUT": output.resolve(),
    }
    command = [arguments.makensis, "-V2", "-WX", "-INPUTCHARSET", "UTF8"]
    command += [f"-D{name}={value}" for name, value in defined.items()]
    command += [f"-XTarget {arguments.target}"] if arguments.target else []
    subprocess.run([*command, str(HERE / "carpus.nsi")], check=True)
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
