"""Commands, settings, the Python interface and the composition of the desktop application."""
