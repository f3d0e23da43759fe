"""Sources of frames: cameras, stored recordings, the simulated patient."""
