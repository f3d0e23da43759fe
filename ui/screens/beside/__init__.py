"""Two sessions side by side: pictures in step, and their differences beyond error."""
