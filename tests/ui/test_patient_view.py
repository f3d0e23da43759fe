"""The patient's own view: what it asks for, that it never shows an old pose, and where it opens."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import pytest
from pytestqt.qtbot import QtBot

from carpus.core.model.hand.exercises import EXERCISES, get_exercise
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.hand_pose import build_pose, find_arc
from carpus.ui.picture.movement_guide import LOST_AFTER_S, ExerciseGuide, ExerciseSnapshot, GuideScene
from carpus.ui.screens.patient.view import PatientView
from carpus.ui.words.patient import patient_words
from tests.ui.fakes import set_up

NONE = math.nan


def walk(
    guide: ExerciseGuide, values_deg: list[float], *, sure: bool = True, seen: bool = True, from_s: float = 0.0
) -> list[GuideScene]:
    """One look every tenth of a second."""
    state = {"is_measured": sure, "is_hand_visible": seen, "state": "recording", "asked": 10}
    return [
        guide.update(ExerciseSnapshot(from_s + 0.1 * number, value, **state))  # type: ignore[arg-type]
        for number, value in enumerate(values_deg)
    ]


def ramp(*corners_deg: float) -> list[float]:
    """From corner to corner by four degrees."""
    way: list[float] = []
    for start, end in pairwise(corners_deg):
        steps = max(1, round(abs(end - start) / 4))
        way += [start + (end - start) * k / steps for k in range(steps)]
    return [*way, corners_deg[-1]]


def phases(scenes: list[GuideScene]) -> list[tuple[str, int]]:
    """Each phase once, with its aim."""
    found: list[tuple[str, int]] = []
    for scene in scenes:
        if not found or found[-1] != (scene.phase, scene.direction):
            found.append((scene.phase, scene.direction))
    return found


def test_guidance_of_a_reached_goal_holds_and_then_returns() -> None:
    guide = ExerciseGuide(get_exercise("WRIST_FE"), 60.0, -40.0)
    scenes = walk(guide, [*[0.0] * 4, *ramp(0, 62), *[62.0] * 14, *ramp(62, -42), *[-42.0] * 14, *ramp(-42, 30)])
    assert phases(scenes) == [
        ("lost", 1), ("out", 1), ("there", 1), ("back", 1), ("out", -1), ("there", -1), ("back", -1), ("out", 1),
    ]  # fmt: skip
    assert guide.goals_reached == 2


def test_guidance_of_a_missed_goal_says_nothing() -> None:
    guide = ExerciseGuide(get_exercise("FIST_COMPOSITE"), 80.0, NONE)
    scenes = walk(guide, [*[5.0] * 4, *ramp(5, 60, 5, 50)])
    assert phases(scenes)[1:] == [("out", 1), ("back", 1), ("out", 1)]
    assert guide.goals_reached == 0
    words = {patient_words("FIST_COMPOSITE", scene, "adult").state for scene in scenes}
    assert words <= {"One moment.", "", "A little further", "And back"}


@pytest.mark.parametrize("sure", [True, False])
def test_uncertain_hand_fades_and_comes_back(sure: bool) -> None:
    guide = ExerciseGuide(get_exercise("WRIST_FE"), 60.0, NONE)
    walk(guide, [20.0] * 5)
    value = NONE if sure else 20.0
    unsure = walk(guide, [value] * 8, sure=False, seen=False, from_s=0.5)
    assert unsure[1].opacity < 1.0
    gone = [scene for k, scene in enumerate(unsure) if 0.1 * k >= LOST_AFTER_S]
    assert all(scene.phase == "lost" and math.isnan(scene.value_deg) for scene in gone)
    assert walk(guide, [22.0] * 5, from_s=1.4)[-1].phase == "out"


def test_fist_occluded_at_its_end_is_not_lost() -> None:
    guide = ExerciseGuide(get_exercise("FIST_COMPOSITE"), 80.0, NONE)
    walk(guide, [*[5.0] * 4, *ramp(5, 60)])
    hidden = walk(guide, [66.0] * 12, sure=False, seen=True, from_s=3.0)
    assert {scene.phase for scene in hidden} == {"hidden"}
    assert all(math.isnan(scene.value_deg) for scene in hidden)
    assert patient_words("FIST_COMPOSITE", hidden[-1], "adult").task == "Open your hand"


def test_patient_view_covers_every_exercise_and_mirrors_left(qtbot: QtBot, theme: Theme) -> None:
    view = PatientView(theme)
    qtbot.addWidget(view)
    view.resize(640, 360)
    for exercise in EXERCISES:
        scene = (
            GuideScene("out", 1, 20.0, 30.0)
            if exercise.has_repetitions
            else GuideScene("free", wrist_deg=(5.0, 20.0, 0.0))
        )
        for audience in ("adult", "child"):
            assert patient_words(exercise.id, scene, audience).task, exercise.id  # type: ignore[arg-type]
        pictures = []
        for side in ("right", "left"):
            view.show_set_up(replace(set_up(exercise.id), side=side))  # type: ignore[arg-type]
            view.show_scene(scene)
            pictures.append(view.grab().toImage())
        assert pictures[0] != pictures[1], exercise.id
        if exercise.has_repetitions:
            assert not build_pose(exercise, 25.0).hand.isEmpty()
            arc = find_arc(exercise)
            assert (arc.point(0.0) - arc.point(30.0)).manhattanLength() > 40.0
