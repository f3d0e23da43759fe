"""The documentation site: every page is in it once, and its tools are pinned apart from what runs."""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest

import carpus
from carpus.app.commands import COMMANDS
from tests.installer.test_package import script

ROOT = Path(__file__).parents[2]


@pytest.fixture
def docs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    module = script(ROOT / "installer" / "docs.py", monkeypatch)
    monkeypatch.setattr(module, "PAGES", tmp_path / "docs")
    monkeypatch.setattr(module, "SOURCE", tmp_path / "source")
    monkeypatch.setattr(module, "TUTORIALS", tmp_path / "tutorials")
    module.lay_out()
    return module


def pages(entry: object) -> list[str]:
    if isinstance(entry, str):
        return [entry]
    found = entry.values() if isinstance(entry, dict) else entry
    assert not isinstance(found, int)
    return [page for one in found for page in pages(one)]  # type: ignore[attr-defined]


def test_docs_site_has_every_page_once(docs: ModuleType) -> None:
    named = pages(docs.navigation())
    there = {str(path.relative_to(docs.PAGES)) for path in docs.PAGES.rglob("*.md")}
    assert sorted(named) == sorted(there)
    kept = {str(path.relative_to(ROOT)) for path in [*ROOT.glob("*.md"), *(ROOT / "resources").rglob("*.md")]}
    assert kept <= there, "a page that nobody can find"


def test_every_command_and_public_function_is_in_the_reference(docs: ModuleType) -> None:
    assert {name for names in docs.COMMANDS.values() for name in names} == set(COMMANDS)
    assert "usage: carpus track" in (docs.PAGES / "commands.md").read_text()
    named = {name for names in docs.REFERENCE.values() for name in names}
    assert named >= set(carpus.__all__) - {"__version__"}
    for module, names in docs.REFERENCE.items():
        assert all(hasattr(import_module(module), name) for name in names), module
        assert not re.search(r":\w+:`", (docs.SOURCE / f"{module.replace('.', '/')}.py").read_text()), "a raw role"


def test_pictures_of_the_guide_are_found_and_no_warning_is_kept_quiet(docs: ModuleType) -> None:
    shown = [
        (path, name)
        for path in docs.PAGES.rglob("*.md")
        for name in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", path.read_text())
    ]
    assert len(shown) > 40
    assert all((path.parent / name).is_file() for path, name in shown)
    assert "--quiet" not in Path(docs.__file__).read_text(), "MkDocs counts only the warnings that it says"


def test_search_of_a_folder_loads_nothing_from_the_net(docs: ModuleType) -> None:
    (frame,) = docs.config()["extra"]["polyfills"]
    assert (docs.PAGES / frame).is_file()
    assert "iframe-worker" in frame, "else the plugin adds its own address"


def test_citation_names_version_and_day_of_last_release() -> None:
    cited = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    released = re.findall(
        r"^## \[([\d.]+)\] - ([\d-]+)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE
    )
    assert (f"version: {released[0][0]}\n" in cited, f"date-released: {released[0][1]}\n" in cited) == (True, True)
