"""Help on one screen: the way through a session, the keys, what to do when something goes wrong."""
