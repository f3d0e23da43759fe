"""The review of a session of 20 minutes, zoomed and moved by the wheel: how long it does not answer."""

from __future__ import annotations

import gc
import time
from collections.abc import Iterator

import numpy as np
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication

from carpus.app.desktop.appearance import create_application
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.results.valid_data import JointCurves, WristCurves
from carpus.ui.charts.session import HandPlot, SessionChart, SessionPlot
from carpus.ui.kit.theme import Theme
from carpus.ui.words.finger_angles import FINGER_ANGLES

SECONDS, RATE_HZ, STEPS = 1200.0, 30.0, 40
WANTED_MS = 50.0


def report() -> Iterator[str]:
    """In at the middle and out again, then along: each step until it is painted; of the wrist and of the whole hand."""
    qt = create_application(["carpus"])
    gc.collect()
    gc.freeze()  # as the program does before a session is opened
    curves = _curves()
    for words, plot in (
        ("wrist", SessionPlot(curves, get_exercise("WRIST_FE"), ())),
        ("whole hand", HandPlot(curves, get_exercise("FIST_COMPOSITE"), (), joints=_joints(curves))),
    ):
        view = SessionChart(Theme("light"))
        view.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose, False)
        view.resize(1232, 420)
        view.show()
        view.show_plot(plot)
        qt.processEvents()
        took = [
            _step_ms(view, turn, modifiers)
            for turns, modifiers in (
                ([120] * STEPS + [-120] * STEPS, Qt.KeyboardModifier.ControlModifier),
                ([120] * 8, Qt.KeyboardModifier.ControlModifier),
                ([-120, 120] * STEPS, Qt.KeyboardModifier.ShiftModifier),
            )
            for turn in turns
        ]
        yield f"review of {SECONDS / 60.0:.0f} minutes, {words}, {len(took)} steps of the wheel until painted"
        for clock, many_ms in zip(("on the clock", "CPU time"), np.array(took).T, strict=True):
            p50, p95, most = np.percentile(many_ms, (50.0, 95.0, 100.0))
            yield f"  {clock}: median {p50:.1f} ms, 95th percentile {p95:.1f} ms, longest {most:.1f} ms"
        view.close()
    yield f"{WANTED_MS:.0f} ms were wanted at most; on a computer that does other work too the CPU time says more"


def _curves() -> WristCurves:
    time_s = np.arange(0.0, SECONDS, 1.0 / RATE_HZ)
    noise = np.random.default_rng(1).normal(0.0, 0.4, (len(time_s), 3))
    angles_deg = np.array([8.0, 50.0, 5.0]) * np.sin(2.0 * np.pi * 0.4 * time_s)[:, None] + noise
    return WristCurves(time_s, angles_deg, np.full_like(angles_deg, 0.7), np.zeros(len(time_s), dtype=np.int64))


def _joints(curves: WristCurves) -> JointCurves:
    """All joints bend and straighten in turn, with the wrist's noise."""
    names = tuple(dict.fromkeys(figure.joint for figure in FINGER_ANGLES if figure.kind != "tam"))
    bent = np.abs(curves.angles_deg[:, 1:2]) + np.arange(len(names))
    noise = np.random.default_rng(2).normal(0.0, 0.4, bent.shape)
    return JointCurves(names, curves.time_s, bent + noise, np.full_like(bent, 0.7), np.ones(bent.shape, dtype=bool))


def _step_ms(view: SessionChart, turn: int, modifiers: Qt.KeyboardModifier) -> tuple[float, float]:
    """On the clock, and CPU time of the window's thread."""
    face = view.mouse_target
    at = QPointF(view.panels()[0][0].box.center().toPoint())
    event = QWheelEvent(
        at, face.mapToGlobal(at), QPoint(), QPoint(0, turn), Qt.MouseButton.NoButton, modifiers,
        Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    begin_s, cpu_s = time.perf_counter(), time.thread_time()
    QApplication.sendEvent(face, event)
    QApplication.processEvents()
    return 1e3 * (time.perf_counter() - begin_s), 1e3 * (time.thread_time() - cpu_s)
