"""Starts Carpus: commands, settings and the one place where parts are put together."""
