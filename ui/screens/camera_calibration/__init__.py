"""Camera calibration with a printed board: set-up, capture, result."""
