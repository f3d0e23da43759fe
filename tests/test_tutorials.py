"""The tutorials: each notebook runs from its first cell to its last, and draws what it promises."""

from __future__ import annotations

from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

from tests.sources import ROOT

TUTORIALS = sorted((ROOT / "resources" / "tutorials").glob("*.ipynb"))
SHORTER = {"PEOPLE, WEEKS = 4, 5": "PEOPLE, WEEKS = 1, 2", "seconds=4.0, fps=15.0": "seconds=2.5, fps=12.0"}
"""A test renders less than a reader does."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where all run, so that they share a recording."""
    return tmp_path_factory.mktemp("tutorials")


@pytest.mark.xdist_group("tutorials")
@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_tutorial_runs_to_its_end(path: Path, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    notebook = nbformat.read(path, as_version=4)
    assert all(not cell.get("outputs") for cell in notebook.cells), "outputs are made with the site, not kept"
    for cell in notebook.cells:
        for long, short in SHORTER.items():
            cell.source = cell.source.replace(long, short)
    NotebookClient(notebook, timeout=280, resources={"metadata": {"path": str(folder)}}).execute()
    shown = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    drawn = [output for output in shown if "image/png" in output.get("data", {})]
    assert drawn or path.stem.startswith("4"), "a figure"
    assert shown
