"""Encryption at rest, all of it done by SQLCipher: files and lists that only who knows the PIN can read."""
