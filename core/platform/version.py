"""Version of this program, stated here only, and what it does, for the command line's help and the first start."""

from __future__ import annotations

from carpus.core.model.phrase import phrase

__version__ = "0.2.0"

PURPOSE = (
    (phrase("Measure"), phrase("wrist and finger angles while the patient moves")),
    (phrase("Review"), phrase("the curves and camera images, and correct single repetitions")),
    (phrase("Progress"), phrase("over weeks, compared with the measurement error (MDC95)")),
    (phrase("Report"), phrase("a session or the progress as a PDF in English, German or Italian")),
    (phrase("Export"), phrase("to CSV, JSON, C3D, TRC, MOT and BIDS")),
)
"""A verb and what it means; together one sentence."""
