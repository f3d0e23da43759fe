"""The tutorials run and written as pages with what they print and draw, for the documentation site.

``python installer/tutorials.py NOTEBOOKS PAGES`` runs in the environment of the tests, whose kernel has Carpus.
"""

from __future__ import annotations

import base64
import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient


def write_page(notebook: nbformat.NotebookNode, page: Path) -> None:
    """Write the cells as Markdown, and each picture beside the page."""
    lines: list[str] = []
    for cell in notebook.cells:
        lines += [cell.source if cell.cell_type == "markdown" else f"```python\n{cell.source}\n```", ""]
        printed = "".join(output["text"] for output in cell.get("outputs", []) if output.output_type == "stream")
        # Of a progress bar the last state.
        text = "\n".join(line.rpartition("\r")[2] for line in printed.replace("\r\n", "\n").rstrip().split("\n"))
        lines += ["```text", text, "```", ""] if printed.strip() else []
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            if "image/png" in data:
                picture = page.with_name(f"{page.stem}-{len(lines)}.png")
                picture.write_bytes(base64.b64decode(data["image/png"]))
                lines += [f"![What the cell above draws]({picture.name})", ""]
            elif "text/html" in data:
                lines += [data["text/html"].replace("\n\n", "\n").replace(' border="1" class="dataframe"', ""), ""]
            elif "text/plain" in data:
                lines += ["```text", data["text/plain"].rstrip(), "```", ""]
    page.write_text("\n".join(lines), encoding="utf-8")


def main(notebooks: Path, pages: Path) -> None:
    """Run all notebooks in one folder, so that they share recordings."""
    pages.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(notebooks.glob("*.ipynb")):
            notebook = nbformat.read(path, as_version=4)
            NotebookClient(notebook, timeout=3600, resources={"metadata": {"path": folder}}).execute()
            write_page(notebook, pages / f"{path.stem}.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
