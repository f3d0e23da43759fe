# ruff: noqa: E501  (prose: one paragraph is one text to translate)
"""The text of the help, in the order in which a session goes."""

from __future__ import annotations

from ui.translate import tr


def chapters() -> list[tuple[str, tuple[str, ...]]]:
    """Title and paragraphs of each chapter."""
    return [
        (
            tr("A session in one minute"),
            (
                tr("Choose the patient and press Enter. With the same set-up as last time Carpus goes straight to the markers."),
                tr("Lay the hand flat and still, take the picture, and click the six discs in the order that the drawing shows. Of 21 discs the names are proposed."),
                tr("Press Enter to measure, Space to record, Space again to stop. The review opens by itself."),
                tr("Leave out what should not count, then make the report."),
            ),
        ),
        (
            tr("Markers"),
            (
                tr("Blue matt paper, 12 mm, on clean dry skin: wrist, thumb base, and behind each of the four knuckles."),
                tr("Put them where they were last time; the small picture shows it. Most of the difference between two sessions comes from moved markers."),
                tr("Never on wounds, dressings or fragile skin."),
            ),
        ),
        (
            tr("The whole hand: 21 markers"),
            (
                tr("Wrist and thumb base as before. Each finger: behind the knuckle, on the creases of the middle joint, on the creases of the end joint, in the middle of the nail. Thumb: knuckle, end joint, nail. For small fingers use 8 mm discs."),
                tr("Carpus proposes all 21 names. Each finger’s line must run from the wrist to its tip and cross no other; drag a name to another disc to change it, names that meet change places. Doubtful ones come into the loupe one by one."),
                tr("Zero of a finger joint is the straight finger, not the picture: bent or stiff fingers may lie as they are, nothing needs to be given for them. Zero of the wrist is the picture."),
                tr("A joint is measured while the marker over it and the next one outwards are seen. Hidden joints do not count; their curve is dashed."),
                tr("≥ before a figure means “at least”: the joint went out of sight before the end of its way. Such a figure has no ±, and is compared only where the gain is sure."),
                tr("A fist hides the middle and end joints at its end. Turn the thumb side up, or raise the wrist, to show more. The trained angle of the full fist is the knuckle, which stays in view longest."),
                tr("End joints are usually inferred: they follow the middle joints by two thirds. Where they do not (hook fist, injury of the deep flexor, mallet finger), choose “End joints: Measured” with the exercise."),
                tr("TAM, total active motion: the largest sum of a finger’s bending in one moment, less what is missing to straight at its most open; all joints of the finger must be seen at once. 260° is usual, 140° for the thumb."),
                tr("While measuring, F2 takes the next joint as the large number, F3 the next finger, and Shift+F8 shows the finger from the side. A click on a figure does the same."),
                tr("In the review the wheel zooms the curves about the mouse, Shift and the wheel go along, a double click shows the repetitions alone."),
            ),
        ),
        (
            tr("Camera and arm"),
            (
                tr("The camera hangs 70 to 80 cm above the table, at least 60 cm, and looks straight down. Tie it with a safety cord."),
                tr("The forearm rests and does not move: Carpus measures the hand in the room, and that is the wrist only while the forearm is still. A warning comes when the wrist leaves a ball of 15 mm."),
                tr("No sunlight on the hand, no blue sleeve."),
            ),
        ),
        (
            tr("What the numbers mean"),
            (
                tr("Zero of the wrist is the neutral hand of the picture, palm down. If the wrist cannot lie straight, give its angle with “Wrist cannot lie straight”. Zero of a finger joint is the straight finger."),
                tr("± beside the live angle is how sure that one angle is. ± in the tables is the spread between repetitions."),
                tr("Dashed and hatched means predicted: no marker was seen, it does not count. A dash means not known."),
                tr("A change is called one only when it is larger than the measurement error; else the report says that it is not."),
            ),
        ),
        (
            tr("When to stop"),
            (
                tr("Stop at pain of 5 or more, at 2 more than before, at numbness, swelling or dizziness."),
                tr("Not with a fresh fracture, tendon or nerve repair, an external fixation, infection, an open wound or acute CRPS, unless the surgeon or therapist has said so. Active movement only."),
            ),
        ),
        (
            tr("When something goes wrong"),
            (
                tr("Every message says what happened, whether the data are safe, and what to do."),
                tr("A recording that was cut short is finished at the next start; at most the last second is missing."),
                tr("If the camera does not answer, “carpus doctor” in a terminal checks driver, rights and cable."),
            ),
        ),
        (
            tr("Data"),
            (
                tr("Everything stays on this computer. Session files carry the made-up name only; a real name is kept in the list of patients and nowhere else."),
                tr("Recordings are never changed. Corrections are stored beside them."),
            ),
        ),
    ]  # fmt: skip
