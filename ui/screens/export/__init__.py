"""Asking for formats, and how far an export is."""
