"""The commands of ``carpus``.

The module of a command has ``add_NAME_arguments(parser)`` and ``run_NAME(arguments)`` (- becomes _). It is imported
only when the command is requested: tracking a file needs no window, and a help text no tracker.
"""

from __future__ import annotations

COMMANDS = {
    "demo": "Open the window with a simulated camera and patient, without hardware.",
    "review": "Open one session file in the window.",
    "track": "Track saved recordings without the window, or re-analyse a session.",
    "record": "Record raw colour and depth from the camera.",
    "simulate": "Make a synthetic recording with ground truth.",
    "info": "Show the details of a recording or session.",
    "verify": "Check whether a session or recording is complete and unchanged.",
    "report": "Write the report of a session, or the progress report of several, as a PDF.",
    "progress": "Write a patient's results over all sessions, as a table or as a report.",
    "results": "Write the measures of all sessions of a study as one table.",
    "export": "Export sessions in open formats.",
    "log": "Show who opened, changed, exported or deleted what.",
    "erase": "Delete a session or a patient permanently, with everything that belongs to it.",
    "backup": "Back up the whole data folder to another disk, and verify the backup.",
    "restore": "Restore a backup into a new data folder, as on a new computer.",
    "compare": "Compare a session with a reference measurement.",
    "retest": "Compute the clinic's own measurement error from people who were measured twice.",
    "recover": "Complete the interrupted sessions of a folder.",
    "calibrate-camera": "Print the calibration board, and calibrate a camera with it.",
    "check-card": "Print the check card, and check a camera with it.",
    "doctor": "Check driver, camera, window libraries, fonts, disk and data folder.",
}
MODULES = {
    "demo": "desktop",
    "review": "desktop",
    "verify": "info",
    "results": "progress",
    "check-card": "calibrate_camera",
    **dict.fromkeys(("log", "erase", "backup", "restore", "recover"), "data_folder"),
}
"""Modules of commands that are not in one of their own name."""
