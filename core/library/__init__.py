"""The data folder: patients, sessions, what lies beside them, how each was set up."""
