"""Version of this program, stated here only."""

__version__ = "0.2.0"
