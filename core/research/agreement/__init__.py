"""Agreement with another measurement of the same movement, and test-retest reliability."""
