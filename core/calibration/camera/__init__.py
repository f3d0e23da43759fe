"""How a camera sees and how far off its depth is, measured on a printed board."""
