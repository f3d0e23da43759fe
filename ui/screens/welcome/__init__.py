"""The panel of the first start."""
