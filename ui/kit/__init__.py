"""Parts that every screen is made of: controls, theme, fonts, icons, numbers, translation."""
