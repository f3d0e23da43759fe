"""How far a session agrees with another measurement of the same movement, and a measurement with itself."""
