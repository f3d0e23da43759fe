"""The commands of ``carpus``.

Each has a module of its name (- becomes _) with ``add_arguments(parser)`` and ``run(arguments)``, imported only when
the command is requested: tracking a file needs no window, and a help text no tracker.
"""

from __future__ import annotations

COMMANDS = {
    "demo": "The desktop application on a simulated camera and patient: no hardware.",
    "review": "The desktop on one session file, as a double-click on it opens it.",
    "track": "Track a stored recording, no screen needed; or filter a session again.",
    "record": "Record raw colour and depth from the camera.",
    "simulate": "Make a synthetic recording with ground truth.",
    "info": "Say what a recording or session holds.",
    "verify": "Say whether a session or recording is whole and unchanged.",
    "report": "The report of a session, or the progress report of several, as a PDF.",
    "progress": "A patient's figures over all sessions, as a table or as a report.",
    "results": "The measures of all sessions of a study, as one table.",
    "export": "A session in open formats.",
    "log": "Who opened, changed, exported or erased what.",
    "erase": "Erase a session or a patient for good, with everything Carpus knows of.",
    "backup": "Everything of the data folder onto another disk, read back and compared.",
    "restore": "A back-up into a new data folder, as on a new computer.",
    "compare": "How far a session agrees with a reference measurement.",
    "retest": "The clinic's own error limits, from people who were measured twice.",
    "recover": "Finish the interrupted sessions of a folder.",
    "calibrate-camera": "Print a board, and measure from it how a camera sees and how far off its depth is.",
    "check-card": "Print the check card, and see from it how far off a camera measures.",
    "doctor": "Check driver, camera, window libraries, fonts, disk and data folder.",
}
