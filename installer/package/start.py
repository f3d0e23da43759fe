"""Where the packaged program starts. Its helper processes start here too: the first call sends them to their work."""

from __future__ import annotations

import multiprocessing
import sys
from types import ModuleType
from typing import Any


class NoOpenGL(ModuleType):
    """Stand-in for Qt's OpenGL modules.

    pyqtgraph imports these 10 MB for OpenGL curves, which Carpus does not use; its classes derive from what is here.
    """

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        from PySide6.QtWidgets import QWidget

        return QWidget


def without_opengl() -> None:
    """Before anything of Qt is imported."""
    for name in ("PySide6.QtOpenGL", "PySide6.QtOpenGLWidgets"):
        sys.modules[name] = NoOpenGL(name)


if __name__ == "__main__":
    multiprocessing.freeze_support()
    without_opengl()
    from carpus.app.__main__ import main

    sys.exit(main())
