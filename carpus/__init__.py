"""Carpus for Python: ``import carpus`` finds the program's parts as ``carpus.core``, ``carpus.ui`` and ``carpus.app``.

It offers :func:`track`, :func:`write_session`, :func:`open_session`, :func:`open_sessions`, :func:`simulate`,
:func:`propose_clicks`, :func:`export` and :func:`compare`, loaded when first asked for. In a checkout the parts are
links to the folders beside this one; installed, they are folders.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from carpus.core.platform.version import __version__

if TYPE_CHECKING:
    from carpus.app.opened_session import open_session, open_sessions
    from carpus.app.python_api import compare, export, propose_clicks, simulate, track, write_session

__all__ = [
    "__version__", "compare", "export", "open_session", "open_sessions", "propose_clicks", "simulate", "track",
    "write_session",
]  # fmt: skip


def __getattr__(name: str) -> Any:
    """Load a function for researchers and what it needs: opening a session loads no tracker."""
    if name not in __all__:
        raise AttributeError(f"module 'carpus' has no attribute {name!r}")
    module = "opened_session" if name.startswith("open_") else "python_api"
    return getattr(import_module(f"carpus.app.{module}"), name)


def __dir__() -> list[str]:
    """List all names, also those that are loaded only when they are asked for."""
    return sorted(__all__)
