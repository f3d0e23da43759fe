"""The camera calibrated with a printed board: choosing and printing it, showing it, the result."""
