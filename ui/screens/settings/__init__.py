"""What a person may choose: looks, text size, data folder, initials."""
