"""What sessions say of the measures that a person takes: shown on the form, saved only once confirmed."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date, datetime

from carpus.core.measures.manual_measurements import BOTH_MODES, FINGER_JOINTS, MEASURES, Mode
from carpus.core.model.hand.exercises import Exercise
from carpus.core.model.types import Side
from carpus.core.results.measure import Measure, negate_measure
from carpus.core.results.session_results import SessionResults

CellKey = tuple[str, Mode]


def find_measured_values(sessions: Sequence[SessionResults], side: Side, day: date) -> dict[CellKey, Measure]:
    """Return what Carpus measured of a hand's angles on a day, extension above zero in hyperextension.

    Of joints only those that the exercise bends and straightens as far as they go. A later session replaces an earlier
    one.
    """
    found: dict[CellKey, Measure] = {}
    for session in _sessions_of_hand(sessions, side):
        for mode, results in zip(BOTH_MODES, (session, session.passive_results()), strict=True):
            if results is None or session.when.date() != day:
                continue
            for measure in MEASURES:
                if measure.kind == "angle" and measure.session_measure is not None:
                    _add_known(found, (measure.id, mode), results.find(*measure.session_measure))
            for joint in _find_bent_joints(session.exercise):
                flexion, extension = (results.find(f"{joint}_flexion", end) for end in ("flexion", "extension"))
                _add_known(found, (f"{joint}_FLEXION", mode), flexion)
                _add_known(found, (f"{joint}_EXTENSION", mode), extension and negate_measure(extension))
    return found


def _add_known(found: dict[CellKey, Measure], key: CellKey, measure: Measure | None) -> None:
    if measure is not None and measure.count:
        found[key] = measure


def _find_bent_joints(exercise: Exercise) -> list[str]:
    """Return the joints of a fist's fingers; of a hook fist those beyond the MCP."""
    is_hook = exercise.joint.startswith("PIP")
    if not (exercise.has_total_motion and exercise.joint) and not is_hook:
        return []
    return [joint for finger in exercise.digits for joint in FINGER_JOINTS[finger][1 if is_hook else 0 :]]


def propose_kapandji(sessions: Sequence[SessionResults], side: Side, day: date) -> tuple[int, datetime] | None:
    """Return the least Kapandji score that a hand's last opposition up to a day shows, and when it was recorded.

    The thumb on the tip of the index finger is 3, of the little finger 6 (Kapandji 1986). What lies beyond, and touches
    that were hidden, the camera does not see.
    """
    for session in reversed([one for one in _sessions_of_hand(sessions, side) if one.when.date() <= day]):
        touches = {finger: session.find(f"TIP1-TIP{finger}", "touches") for finger in (5, 4, 3, 2)}
        if any(one is not None for one in touches.values()):
            reached = [finger for finger, one in touches.items() if one is not None and one.mean > 0.0]
            return (reached[0] + 1, session.when) if reached else None
    return None


def _sessions_of_hand(sessions: Sequence[SessionResults], side: Side) -> list[SessionResults]:
    """Return the sessions that count, in order of time."""
    return sorted(
        (one for one in sessions if one.side == side and not one.is_simulated and not one.is_excluded),
        key=lambda one: one.when,
    )
