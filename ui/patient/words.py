"""What the patient reads: plain words for an adult, one or two for a child."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from carpus.ui.patient.guide import Scene
from carpus.ui.translate import inside, tr

Audience = Literal["adult", "child"]
FURTHER_FROM = 0.5
"""From this part of the way on: a little further."""


@dataclass(frozen=True, slots=True)
class Said:
    """``task`` above, what to do; ``now`` below and largest, how it stands."""

    task: str
    now: str


def said(exercise_id: str, scene: Scene, audience: Audience) -> Said:
    """The words of a scene."""
    child = audience == "child"
    if scene.phase == "away":
        return Said("", tr("One moment."))
    if scene.phase == "lost":
        return Said(tr("Show the dots") if child else tr("Show the blue dots to the camera"), tr("One moment."))
    if scene.phase == "paused":
        return Said("" if child else tr("Let your hand rest."), tr("A short break."))
    if scene.phase == "done":
        return Said("" if child else tr("Let your hand rest."), tr("Well done."))
    if scene.phase == "rest":
        return Said("" if child else tr("Let your hand rest."), tr("Well done."))
    if scene.starts_s:
        return Said(tr("Lie still") if child else tr("Let your hand lie still"), f"{scene.starts_s} …")
    if scene.phase == "free":
        return Said(_task(exercise_id, 1, child), tr("Just try it.") if scene.tries else "")
    back = _back(exercise_id, child)
    if scene.phase in ("back", "hidden"):
        return Said(_task(exercise_id, scene.aim, child) if child else back, tr("Back") if child else tr("And back"))
    task = _task(exercise_id, scene.aim, child)
    if scene.phase == "there":
        return Said(task, tr("There!") if child else tr("There. Hold it."))
    if scene.tries:
        return Said(task, tr("Just try it."))
    if scene.goal_deg != scene.goal_deg:
        return Said(task, "" if child else tr("As far as is comfortable"))
    return Said(task, (tr("Further") if child else tr("A little further")) if scene.share >= FURTHER_FROM else "")


def rest_words(seconds: int) -> str:
    """How long a rest still is, as one says it."""
    if seconds > 75:
        return tr("A few minutes")
    if seconds > 40:
        return tr("About a minute")
    return tr("About half a minute") if seconds > 15 else tr("A moment longer")


def then_words(exercise_id: str, scene: Scene, audience: Audience) -> str:
    """What comes after a rest."""
    task = _task(exercise_id, 1, audience == "child")
    return tr("then: {task}").format(task=inside(task)) if task else ""


def task_words(exercise_id: str) -> str:
    """What an exercise asks of an adult: ``Bend your hand down``."""
    return _task(exercise_id, 1, child=False)


def _task(exercise_id: str, aim: int, child: bool) -> str:
    adult_words, child_words = {
        "WRIST_FE": ((tr("Bend your hand down"), tr("Lift your hand up")), (tr("Down"), tr("Up"))),
        "WRIST_RU": (
            (tr("Slide your hand to the thumb side"), tr("Slide your hand to the little finger side")),
            (tr("To the thumb"), tr("To the little finger")),
        ),
        "FOREARM_PS": ((tr("Turn your palm up"), tr("Turn your palm down")), (tr("Turn up"), tr("Turn down"))),
        "FIST_COMPOSITE": ((tr("Close your hand to a fist"),) * 2, (tr("Close"),) * 2),
        "FIST_HOOK": ((tr("Bend your fingers to a hook"),) * 2, (tr("Hook"),) * 2),
        "FINGER_ABAD": ((tr("Spread your fingers wide"),) * 2, (tr("Wide"),) * 2),
        "THUMB_OPP": ((tr("Open your thumb wide"),) * 2, (tr("Thumb wide"),) * 2),
        "REACH_GRASP": (
            (tr("Take the cup, lift it a little, put it back"),) * 2,
            (tr("Take the cup"),) * 2,
        ),
        "FREE_HAND": ((tr("Move your fingers as you like"),) * 2, (tr("Move your fingers"),) * 2),
        "FREE": ((tr("Move your hand as you like"),) * 2, (tr("Move your hand"),) * 2),
    }.get(exercise_id, (("", ""), ("", "")))
    return (child_words if child else adult_words)[0 if aim > 0 else 1]


def _back(exercise_id: str, child: bool) -> str:
    if child:
        return tr("Back")
    return {
        "FOREARM_PS": tr("Turn your hand back"),
        "FIST_COMPOSITE": tr("Open your hand"),
        "FIST_HOOK": tr("Straighten your fingers"),
        "FINGER_ABAD": tr("Close your fingers"),
        "THUMB_OPP": tr("Touch the next fingertip"),
    }.get(exercise_id, tr("Come back to the middle"))
