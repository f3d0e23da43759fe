"""The camera checked with a printed card: half a minute of looking, and the verdict."""
