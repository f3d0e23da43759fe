"""``make bench``: what a frame, a row and the screen cost. ``python -m tests.bench --help`` lists the options."""

from __future__ import annotations

import argparse
import os
import platform
import sys
from importlib import import_module

PARTS = {"start": "starting", "tracking": "tracking", "batch": "batch", "window": "window"}
"""What is measured, and the module that does it."""


def main() -> int:
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")  # before any part loads NumPy
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

    parser = argparse.ArgumentParser(prog="python -m tests.bench", description=__doc__)
    parser.add_argument("parts", nargs="*", choices=[*PARTS, []], help=f"{', '.join(PARTS)}; all when none is named")
    parser.add_argument("--seconds", type=float, default=120.0, help="length of the window's run")
    parser.add_argument("--hand", action="store_true", help="the window's run measures the whole hand, 21 markers")
    parser.add_argument("--rounds", type=int, default=3, help="how often the recordings are tracked")
    arguments = parser.parse_args()
    parts = arguments.parts or list(PARTS)
    if unknown := set(parts) - set(PARTS):
        parser.error(f"no such part: {', '.join(sorted(unknown))}")
    print(f"{platform.platform()}, Python {platform.python_version()}, {os.cpu_count()} processors")
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    print(f"CPU time; ratios to the yardstick of the same run. Load at the start: {load:.1f}\n")
    options: dict[str, dict[str, object]] = {
        "tracking": {"rounds": arguments.rounds},
        "window": {"seconds": arguments.seconds, "whole_hand": arguments.hand},
    }
    for part in (one for one in PARTS if one in parts):
        for text in import_module(f"tests.bench.{PARTS[part]}").report(**options.get(part, {})):
            print(text, flush=True)
        print()
    return 0


if __name__ == "__main__":
    sys.exit(main())
