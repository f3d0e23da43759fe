"""Comparison of two sessions: synchronised playback and differences."""
