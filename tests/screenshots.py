"""``make screenshots``: every screen, light and dark, at 1280x800 and 1920x1080, into ``out/screenshots``."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

FOLDER = Path("out/screenshots")
README_PICTURE = Path("resources/pictures/live.jpg")
README_SIZE = (1280, 800)
README_QUALITY = 92


def main() -> int:
    """Render all screens, or those whose name begins as told."""
    parser = argparse.ArgumentParser(prog="python -m tests.screenshots", description=__doc__)
    parser.add_argument("only", nargs="?", default="", help="beginning of a screen's name, such as live")
    parser.add_argument("--output", type=Path, default=FOLDER, metavar="FOLDER")
    parser.add_argument("--large-text", action="store_true", help="also at 150 %% text size")
    parser.add_argument("--readme", action="store_true", help=f"only the README's picture, {README_PICTURE}")
    arguments = parser.parse_args()
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
        os.environ.setdefault(name, "1")  # before anything loads NumPy
    from tests.ui.gallery import render_all_screens

    if arguments.readme:
        return write_readme_picture()
    if not arguments.only and arguments.output == FOLDER:
        shutil.rmtree(arguments.output, ignore_errors=True)  # no picture of a screen that is no more
    scales = (1.0, 1.5) if arguments.large_text else (1.0,)
    written = render_all_screens(arguments.output, scales=scales, only=arguments.only)
    print(f"{len(written)} pictures in {arguments.output}")
    return 0 if written else 1


def write_readme_picture() -> int:
    """The live screen in light, as a file small enough for a page."""
    from PySide6.QtGui import QImage

    from tests.ui.gallery import render_all_screens

    with tempfile.TemporaryDirectory() as folder:
        written = render_all_screens(Path(folder), sizes=(README_SIZE,), only="live")
        picture = QImage(str(next(path for path in written if "-live-light-" in path.name)))
    README_PICTURE.parent.mkdir(exist_ok=True)
    picture.save(str(README_PICTURE), None, README_QUALITY)
    print(f"{README_PICTURE}, {README_PICTURE.stat().st_size // 1000} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
