"""Windows and views."""
