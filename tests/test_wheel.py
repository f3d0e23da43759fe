"""What is installed: one import name, every part of the program, nothing beside it, started from any folder."""

from __future__ import annotations

import fcntl
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from email import message_from_string
from pathlib import Path

import pytest

from tests.session.test_golden import unpack_golden

ROOT = Path(__file__).parents[1]
PARTS = ("app", "core", "ui", "resources")
FACE = {"carpus/__init__.py", "carpus/__main__.py", "carpus/py.typed"}
REVISION = "carpus/resources/revision.txt"
COMPILED = ROOT / "core" / "compiled"


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Source archive and wheel as pip builds them, in the checkout's own folder.

    One process at a time: a build clears what another one has laid there. The compiled modules are those of the
    checkout, which the set-up made by the same rules; a source newer than its module is compiled anew.
    """
    folder = tmp_path_factory.mktemp("built")
    code = f"from setuptools.build_meta import *; build_sdist({str(folder)!r}); build_wheel({str(folder)!r})"
    (ROOT / "build").mkdir(exist_ok=True)
    with (ROOT / "build" / "wheel.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        place = ROOT / "build" / f"lib.{sysconfig.get_platform()}-{sys.implementation.cache_tag}"
        shutil.copytree(COMPILED, place / "carpus/core/compiled", ignore=ignore_all_but_modules, dirs_exist_ok=True)
        done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]
    (archive,), (path,) = folder.glob("*.tar.gz"), folder.glob("*.whl")
    return archive, path


def ignore_all_but_modules(_: str, names: list[str]) -> list[str]:
    return [name for name in names if not name.endswith((".so", ".pyd"))]


@pytest.fixture(scope="module")
def wheel(built: tuple[Path, Path]) -> Path:
    return built[1]


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder that stands for site-packages."""
    folder = tmp_path_factory.mktemp("site")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder)
    return folder


def parts_of_the_checkout() -> set[str]:
    """Every file of the program, as it is called once installed."""
    files = (path for part in PARTS for path in (ROOT / part).rglob("*") if path.is_file())
    return {
        f"carpus/{path.relative_to(ROOT)}"
        for path in files
        if "__pycache__" not in path.parts and path.suffix not in (".so", ".pyd")
    }


def test_wheel_holds_program_and_nothing_next_to_it(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if not name.endswith("/")}
    program = {name for name in names if ".dist-info/" not in name}
    expected = parts_of_the_checkout()
    assert len(expected) > 300
    modules = {f"carpus/core/compiled/{path.stem}.abi3.so" for path in COMPILED.glob("[!_]*.py")}
    assert len(modules) > 1
    assert program == expected | FACE | {REVISION} | modules
    assert "-cp311-abi3-" in wheel.name
    assert not wheel.name.endswith("-any.whl")


def test_source_archive_holds_all_that_wheel_is_built_of(built: tuple[Path, Path]) -> None:
    with tarfile.open(built[0]) as opened:
        names = {name.partition("/")[2] for name in opened.getnames()}
    assert names >= parts_of_the_checkout() | FACE | {"requirements.lock"}
    assert not [name for name in names if name.startswith(("build/", "dist/", ".venv/", ".ci/", *PARTS))]


def carpus(installed: Path, folder: Path, *arguments: str) -> str:
    """What a command prints, run in ``folder`` by the installed program."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    command = "import sys; from carpus.app.__main__ import main; sys.argv[0] = 'carpus'; sys.exit(main())"
    # As the start script does: the folder that one stands in is no place to import from, site-packages is.
    command = f"import sys; sys.path[:0] = [{str(installed)!r}]; {command}"
    words = [sys.executable, "-P", "-c", command, *arguments]
    done = subprocess.run(words, cwd=folder, env=environment, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture
def mistakable(tmp_path: Path) -> Path:
    """A folder in which folders and files are called as parts of the program are."""
    for name in ("app", "core", "ui", "resources", "tests", "carpus"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("raise SystemExit('not the program')\n")
    (tmp_path / "types.py").write_text("raise SystemExit('not the program')\n")
    return tmp_path


def test_installed_program_runs_where_folders_and_files_are_called_as_its_parts_are(
    installed: Path, mistakable: Path
) -> None:
    where = "import carpus, carpus.core; print(carpus.__file__, *carpus.core.__path__)"
    asked = [sys.executable, "-P", "-c", f"import sys; sys.path[:0] = [{str(installed)!r}]; {where}"]
    found = subprocess.run(asked, cwd=mistakable, check=True, capture_output=True, text=True).stdout.split()
    assert [Path(path).is_relative_to(installed) for path in found] == [True, True]
    session = unpack_golden("v2-wrist6.h5", mistakable)
    assert "\nFrames       12 " in carpus(installed, mistakable, "info", session.name)


def test_metadata_says_licences_extras_and_what_starts_it_and_no_address_that_nobody_has(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        (folder,) = {name.partition("/")[0] for name in archive.namelist() if ".dist-info/" in name}
        told = message_from_string(archive.read(f"{folder}/METADATA").decode())
        scripts = archive.read(f"{folder}/entry_points.txt").decode()
        names = set(archive.namelist())
    assert told["License-Expression"] == "MIT AND OFL-1.1 AND ISC"
    for path in told.get_all("License-File", []):
        assert f"{folder}/licenses/{path}" in names
    assert len(told.get_all("License-File", [])) == 3
    assert set(told.get_all("Provides-Extra", [])) == {"cluster", "research", "stream", "realsense"}
    assert "[console_scripts]\ncarpus =" in scripts
    assert "[gui_scripts]\ncarpus-window =" in scripts
    assert not [url for url in told.get_all("Project-URL", []) if "example" in url or "carpus" in url.lower()]
    assert told["Author-email"] is None


def install_lines() -> list[str]:
    """What README and pages tell a person to type for installing from a checkout, what is installed once each."""
    pages = [ROOT / "README.md", *sorted((ROOT / "resources").glob("*.md"))]
    text = "\n".join(page.read_text(encoding="utf-8") for page in pages)
    found = re.findall(r"^((?:python3 -m venv \.venv && )?\.venv/bin/pip install .+)$", text, re.M)
    found += re.findall(r"`((?:\.venv/bin/)?pip install [^`]+)`", text)
    return list({line.partition("pip install ")[2]: line for line in reversed(found)}.values())


def test_install_lines_ask_for_extras_that_there_are() -> None:
    lines = install_lines()
    (line,) = (line for line in lines if "-m venv" in line)
    known = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    asked = [extra for one in lines for extra in re.findall(r"pip install ['\"](?:\.|carpus)\[([\w,]+)\]['\"]$", one)]
    assert {"realsense"} <= {name for extra in asked for name in extra.split(",")} <= set(known)
    assert len(asked) == len([one for one in lines if one != line and "pyorbbecsdk2" not in one])
