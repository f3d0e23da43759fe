"""The few controls every screen is built of, painted from the tokens."""
