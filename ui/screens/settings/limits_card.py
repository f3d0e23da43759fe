"""Card of the settings with the MDC95 of each angle."""

from __future__ import annotations

import math
from datetime import date

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from carpus.core.measures.change_limits import (
    ARC_LIMIT_FACTOR,
    DEFAULT_LIMITS,
    MIN_PEOPLE,
    TOTAL_ACTIVE_MOTION,
    ErrorLimits,
    RetestStudy,
    change_limit_rad,
)
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.ui.kit import numbers
from carpus.ui.kit.card import Card
from carpus.ui.kit.layouts import column_layout, fill, grid_layout
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import to_mid_sentence, tr
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import find_finger_angle
from carpus.ui.words.progress import error_limit_words


def limits_card(theme: Theme, measured: ErrorLimits = DEFAULT_LIMITS) -> Card:
    """Return the card with default limits in two columns, and the clinic's own below."""
    card = Card(theme, 24)
    card.add_heading(tr("Measurement error (MDC95)"), error_limit_words())
    grid = grid_layout(24, 6)
    lines = limit_rows()
    half = (len(lines) + 1) // 2
    for place, (name, limit) in enumerate(lines):
        column = 2 * (place // half)
        grid.addWidget(Text(theme, name, 14, wrap=True), place % half, column)
        grid.addWidget(Text(theme, limit, 14, MEDIUM), place % half, column + 1, Qt.AlignmentFlag.AlignRight)
    grid.setColumnStretch(0, 1)
    grid.setColumnStretch(2, 1)
    card.body.addLayout(grid)
    for study in measured.studies:
        fill(card.body, 8, study_view(theme, study, study_words(study)))
    return card


def study_view(theme: Theme, study: RetestStudy, words: str) -> QWidget:
    """Return a study's title, summary and table of limits."""
    title = tr("Measured by this clinic: {exercise}").format(exercise=terms.exercise_name(study.exercise))
    table = grid_layout(24, 6)
    for place, cells in enumerate(study_rows(study)):
        for column, cell in enumerate(cells):
            table.addWidget(Text(theme, cell, 14, MEDIUM if column == len(cells) - 1 else REGULAR), place, column)
    table.setColumnStretch(0, 1)
    view = QWidget()
    column_layout(
        Text(theme, title, 16, SEMIBOLD), Text(theme, words, 14, REGULAR, "text2", wrap=True), table,
        margins=(0, 0, 0, 0), parent=view,
    )  # fmt: skip
    return view


def study_words(study: RetestStudy) -> str:
    """Return when and with how many people a study was made, and whether it is used."""
    summary = tr(
        "Measured on {date} with {count} people in {sessions} sessions. 95 % confidence intervals are in brackets."
    ).format(date=numbers.format_date(date.fromisoformat(study.made)), count=study.people, sessions=study.sessions)
    if study.is_in_force:
        return summary + " " + tr("Used in progress and reports instead of the values above.")
    return summary + " " + tr("Not used: at least {count} people are needed.").format(count=MIN_PEOPLE)


def study_rows(study: RetestStudy) -> list[tuple[str, str, str]]:
    """Return name, SEM and MDC95 with its interval for each limit of a study."""
    out = []
    for limit in study.limits:
        arc = limit.movement == "arc"
        name = terms.movement_name(limit.movement) if limit.of in WRIST_ANGLES else ""
        if limit.of in WRIST_ANGLES and arc:
            name = terms.arc_name(WRIST_ANGLES.index(limit.of))
        elif limit.of not in WRIST_ANGLES:
            name = find_finger_angle(limit.of).long_name + (
                "" if arc else f", {to_mid_sentence(terms.movement_name(limit.movement))}"
            )
        low, high = limit.mdc95_interval_deg
        sem = tr("SEM {size}").format(size=_format_tenths(limit.sem_deg))
        change = f"{numbers.format_degrees(limit.limit_deg)} ({_format_tenths(low)} – {_format_tenths(high)})"
        few = "" if limit.people >= MIN_PEOPLE else " · " + tr("{count} people, not used").format(count=limit.people)
        out.append((name, sem, change + few))
    return out


def _format_tenths(size_deg: float) -> str:
    return f"{numbers.format_fixed(size_deg, 1)}°" if math.isfinite(size_deg) else numbers.UNKNOWN


def limit_rows() -> list[tuple[str, str]]:
    """Return the name and limit of each kind of angle; for the wrist one end and the total arc."""
    named = (
        (tr("Flexion, extension"), tr("Flexion–extension, total arc"), "flexion"),
        (tr("Radial, ulnar deviation"), tr("Radial–ulnar deviation, total arc"), "deviation"),
        (tr("Supination, pronation"), tr("Pronation–supination, total arc"), "pronosupination"),
    )
    out = []
    for end, arc, angle in named:
        limit_deg = math.degrees(change_limit_rad(angle))
        out += [(end, numbers.format_degrees(limit_deg)), (arc, numbers.format_degrees(ARC_LIMIT_FACTOR * limit_deg))]
    joints = (
        (tr("Range of motion of a finger’s MCP, PIP or DIP"), "PIP3_flexion"),
        (tr("Range of finger abduction"), "MCP2_abduction"),
        (tr("Range of motion of the thumb joints"), "CMC1_abduction"),
    )
    for name, joint in joints:
        out.append((name, numbers.format_degrees(ARC_LIMIT_FACTOR * math.degrees(change_limit_rad(joint)))))
    return [
        *out,
        (tr("Total active motion (TAM)"), numbers.format_degrees(math.degrees(change_limit_rad(TOTAL_ACTIVE_MOTION)))),
    ]
