"""``make screenshots``: every screen, light and dark, at 1280x800 and 1920x1080, into ``out/screenshots``."""

from __future__ import annotations

import argparse
import gc
import os
import shutil
import sys
import tempfile
from pathlib import Path

FOLDER = Path("out/screenshots")
GUIDE = Path("resources/guide")
GUIDE_PICTURES = {
    "patients": "patients", "exercise": "exercise", "markers": "markers_clicking", "live": "live", "review": "review",
    "progress": "progress", "patient": "patient_view", "correct": "correct", "sessions": "sessions_list",
    "board": "board_showing", "card": "card_measuring", "comparison": "comparison",
}  # fmt: skip
"""Names of the guide's pictures, and the states they show."""
GUIDE_QUALITY = 82
README_PICTURE = Path("resources/pictures/live.jpg")
README_SIZE = (1280, 800)
README_QUALITY = 92


def main() -> int:
    """Render all screens, or those whose name begins as told."""
    parser = argparse.ArgumentParser(prog="python -m tests.screenshots", description=__doc__)
    parser.add_argument("only", nargs="?", default="", help="beginning of a screen's name, such as live")
    parser.add_argument("--output", type=Path, default=FOLDER, metavar="FOLDER")
    parser.add_argument("--large-text", action="store_true", help="also at 150 %% text size")
    parser.add_argument("--language", default="en", help="of the window: en, de or it")
    parser.add_argument("--readme", action="store_true", help=f"only the README's picture, {README_PICTURE}")
    parser.add_argument("--guide", action="store_true", help=f"only the guide's pictures and cards, into {GUIDE}")
    arguments = parser.parse_args()
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
        os.environ.setdefault(name, "1")  # before anything loads NumPy
    from tests.ui.gallery import render_all_screens

    gc.disable()  # as the command does: a collection while pyqtgraph builds an item ends the process

    if arguments.readme:
        return write_readme_picture()
    if arguments.guide:
        return write_guide()
    if not arguments.only and arguments.output == FOLDER:
        shutil.rmtree(arguments.output, ignore_errors=True)  # no picture of a screen that is no more
    scales = (1.0, 1.5) if arguments.large_text else (1.0,)
    written = render_all_screens(arguments.output, scales=scales, only=arguments.only, language=arguments.language)
    print(f"{len(written)} pictures in {arguments.output}")
    return 0 if written else 1


def write_readme_picture() -> int:
    """The live screen in light, as a file small enough for a page."""
    from PySide6.QtGui import QImage

    from tests.ui.gallery import render_all_screens

    gc.disable()  # as the command does: a collection while pyqtgraph builds an item ends the process

    with tempfile.TemporaryDirectory() as folder:
        written = render_all_screens(Path(folder), sizes=(README_SIZE,), only="live")
        picture = QImage(str(next(path for path in written if "-live-light-" in path.name)))
    README_PICTURE.parent.mkdir(exist_ok=True)
    picture.save(str(README_PICTURE), None, README_QUALITY)
    print(f"{README_PICTURE}, {README_PICTURE.stat().st_size // 1000} kB")
    return 0


def write_guide() -> int:
    """Pictures of the screens, drawings, and the cards to print."""
    from PySide6.QtCore import QRectF
    from PySide6.QtGui import QColor, QImage, QPainter

    from carpus.ui.kit.language import LANGUAGES, set_window_language
    from carpus.ui.screens.help.guide import CARDS_FILE_NAME, write_cards
    from tests.ui.gallery import render_all_screens

    gc.disable()  # as the command does: a collection while pyqtgraph builds an item ends the process
    from tests.ui.guide_drawings import paint_camera_setup, paint_marker_map

    for code in LANGUAGES:
        for name, state in GUIDE_PICTURES.items():
            with tempfile.TemporaryDirectory() as rendered:
                written = render_all_screens(
                    Path(rendered), sizes=(README_SIZE,), states=(state,), themes=("light",), language=code
                )
                picture = QImage(str(next(path for path in written if f"-{state}-light-" in path.name)))
            picture.save(str(GUIDE / code / f"{name}.jpg"), None, GUIDE_QUALITY)
        for name, paint in (
            ("discs-6", lambda painter, box: paint_marker_map(painter, box, "right", whole_hand=False, unit=2.0)),
            ("discs-21", lambda painter, box: paint_marker_map(painter, box, "right", whole_hand=True, unit=2.0)),
            ("camera-setup", lambda painter, box: paint_camera_setup(painter, box, 2.0)),
        ):
            drawn = QImage(1440, 900, QImage.Format.Format_RGB32)
            drawn.fill(QColor("#FFFFFF"))
            painter = QPainter(drawn)
            paint(painter, QRectF(60, 30, 1320, 840))
            painter.end()
            drawn.save(str(GUIDE / code / f"{name}.png"))
    set_window_language("en")
    write_cards(GUIDE / CARDS_FILE_NAME)
    print(f"{len(LANGUAGES) * (len(GUIDE_PICTURES) + 3)} pictures and {CARDS_FILE_NAME} in {GUIDE}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
