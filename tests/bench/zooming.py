"""The review of a session of 20 minutes, zoomed and moved by the wheel: how long it does not answer."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication

from carpus.app import compose
from carpus.core.output.exercises import exercise_named
from carpus.core.output.report_content import Curves
from carpus.ui.plot.session import SessionPlot
from carpus.ui.plot.session_view import CurveView
from carpus.ui.theme import Theme

SECONDS, RATE_HZ, STEPS = 1200.0, 30.0, 40
WANTED_MS = 50.0


def report() -> Iterator[str]:
    """In at the middle and out again, then along: each step until it is painted."""
    qt = compose.application(["carpus"])
    theme = Theme("light")
    view = CurveView(theme)
    view.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose, False)
    view.resize(1232, 420)
    view.show()
    view.show_plot(SessionPlot(_curves(), exercise_named("WRIST_FE"), ()))
    qt.processEvents()
    took_ms = [
        _step_ms(view, turn, modifiers)
        for turns, modifiers in (
            ([120] * STEPS + [-120] * STEPS, Qt.KeyboardModifier.NoModifier),
            ([120] * 8, Qt.KeyboardModifier.NoModifier),
            ([-120, 120] * STEPS, Qt.KeyboardModifier.ShiftModifier),
        )
        for turn in turns
    ]
    yield f"review of {SECONDS / 60.0:.0f} minutes, {len(took_ms)} steps of the wheel until painted"
    yield f"  median {np.percentile(took_ms, 50):.1f} ms, 95th percentile {np.percentile(took_ms, 95):.1f} ms"
    yield f"  longest {max(took_ms):.1f} ms ({WANTED_MS:.0f} ms were wanted at most)"
    view.close()


def _curves() -> Curves:
    time_s = np.arange(0.0, SECONDS, 1.0 / RATE_HZ)
    noise = np.random.default_rng(1).normal(0.0, 0.4, (len(time_s), 3))
    angles_deg = np.array([8.0, 50.0, 5.0]) * np.sin(2.0 * np.pi * 0.4 * time_s)[:, None] + noise
    return Curves(time_s, angles_deg, np.full_like(angles_deg, 0.7), np.zeros(len(time_s), dtype=np.int64))


def _step_ms(view: CurveView, turn: int, modifiers: Qt.KeyboardModifier) -> float:
    face = view.face
    at = QPointF(view.panels()[0][0].box.center().toPoint())
    event = QWheelEvent(
        at, face.mapToGlobal(at), QPoint(), QPoint(0, turn), Qt.MouseButton.NoButton, modifiers,
        Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    begin = time.perf_counter()
    QApplication.sendEvent(face, event)
    QApplication.processEvents()
    return 1e3 * (time.perf_counter() - begin)
