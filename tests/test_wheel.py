"""What is installed: one import name, every part of the program, nothing beside it, started from any folder."""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PARTS = ("app", "core", "ui", "resources")
REVISION = "carpus/resources/revision.txt"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built as pip builds it, by the build hook of pyproject.toml."""
    folder = tmp_path_factory.mktemp("wheel")
    build = f"from hatchling.build import build_wheel; print(build_wheel({str(folder)!r}))"
    subprocess.run([sys.executable, "-c", build], cwd=ROOT, check=True, capture_output=True)
    (path,) = folder.glob("*.whl")
    return path


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
    return {f"carpus/{path.relative_to(ROOT)}" for path in files if "__pycache__" not in path.parts}


def test_a_wheel_holds_the_program_and_nothing_beside_it(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if not name.endswith("/")}
    program = {name for name in names if ".dist-info/" not in name}
    expected = parts_of_the_checkout()
    assert len(expected) > 300
    assert program == expected | {"carpus/__init__.py", "carpus/__main__.py", "carpus/py.typed", REVISION}


def test_a_source_archive_holds_all_that_a_wheel_is_built_of(tmp_path: Path) -> None:
    """Also after ``make lint``, which links to the parts from another folder."""
    build = f"from hatchling.build import build_sdist; print(build_sdist({str(tmp_path)!r}))"
    subprocess.run([sys.executable, "-c", build], cwd=ROOT, check=True, capture_output=True)
    (path,) = tmp_path.glob("*.tar.gz")
    with tarfile.open(path) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert {f"carpus/{name}" for name in names} >= parts_of_the_checkout()
    assert names >= {"carpus.py", "installer/wheel_layout.py", "requirements.lock"}
    assert not [name for name in names if name.startswith(("build/", "dist/", ".venv/", ".ci/"))]


def carpus(installed: Path, folder: Path, *arguments: str) -> str:
    """What a command prints, run in ``folder`` by the installed program."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    command = "import sys; from carpus.app.__main__ import main; sys.argv[0] = 'carpus'; sys.exit(main())"
    # As the start script does: the folder that one stands in is no place to import from, site-packages is.
    command = f"import sys; sys.path[:0] = [{str(installed)!r}]; {command}"
    done = subprocess.run(
        [sys.executable, "-P", "-c", command, *arguments],
        cwd=folder,
        env=environment,
        check=False,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("crowded", [False, True])
def test_the_installed_program_runs_in_any_folder(installed: Path, tmp_path: Path, crowded: bool) -> None:
    """Also where folders and files are called as the program's parts are."""
    if crowded:
        for name in ("app", "core", "ui", "resources", "tests", "carpus"):
            (tmp_path / name).mkdir()
            (tmp_path / name / "__init__.py").write_text("raise SystemExit('not the program')\n")
        (tmp_path / "types.py").write_text("raise SystemExit('not the program')\n")
    where = "import carpus, carpus.core; print(carpus.__file__, *carpus.core.__path__)"
    found = subprocess.run(
        [sys.executable, "-P", "-c", f"import sys; sys.path[:0] = [{str(installed)!r}]; {where}"],
        cwd=tmp_path,
        check=True,
        capture_output=True,
        text=True,
    ).stdout.split()
    assert [Path(path).is_relative_to(installed) for path in found] == [True, True]
    carpus(installed, tmp_path, "simulate", "--output", "r", "--seconds", "0.5", "--seed", "3")
    carpus(installed, tmp_path, "track", "r", "--calibration", "r/calibration.json", "--output", "s.h5")
    assert "\nFrames       15 " in carpus(installed, tmp_path, "info", "s.h5")
