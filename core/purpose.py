"""The five things that Carpus does, in the words of the command line's help, of the first start and of the README."""

from __future__ import annotations

from carpus.core.phrase import phrase

PURPOSE = (
    (phrase("Measure"), phrase("how wrist and fingers move, live, every angle with how sure it is")),
    (phrase("Review"), phrase("picture and curves of a session, each repetition put right where need be")),
    (phrase("Progress"), phrase("from session to session, beyond measurement error or not")),
    (phrase("Report"), phrase("a session or the progress as a PDF in English, German or Italian")),
    (phrase("Export"), phrase("to open formats (CSV, JSON, C3D, TRC, MOT, BIDS)")),
)
"""A word for each, and what it means; together one sentence."""
