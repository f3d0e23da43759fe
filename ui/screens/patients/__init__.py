"""Screen 1: from the door to the start of a session in two key presses."""
