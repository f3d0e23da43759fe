"""The window around the screens: top bar, navigation, messages, what is open."""
