"""A first session, led from control to control by one sentence at a time."""
