"""The live cameras that there are: one line here and one module for each.

Its class takes ``uri``, ``camera`` (measured intrinsics or None) and ``notice`` by name, and is a
:class:`LiveCamera`. It is loaded, and its driver needed, only when it is opened.
"""

from __future__ import annotations

from importlib import import_module
from typing import Protocol

from carpus.core.camera import Camera
from carpus.core.capture.notice import Notice, ignore
from carpus.core.capture.source import FrameSource

CAMERAS = {
    "xtion": ("xtion", "XtionSource"),
}
"""Module and class by kind; the first is the usual one."""


class LiveCamera(FrameSource, Protocol):
    """A source of frames that runs from construction on."""

    def lock_exposure(self) -> None:
        """From now on colours stay as they are."""
        ...


def kind_of(uri: str) -> str:
    """Which kind a camera's address names before its first colon; the usual one where it names none."""
    named = uri.partition(":")[0]
    return named if named in CAMERAS else next(iter(CAMERAS))


def open_camera(uri: str = "", *, camera: Camera | None = None, notice: Notice = ignore) -> LiveCamera:
    """Open a camera by its address, empty for the first that is found. Raises the faults of its module."""
    module, name = CAMERAS[kind_of(uri)]
    source: LiveCamera = getattr(import_module(f"{__package__}.{module}"), name)(
        uri=uri or None, camera=camera, notice=notice
    )
    return source
