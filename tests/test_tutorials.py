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


def test_tutorials_run_to_their_ends_and_draw(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One after the other in one kernel and folder: they share a recording, and what loads for seconds."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    notebooks = [nbformat.read(path, as_version=4) for path in TUTORIALS]
    cells = []
    for notebook in notebooks:
        assert all(not cell.get("outputs") for cell in notebook.cells), "outputs are made with the site, not kept"
        cells += [nbformat.v4.new_code_cell("%reset -f"), *notebook.cells]
        for cell in notebook.cells:
            for long, short in SHORTER.items():
                cell.source = cell.source.replace(long, short)
    for number, cell in enumerate(cells):
        cell.id = f"cell-{number}"
    whole = nbformat.v4.new_notebook(cells=cells, metadata=notebooks[0].metadata)
    NotebookClient(whole, timeout=280, resources={"metadata": {"path": str(tmp_path)}}).execute()
    for path, notebook in zip(TUTORIALS, notebooks, strict=True):
        shown = [output for cell in notebook.cells for output in cell.get("outputs", [])]
        assert shown, path
        drawn = [output for output in shown if "image/png" in output.get("data", {})]
        assert drawn or path.stem.startswith("4"), "a figure"
