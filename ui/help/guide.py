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
                tr("Lay the hand flat and still, take the picture, and click the six discs in the order that the drawing shows."),
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
                tr("Zero is the neutral hand of the picture, palm down. If the hand cannot lie straight, give its angle with “Hand cannot lie straight”."),
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
