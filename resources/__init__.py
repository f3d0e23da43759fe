"""Files that ship with Carpus: defaults, fonts, icons, styles."""
