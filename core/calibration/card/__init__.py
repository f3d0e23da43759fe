"""Check card: six printed discs at known places that show a camera's error over months."""
