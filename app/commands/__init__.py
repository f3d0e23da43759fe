"""The commands of ``carpus``; each module has NAME, HELP, ``add_arguments(parser)`` and ``run(arguments)``."""

from __future__ import annotations

from app.commands import doctor, info, record, recover, simulate, track

COMMANDS = (track, record, simulate, info, recover, doctor)
