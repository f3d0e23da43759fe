"""What the very first start says."""
