"""What a person measures by hand beside Carpus: goniometer, force, size, scores."""
