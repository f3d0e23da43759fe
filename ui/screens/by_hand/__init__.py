"""The form for values measured by hand, their names and their chart."""
