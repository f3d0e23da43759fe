"""How far Carpus is from the truth of simulated recordings: ``python -m tests.accuracy``."""
