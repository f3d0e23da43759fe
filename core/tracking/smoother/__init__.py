"""The smoother: every frame again in the light of those after it."""
