"""The desktop application: implements the ports of the windows and connects the screens."""
