"""How far a session agrees with another measurement: choosing it, the sentence, plots, what was done to compare."""
