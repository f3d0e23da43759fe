"""What a frame's row says of what was measured, and for how long it doubts."""

from __future__ import annotations
