"""Tracking of many recordings: worker processes, retries, results."""
