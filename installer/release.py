"""``make release``: what is handed out, or a sentence that says why not.

usage: python3 installer/release.py [--key KEY] [--without-tests]

Refuses what is uncommitted, a changelog that says nothing of this version, a version that was released already, and
failing tests. Then: wheel, source archive (both installed into an empty environment and started), the packages of
``make package``, ``apt/`` (their repository, for any web server or shared folder), SHA256SUMS, and with ``--key`` (or
RELEASE_KEY) the signatures of both by gpg. It uploads nothing.
"""

from __future__ import annotations

import argparse
import gzip
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DIST = ROOT / "dist"


class NotReleasableError(Exception):
    """Why there is no release, in a sentence."""


def version_of(text: str) -> str:
    """Of ``core/platform/version.py``, the one place where it stands."""
    found = re.search(r'^__version__ = "(.+)"', text, re.MULTILINE)
    if found is None:
        raise NotReleasableError("core/platform/version.py names no version")
    return found[1]


def changes_of(changelog: str, version: str) -> str:
    """Return the changelog below ``## [version] - date``; raises :class:`NotReleasableError` if empty."""
    head = re.search(rf"^## \[{re.escape(version)}\] - \d{{4}}-\d\d-\d\d$", changelog, re.MULTILINE)
    if head is None:
        raise NotReleasableError(
            f"CHANGELOG.md has no “## [{version}] - YYYY-MM-DD”: move what stands under [Unreleased] below it"
        )
    text = re.split(r"^## ", changelog[head.end() :], maxsplit=1, flags=re.MULTILINE)[0].strip()
    if not re.search(r"^- \S", text, re.MULTILINE):
        raise NotReleasableError(f"CHANGELOG.md says nothing under [{version}]")
    coming = re.search(r"^## \[Unreleased\]$(.*?)^## ", changelog, re.MULTILINE | re.DOTALL)
    if coming is not None and re.search(r"^- \S", coming[1], re.MULTILINE):
        raise NotReleasableError(
            "CHANGELOG.md still says something under [Unreleased], which this release brings too: move it down"
        )
    return text


def check_tree(status: str, tags: str, version: str) -> None:
    """``git status --porcelain`` and ``git tag``. Raises :class:`NotReleasableError`."""
    if status.strip():
        raise NotReleasableError(f"something is not committed: {status.split()[1]}")
    if f"v{version}" in tags.split():
        raise NotReleasableError(f"v{version} was released already: raise __version__ in core/platform/version.py")


def checksums(paths: list[Path]) -> str:
    """As ``sha256sum`` writes them."""
    return "".join(f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in sorted(paths))


def run(*command: str | Path) -> None:
    """Run a step that must succeed and prints for itself."""
    print("release:", *command, flush=True)
    if subprocess.run([str(word) for word in command], cwd=ROOT, check=False).returncode:
        raise NotReleasableError(f"“{' '.join(map(str, command))}” failed")


def asked(*command: str, folder: Path = ROOT) -> str:
    """Return what a command prints that runs in ``folder``."""
    return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout


def try_installed(path: Path) -> None:
    """Install into an empty environment and start, in a folder that is not the checkout."""
    with tempfile.TemporaryDirectory(prefix="carpus-release-") as folder:
        python = Path(folder, "venv", "bin", "python")
        run(sys.executable, "-m", "venv", python.parents[1])
        run(python, "-m", "pip", "install", "--quiet", "-c", ROOT / "requirements.lock", path)
        done = subprocess.run([python.with_name("carpus"), "--version"], cwd=folder, capture_output=True, text=True)
        if done.returncode or not done.stdout.startswith("carpus "):
            raise NotReleasableError(f"{path.name} does not start: {done.stderr.strip()}")


def write_apt(folder: Path, packages: list[Path], key: str) -> None:
    """Make a flat apt repository of Debian packages, signed if there is a key (public half: ``carpus.gpg``)."""
    if shutil.which("apt-ftparchive") is None:
        raise NotReleasableError("apt-ftparchive is missing: apt-get install apt-utils")
    folder.mkdir(parents=True)
    for path in packages:
        shutil.copy2(path, folder)
    listed = asked("apt-ftparchive", "packages", ".", folder=folder)
    (folder / "Packages").write_text(listed, encoding="utf-8")
    (folder / "Packages.gz").write_bytes(gzip.compress(listed.encode(), mtime=0))
    says = [f"APT::FTPArchive::Release::{name}=Carpus" for name in ("Origin", "Label")]
    release = asked("apt-ftparchive", *(word for one in says for word in ("-o", one)), "release", ".", folder=folder)
    (folder / "Release").write_text(release, encoding="utf-8")
    if key:
        sign = ("gpg", "--batch", "--yes", "--local-user", key)
        run(*sign, "--clearsign", "--output", folder / "InRelease", folder / "Release")
        run("gpg", "--batch", "--yes", "--output", folder / "carpus.gpg", "--export", key)


def release(key: str, *, with_tests: bool) -> list[Path]:
    """All of it; the files."""
    version = version_of((ROOT / "core" / "platform" / "version.py").read_text(encoding="utf-8"))
    changes_of((ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), version)
    check_tree(asked("git", "status", "--porcelain"), asked("git", "tag"), version)
    if with_tests:
        run("make", "test")
    shutil.rmtree(DIST, ignore_errors=True)
    DIST.mkdir()
    backend = "from setuptools.build_meta import build_sdist, build_wheel; build_wheel('dist'); build_sdist('dist')"
    run(ROOT / ".venv" / "bin" / "python", "-c", backend)
    for path in (*DIST.glob("*.whl"), *DIST.glob("*.tar.gz")):
        try_installed(path)
    run("make", "package")
    check_tree(asked("git", "status", "--porcelain"), "", version)
    write_apt(DIST / "apt", list(DIST.glob("*.deb")), key)
    files = [path for path in DIST.iterdir() if path.is_file()]
    sums = DIST / "SHA256SUMS"
    sums.write_text(checksums(files), encoding="utf-8")
    if key:
        run("gpg", "--batch", "--yes", "--local-user", key, "--armor", "--detach-sign", sums)
    else:
        print("release: nobody signs it: name a key by --key or RELEASE_KEY", flush=True)
    return sorted(path for path in DIST.iterdir() if path.is_file())


def main() -> int:
    """Say what was made, or why not."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--key", default=os.environ.get("RELEASE_KEY", ""), help="whose gpg key signs the checksums")
    options.add_argument("--without-tests", action="store_true", help="where they have just passed, as on a CI machine")
    arguments = options.parse_args()
    try:
        for path in release(arguments.key, with_tests=not arguments.without_tests):
            print(f"release: {path.relative_to(ROOT)}")
    except NotReleasableError as cause:
        print(f"release: {cause}.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
