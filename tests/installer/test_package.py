"""The logic of the packages: control file, desktop entry, file type, man page, list of parts, Windows resources."""

from __future__ import annotations

import configparser
import gzip
import importlib.util
import json
import lzma
import re
import shutil
import subprocess
import sys
from datetime import UTC, datetime
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from xml.etree import ElementTree

import h5py
import numpy as np
import pytest

from carpus.app.commands import COMMANDS
from carpus.core.model.installation import CAMERAS_EXTRA
from carpus.core.platform.about import licence_texts, list_bundled_parts

ROOT = Path(__file__).parents[2]
HERE = ROOT / "installer" / "package"
LINUX = HERE / "linux"
GOLDEN = ROOT / "tests" / "session" / "golden"
MIME = "application/x-carpus-session"
NAMESPACE = {"m": "http://www.freedesktop.org/standards/shared-mime-info"}


def script(path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """A script of the installer as a module."""
    monkeypatch.setattr(sys, "path", [str(HERE), *sys.path])
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def tool(name: str) -> str:
    path = shutil.which(name)
    assert path is not None, f"{name} is needed; make test installs it"
    return path


def test_debian_orders_versions_as_python_does(monkeypatch: pytest.MonkeyPatch) -> None:
    debian = script(HERE / "debian.py", monkeypatch)
    rising = ["0.1.0", "0.2.0.dev3", "0.2.0a1", "0.2.0b2", "0.2.0rc1", "0.2.0", "0.10.0"]
    for low, high in pairwise(rising):
        command = [tool("dpkg"), "--compare-versions", debian.debian_version(low), "lt", debian.debian_version(high)]
        assert subprocess.run(command, check=False).returncode == 0, (low, high)


def test_control_file_says_what_apt_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    debian = script(HERE / "debian.py", monkeypatch)
    text = debian.control("1.2.3rc4", 1_025_000, "amd64")
    fields = dict(re.findall(r"^([A-Z][\w-]*): (.*)$", text, re.MULTILINE))
    assert fields["Package"] == "carpus"
    assert fields["Version"] == "1.2.3~rc4"
    assert fields["Installed-Size"] == "1001"
    assert "libopenni2-0" in fields["Depends"].split(", "), "the camera's driver, with the rules that let people use it"
    assert not re.search(r"\bpython", fields["Depends"])
    assert text.endswith("\n")


def test_package_lies_where_system_looks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    debian = script(HERE / "debian.py", monkeypatch)
    date = "2026-11-22"
    place = "usr/share/metainfo/carpus.metainfo.xml"
    texts = {place: debian.metainfo(HERE, "1.0", date), "usr/share/man/man1/carpus.1.gz": "page"}
    debian.lay_out(tmp_path, texts, HERE, ROOT / "resources")
    assert gzip.decompress((tmp_path / "usr/share/man/man1/carpus.1.gz").read_bytes()) == b"page"
    assert (tmp_path / "usr/bin/carpus").readlink() == Path("../../opt/carpus/carpus")
    assert (tmp_path / "DEBIAN/postinst").stat().st_mode & 0o111
    for name in ("postinst", "postrm"):
        subprocess.run([tool("sh"), "-n", str(tmp_path / "DEBIAN" / name)], check=True)
        assert "/home" not in (tmp_path / "DEBIAN" / name).read_text(), "patients' data are nobody's to remove"
    released = ElementTree.parse(tmp_path / "usr/share/metainfo/carpus.metainfo.xml").find("releases/release")
    assert released.attrib == {"version": "1.0", "date": date}
    told = [tool("appstreamcli"), "validate", "--no-net", "--pedantic", str(tmp_path / place)]
    done = subprocess.run(told, capture_output=True, text=True, check=False)
    assert "Validation" in done.stdout, done.stderr
    not_ours = ("cid-desktopapp-is-not-rdns", "url-homepage-missing")  # no domain belongs to the project, no page yet
    faults = [line for line in done.stdout.splitlines() if line.startswith(("E:", "W:"))]
    assert [line for line in faults if not any(known in line for known in not_ours)] == []


def test_second_package_fits_one_version_and_debian_reads_changelog(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    debian = script(HERE / "debian.py", monkeypatch)
    assert debian.CAMERAS_EXTRA == CAMERAS_EXTRA
    assert "Depends: carpus (= 1.2.3~rc4)\n" in debian.extra_control("1.2.3rc4", 1000, "amd64")
    (tmp_path / "changelog").write_text(debian.changelog("1.2.3rc4", datetime(2026, 11, 22, tzinfo=UTC)))
    asked = [tool("dpkg-parsechangelog"), "-l", str(tmp_path / "changelog"), "-S"]
    for field, value in (("Version", "1.2.3~rc4"), ("Date", "Sun, 22 Nov 2026 00:00:00 +0000")):
        told = subprocess.run([*asked, field], capture_output=True, text=True, check=True)
        assert (told.stdout.strip(), told.stderr) == (value, "")


def test_desktop_entry_is_valid_and_opens_sessions() -> None:
    path = LINUX / "carpus.desktop"
    told = subprocess.run([tool("desktop-file-validate"), str(path)], capture_output=True, text=True, check=False)
    assert (told.returncode, told.stdout + told.stderr) == (0, "")
    entry = configparser.ConfigParser(interpolation=None)
    entry.read(path, encoding="utf-8")
    assert entry["Desktop Entry"]["MimeType"] == f"{MIME};"
    for section in entry.sections():  # what is started is there
        command = entry[section]["Exec"].split()
        assert command[0] == "carpus"
        assert command[1] == "%f" or command[1] in COMMANDS


def test_file_type_knows_our_sessions_and_no_others(tmp_path: Path) -> None:
    kind = ElementTree.parse(LINUX / "carpus.xml").getroot().find("m:mime-type", NAMESPACE)
    assert kind.attrib["type"] == MIME
    outer = kind.find("m:magic/m:match", NAMESPACE)
    inner = outer.find("m:match", NAMESPACE)
    begins = outer.attrib["value"].encode().decode("unicode_escape").encode("latin-1")
    first, last = map(int, inner.attrib["offset"].split(":"))
    word = inner.attrib["value"].encode()

    def is_ours(content: bytes) -> bool:
        return content.startswith(begins) and word in content[first : last + len(word)]

    for path in GOLDEN.glob("*.h5.xz"):
        assert is_ours(lzma.decompress(path.read_bytes())[: 2 * last]), path.name
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file.attrs["format"] = "another"
        file["data"] = np.arange(100)
    assert (tmp_path / "other.h5").read_bytes().startswith(begins)
    assert not is_ours((tmp_path / "other.h5").read_bytes())
    (tmp_path / "mime" / "packages").mkdir(parents=True)
    shutil.copy(LINUX / "carpus.xml", tmp_path / "mime" / "packages")
    subprocess.run([tool("update-mime-database"), str(tmp_path / "mime")], check=True, capture_output=True)
    assert f":{MIME}:*.h5" in (tmp_path / "mime" / "globs2").read_text()


def test_man_page_has_every_command(monkeypatch: pytest.MonkeyPatch) -> None:
    page = script(HERE / "man_page.py", monkeypatch).man_page("1.0", "2026-11-22", COMMANDS)
    assert page.startswith('.TH CARPUS 1 "2026-11-22" "Carpus 1.0"')
    for name in COMMANDS:
        assert f"\\fB{name.replace('-', chr(92) + '-')}\\fR" in page
    assert not [
        line for line in page.splitlines() if line.startswith(".") and not re.match(r"\.(TH|SH|B|br|TP)\b", line)
    ]


def test_package_lists_every_dependency_with_licence(monkeypatch: pytest.MonkeyPatch) -> None:
    parts = {re.sub(r"[-_.]+", "-", part.name).lower(): part for part in list_bundled_parts()}
    assert next(iter(parts)) == "carpus"
    lock = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    pinned = {line.partition("==")[0].lower() for line in lock.splitlines() if "==" in line}
    assert pinned <= {*parts, "colorama"}, "colorama is Windows's"
    assert all(part.licence for part in parts.values())
    assert not {"pytest", "ruff", "mypy"} & set(parts)
    text = licence_texts()
    for words in ("LGPL-3.0-only", "may be replaced", "SIL OPEN FONT LICENSE", "Redistribution and use in source"):
        assert words.lower() in text.lower()
    bill = script(HERE / "parts_list.py", monkeypatch).bill("1.0", parts.values())
    again = script(HERE / "parts_list.py", monkeypatch).bill("1.0", parts.values())
    assert json.dumps(bill) == json.dumps(again)
    assert (bill["bomFormat"], bill["specVersion"]) == ("CycloneDX", "1.5")
    assert {(one["name"], one["version"]) for one in bill["components"]} >= {("numpy", np.__version__)}


def test_payload_with_path_too_long_for_windows_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    setup = script(HERE / "windows" / "setup_program.py", monkeypatch)
    folder = setup.stand_in(tmp_path / "payload")
    assert setup.too_long(folder) == []
    long = folder / ("a" * 100) / ("b" * 60)
    long.parent.mkdir()
    long.write_text("")
    assert setup.too_long(folder) == [str(long.relative_to(folder))]


def test_package_contains_pinned_files_with_hashes() -> None:
    def pins(text: str) -> set[str]:
        return set(re.findall(r"^[\w.-]+==[\w.]+", text, re.MULTILINE))

    hashes = (HERE / "hashes.lock").read_text()
    locks = (ROOT / "requirements.lock", HERE / "tools.lock", HERE / "cameras.lock")
    assert pins(hashes) == set().union(*(pins(lock.read_text()) for lock in locks))
    parts = re.split(r"^(?=[\w.-]+==)", hashes, flags=re.MULTILINE)[1:]
    assert all(re.search(r"--hash=sha256:[0-9a-f]{64}", part) for part in parts)
