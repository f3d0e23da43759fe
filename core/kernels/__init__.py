"""The tracker's costly steps in C, few and large; NumPy's functions beside them are their oracle and what else runs."""
