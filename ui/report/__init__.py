"""The printed page, its preview, and the tables and sentences it shares with the screens."""
