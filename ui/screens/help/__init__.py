"""Help: the guide, the shortcuts, cards to print."""
