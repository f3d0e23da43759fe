"""A recording played: its time, the buttons, the line of time, its stored pictures."""
