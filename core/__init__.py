"""Carpus without windows: from pictures to angles and files. Imports no Qt."""
