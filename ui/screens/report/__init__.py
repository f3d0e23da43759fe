"""Report screen: preview, parts and comment, saving and printing."""
