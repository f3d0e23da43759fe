"""Stored recordings, a file for each format."""
