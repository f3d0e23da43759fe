"""Where frames come from: stored recordings, the camera, the simulated patient."""
