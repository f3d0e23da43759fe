"""What ``make release`` refuses, each in one sentence."""

from __future__ import annotations

import hashlib
import importlib.util
import re
import subprocess
from pathlib import Path
from types import ModuleType

import pytest

from carpus import __version__

ROOT = Path(__file__).parents[2]
GOOD = "# Changelog\n\n## [Unreleased]\n\n## [1.2.0] - 2026-11-22\n\n### Added\n- Something.\n\n"
GOOD += "## [1.1.0] - 2026-10-01\n- Old.\n"


@pytest.fixture(scope="module")
def release() -> ModuleType:
    spec = importlib.util.spec_from_file_location("release", ROOT / "installer" / "release.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    "text",
    [
        GOOD.replace("[1.2.0]", "[1.3.0]"),
        GOOD.replace("[1.2.0] - 2026-11-22", "[1.2.0]"),
        GOOD.replace("- Something.", ""),
        GOOD.replace("- Something.", "- "),
        GOOD.replace("## [Unreleased]\n", "## [Unreleased]\n\n### Fixed\n- Something else.\n"),
        "",
    ],
    ids=["another version", "no date", "nothing said", "an empty line", "something left", "no file"],
)
def test_empty_changelog_is_refused(release: ModuleType, text: str) -> None:
    assert release.changes_of(GOOD, "1.2.0") == "### Added\n- Something."
    with pytest.raises(release.NotReleasableError, match=r"CHANGELOG\.md"):
        release.changes_of(text, "1.2.0")


def test_real_changelog_can_become_this_release_by_its_heading_alone(release: ModuleType) -> None:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    heads = re.findall(r"^## .*$", text, re.MULTILINE)
    assert heads[0] == "## [Unreleased]"
    assert all(re.fullmatch(r"## \[\d+\.\d+\.\d+\] - \d{4}-\d\d-\d\d", head) for head in heads[1:])
    if f"## [{__version__}] - " not in text:  # between releases
        dated = text.replace("## [Unreleased]", f"## [Unreleased]\n\n## [{__version__}] - 2026-11-22", 1)
        assert release.changes_of(dated, __version__).startswith("### ")


@pytest.mark.parametrize(
    ("status", "tags"), [(" M core/model/so3.py\n", ""), ("?? new.py\n", ""), ("", "v1.1.0\nv1.2.0\n")]
)
def test_dirty_tree_or_old_version_is_refused(release: ModuleType, status: str, tags: str) -> None:
    with pytest.raises(release.NotReleasableError):
        release.check_tree(status, tags, "1.2.0")
    release.check_tree("", "v1.1.0\nv1.2.0rc1\n", "1.2.0")


def test_checksums_are_those_of_sha256sum(release: ModuleType, tmp_path: Path) -> None:
    for name in ("b.whl", "a.deb"):
        (tmp_path / name).write_bytes(name.encode() * 1000)
    text = release.checksums([tmp_path / "b.whl", tmp_path / "a.deb"])
    assert text.splitlines()[0] == f"{hashlib.sha256(b'a.deb' * 1000).hexdigest()}  a.deb"
    told = subprocess.run(
        ["sha256sum", "--check", "--strict"], input=text, text=True, cwd=tmp_path, check=True, capture_output=True
    )
    assert told.stdout.count(": OK") == 2


def test_folder_of_packages_is_what_apt_reads(release: ModuleType, tmp_path: Path) -> None:
    packages = []
    for version in ("1.2.0", "1.10.0~rc1"):
        root = tmp_path / version
        (root / "DEBIAN").mkdir(parents=True)
        (root / "DEBIAN").chmod(0o755)  # dpkg-deb asks for it, and the umask may be the program's
        control = f"Package: carpus\nVersion: {version}\nArchitecture: all\nMaintainer: A <a@b>\nDescription: it\n"
        (root / "DEBIAN" / "control").write_text(control)
        packages.append(tmp_path / f"carpus_{version}_all.deb")
        subprocess.run(["dpkg-deb", "--build", str(root), str(packages[-1])], check=True, capture_output=True)
    folder = tmp_path / "apt"
    release.write_apt(folder, packages, "")
    listed = (folder / "Packages").read_bytes()
    assert hashlib.sha256(listed).hexdigest() in (folder / "Release").read_text()
    for path in packages:
        assert hashlib.sha256(path.read_bytes()).hexdigest().encode() in listed
