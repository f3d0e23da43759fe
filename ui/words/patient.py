"""Texts for the patient: plain words for an adult, one or two for a child."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from carpus.core.model.hand.exercises import find_exercise, get_exercise
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.picture.movement_guide import GuideScene

Audience = Literal["adult", "child"]
# From this share of the goal on: a little further.
MIN_FURTHER_SHARE = 0.5


@dataclass(frozen=True, slots=True)
class PatientWords:
    """The ``task`` above, and the ``state`` below in the largest letters."""

    task: str
    state: str


def patient_words(exercise_id: str, scene: GuideScene, audience: Audience) -> PatientWords:
    """Return the texts of a scene."""
    child = audience == "child"
    if scene.phase == "away":
        return PatientWords("", tr("One moment."))
    if scene.phase == "lost":
        return PatientWords(tr("Show the dots") if child else tr("Show the blue dots to the camera"), tr("One moment."))
    if scene.phase == "paused":
        return PatientWords("" if child else tr("Let your hand rest."), tr("A short break."))
    if scene.phase in ("done", "rest"):
        return PatientWords("" if child else tr("Let your hand rest."), tr("Well done."))
    if scene.countdown_s:
        return PatientWords(tr("Hold still") if child else tr("Let your hand lie still"), f"{scene.countdown_s} …")
    if scene.phase == "free":
        return PatientWords(_task_words(exercise_id, 1, child), tr("Just try it.") if scene.is_trial else "")
    task = _task_words(exercise_id, scene.direction, child)
    if scene.phase in ("back", "hidden"):
        back = task if child else translate_phrase(get_exercise(exercise_id).return_cue)
        return PatientWords(back, tr("Back") if child else tr("And back"))
    if scene.phase == "there":
        return PatientWords(task, tr("There!") if child else tr("There. Hold still."))
    if scene.is_trial:
        return PatientWords(task, tr("Just try it."))
    if scene.goal_deg != scene.goal_deg:
        return PatientWords(task, "" if child else tr("As far as is comfortable"))
    return PatientWords(
        task, (tr("Further") if child else tr("A little further")) if scene.goal_share >= MIN_FURTHER_SHARE else ""
    )


def remaining_rest_words(seconds: int) -> str:
    """Return how much longer a rest lasts."""
    if seconds > 75:
        return tr("A few minutes")
    if seconds > 40:
        return tr("About a minute")
    return tr("About half a minute") if seconds > 15 else tr("A moment longer")


def next_task_words(exercise_id: str, audience: Audience) -> str:
    """Say what follows a rest."""
    task = _task_words(exercise_id, 1, audience == "child")
    return tr("then: {task}").format(task=to_mid_sentence(task)) if task else ""


def task_words(exercise_id: str) -> str:
    """Return what an exercise asks of an adult, such as ``Bend your hand down``."""
    return _task_words(exercise_id, 1, child=False)


def _task_words(exercise_id: str, aim: int, child: bool) -> str:
    known = find_exercise(exercise_id)
    if known is None:
        return ""
    return translate_phrase((known.child_cues if child else known.adult_cues)[0 if aim > 0 else 1])
