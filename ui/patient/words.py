"""What the patient reads: plain words for an adult, one or two for a child."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from carpus.core.hand.exercises import exercise_named, known_exercise
from carpus.ui.patient.guide import GuideScene
from carpus.ui.translate import inside, say, tr

Audience = Literal["adult", "child"]
FURTHER_FROM = 0.5
"""From this part of the way on: a little further."""


@dataclass(frozen=True, slots=True)
class Said:
    """``task`` above, what to do; ``now`` below and largest, how it stands."""

    task: str
    now: str


def said(exercise_id: str, scene: GuideScene, audience: Audience) -> Said:
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
        return Said(tr("Hold still") if child else tr("Let your hand lie still"), f"{scene.starts_s} …")
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


def then_words(exercise_id: str, audience: Audience) -> str:
    """What comes after a rest."""
    task = _task(exercise_id, 1, audience == "child")
    return tr("then: {task}").format(task=inside(task)) if task else ""


def task_words(exercise_id: str) -> str:
    """What an exercise asks of an adult: ``Bend your hand down``."""
    return _task(exercise_id, 1, child=False)


def _task(exercise_id: str, aim: int, child: bool) -> str:
    known = known_exercise(exercise_id)
    return "" if known is None else say((known.child if child else known.adult)[0 if aim > 0 else 1])


def _back(exercise_id: str, child: bool) -> str:
    return tr("Back") if child else say(exercise_named(exercise_id).back)
