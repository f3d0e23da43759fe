"""The course over the sessions: one sentence, the range with its error, whether the comparison is fair."""
