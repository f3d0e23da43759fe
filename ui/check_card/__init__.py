"""The camera checked with a printed card: the history as control charts, half a minute of looking, the result."""
