"""The house rules that no linter knows: what is imported is declared, what is declared is pinned, core stays bare."""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from pathlib import Path

import pytest
from threadpoolctl import threadpool_info

from tests.sources import ROOT, SOURCES, modules, nodes

pytestmark = SOURCES

OWN = ("carpus",)
PROGRAM = ("app", "core", "ui")
"""What runs at the user's; ``resources`` also keeps the scripts that made its files."""
EXTRAS = ("cluster", "research", "stream", "realsense")
"""What is installed only when asked for; the code that needs it says so where it is missing."""
BUILD_ONLY = {"cython"}
"""What the compiled modules are built with; once built they do not import it."""
BROUGHT_BY = {
    "argon2": "argon2-cffi",
    "cv2": "opencv-python-headless",
    "yaml": "pyyaml",
    "pyorbbecsdk": "pyorbbecsdk2",
    "PySide6": "pyside6-essentials",
    "shiboken6": "pyside6-essentials",
}
LEGAL_SENTENCE = (
    "For research and education. Not a medical device, not CE-marked or FDA-cleared; values support, and do not "
    "replace, the judgement of a qualified clinician; do not use as the only basis for diagnosis or treatment."
)


def imported_packages(path: Path) -> set[str]:
    """Top-level names of every absolute import of a file, also those inside functions."""
    names: set[str] = set()
    for node in nodes(path):
        if isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            names.add(node.module.split(".")[0])
    return names


def declared(*extras: str) -> set[str]:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lines = project["dependencies"] + [line for name in extras for line in project["optional-dependencies"][name]]
    return {re.split(r"[<>=!~ \[;]", line)[0].lower() for line in lines}


def pinned(lock: str) -> dict[str, str]:
    lines = (ROOT / lock).read_text(encoding="utf-8").splitlines()
    pins = (line.split("#")[0].strip().split("==") for line in lines if line.split("#")[0].strip())
    return {name.partition("[")[0]: version for name, version in pins}


def test_imports_are_declared_dependencies() -> None:
    foreign = {
        name
        for path in modules(*PROGRAM)
        for name in imported_packages(path)
        if name not in sys.stdlib_module_names | set(OWN) | BUILD_ONLY
    }
    assert "numpy" in foreign
    known = declared(*EXTRAS) | set(pinned("requirements-alone.lock"))
    undeclared = {name for name in foreign if BROUGHT_BY.get(name, name.lower()) not in known}
    assert not undeclared
    assert declared(*EXTRAS) <= set(pinned("requirements-dev.lock")), (
        "what is not always installed is tested all the same"
    )


@pytest.mark.parametrize("lock", ["requirements.lock", "requirements-dev.lock"])
def test_dependencies_are_pinned_without_registry_host(lock: str) -> None:
    assert declared() <= set(pinned(lock))
    text = (ROOT / lock).read_text(encoding="utf-8")
    assert "://" not in text
    assert "/" not in text.replace(" / ", "")


def test_lock_files_agree() -> None:
    run, dev = pinned("requirements.lock"), pinned("requirements-dev.lock")
    assert {name: dev[name] for name in run} == run


def test_displayed_numbers_are_rounded_by_one_function() -> None:
    """Halves away from zero: Python's own formats round them to even."""
    own = re.compile(r"\{[^{}\"]+:\.\df\}")
    texts = [path for path in modules("ui", "core") if {"ui", "results"} & set(path.relative_to(ROOT).parts)]
    assert len(texts) > 100
    lines = ((path.name, line) for path in texts for line in path.read_text("utf-8").splitlines() if own.search(line))
    assert [one for one in lines if "times[row]" not in one[1]] == []


def test_readme_tells_the_two_commands_and_contributing_has_the_map() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert LEGAL_SENTENCE in " ".join(text.replace("> ", "").split())
    assert "make run" in text
    assert "make test" in text
    assert "Occluded joints are predicted and marked as such" in " ".join(text.split())
    house = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    tools = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]
    contracts = tools["importlinter"]["contracts"]
    (floors,) = (one["layers"] for one in contracts if one.get("containers") == ["carpus.core"])
    floor_of = {part: number for number, floor in enumerate(floors) for part in floor.split(" | ")}
    rooms = re.findall(r"^  ((?:\w+(?:/|\.py) )+) ", house.partition("\ncore/ ")[2].partition("\nresources/")[0], re.M)
    parts = [re.sub(r"/|\.py", "", part) for room in rooms for part in room.split()]
    assert sorted(parts) == sorted(floor_of), "the map misses a part of core, or has one that is gone"
    assert [floor_of[part] for part in parts] == sorted(floor_of.values()), "the map is in the order of the floors"


LINK = re.compile(r"\]\(([^)#:]+)(?:#([\w-]+))?\)")


@pytest.mark.parametrize(
    "page",
    [
        ROOT / "README.md",
        ROOT / "CONTRIBUTING.md",
        *sorted((ROOT / "resources").glob("*.md")),
        *sorted((ROOT / "resources/research-notes").glob("*.md")),
    ],
    ids=lambda p: p.name,
)
def test_links_between_pages_lead_somewhere(page: Path) -> None:
    for target, heading in LINK.findall(page.read_text(encoding="utf-8")):
        there = page.parent / target
        assert there.exists(), f"{page.name}: {target}"
        if heading:
            lines = there.read_text(encoding="utf-8").splitlines()
            titles = {
                re.sub(r"[^\w -]", "", line.lstrip("# ")).lower().replace(" ", "-") for line in lines if line[:1] == "#"
            }
            assert heading in titles, f"{page.name}: {target}#{heading}"


def test_files_name_no_path_of_one_machine() -> None:
    places = re.compile(r"/(?:home|root|work|Users)/\w")
    for path in [*modules(*PROGRAM), *(ROOT / "installer").glob("*"), ROOT / "README.md", ROOT / "Makefile"]:
        if path.is_file():
            assert not places.search(path.read_text(encoding="utf-8", errors="replace")), path


def test_linear_algebra_runs_on_one_thread() -> None:
    import numpy.linalg  # noqa: F401  (loads the library that is asked about)
    import scipy.linalg  # noqa: F401

    pools = [pool for pool in threadpool_info() if pool["user_api"] == "blas"]
    assert pools
    assert {pool["num_threads"] for pool in pools} == {1}
