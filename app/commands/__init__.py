"""The commands of ``carpus``; each module has NAME, HELP, ``add_arguments(parser)`` and ``run(arguments)``."""

from __future__ import annotations

from app.commands import demo, doctor, info, record, recover, report, simulate, track

COMMANDS = (demo, track, record, simulate, info, report, recover, doctor)
