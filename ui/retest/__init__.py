"""The clinic's own test and retest: who was measured when, what is found so far, and putting it into force."""
