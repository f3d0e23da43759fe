"""A guided first session, one sentence at a time."""
