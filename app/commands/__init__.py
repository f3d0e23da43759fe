"""The commands of ``carpus``; each has a module of its name with ``add_arguments(parser)`` and ``run(arguments)``.

A module is loaded only when its command is asked for: tracking a file needs no window, and no help text a tracker.
"""

from __future__ import annotations

COMMANDS = {
    "demo": "The desktop application on a simulated camera and patient: no hardware.",
    "track": "Track a stored recording, no screen needed; or filter a session again.",
    "record": "Record raw colour and depth from the camera.",
    "simulate": "Make a synthetic recording with ground truth.",
    "info": "Say what a recording or session holds.",
    "report": "The report of a session, or the progress report of several, as a PDF.",
    "export": "A session in open formats.",
    "recover": "Finish the interrupted sessions of a folder.",
    "doctor": "Check driver, camera, window libraries, fonts, disk and data folder.",
}
