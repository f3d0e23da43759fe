"""Camera check with a printed card."""
