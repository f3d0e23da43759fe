"""For the head of a clinic: how many sessions, by whom, and who is due for a re-test."""
