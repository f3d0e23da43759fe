"""Carpus for Python: ``import carpus`` finds the program's parts as ``carpus.core``, ``carpus.ui`` and ``carpus.app``.

It offers :func:`track`, :func:`open_session`, :func:`simulate`, :func:`propose_clicks`, :func:`export`,
:func:`compare` and :func:`unlock`, loaded when first asked for. In a checkout the folders stand beside this file;
installed, they stand in the package that this file becomes.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from carpus.app.python_face import compare, export, open_session, propose_clicks, simulate, track, unlock

__version__ = "0.1.0"

__path__ = [str(Path(__file__).resolve().parent)]
if __spec__ is not None:  # None for `python carpus.py`
    # Says that this module has parts, for tools that ask the specification and not the module.
    __spec__.submodule_search_locations = __path__

__all__ = ["__version__", "compare", "export", "open_session", "propose_clicks", "simulate", "track", "unlock"]


def __getattr__(name: str) -> Any:
    """The functions for researchers, which bring NumPy and the tracker with them."""
    if name not in __all__:
        raise AttributeError(f"module 'carpus' has no attribute {name!r}")
    from carpus.app import python_face

    return getattr(python_face, name)


if __name__ == "__main__":
    # `python -m carpus`: the parts import this file again by its name, as everybody else does.
    from carpus.app.__main__ import main

    sys.exit(main())
