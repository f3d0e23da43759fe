"""The report screen: preview, choice of pages, saving and printing."""
