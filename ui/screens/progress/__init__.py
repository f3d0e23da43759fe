"""Progress over the sessions: answer, chart, changes and comparability."""
