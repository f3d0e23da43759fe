"""Which blob is which marker: gates, joint association, finding a lost hand again."""
