"""``make bench``: what a frame, a row and the screen cost. ``python -m tests.bench --help`` lists the options."""

from __future__ import annotations

import argparse
import os
import platform
import sys

PARTS = ("start", "tracking", "whole-hand", "writing", "batch", "zoom", "window")


def main() -> int:
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")  # before any part loads NumPy
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from carpus.core.kernels import choice

    parser = argparse.ArgumentParser(prog="python -m tests.bench", description=__doc__)
    parser.add_argument("parts", nargs="*", choices=[*PARTS, []], help=f"{', '.join(PARTS)}; all when none is named")
    parser.add_argument("--seconds", type=float, default=120.0, help="length of the window's run")
    parser.add_argument("--raw", action="store_true", help="the window's run stores the raw pictures too")
    parser.add_argument("--hand", action="store_true", help="the window's run measures the whole hand, 21 markers")
    parser.add_argument("--rounds", type=int, default=3, help="how often the recordings are tracked")
    parser.add_argument(
        "--compare",
        action="store_true",
        help="whole-hand beside Stone Soup, filterpy, MediaPipe (installed apart)",
    )
    arguments = parser.parse_args()
    parts = arguments.parts or list(PARTS)
    if unknown := set(parts) - set(PARTS):
        parser.error(f"no such part: {', '.join(sorted(unknown))}")
    print(f"{platform.platform()}, Python {platform.python_version()}, {os.cpu_count()} processors")
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    kernels = choice.in_c()
    print(f"Kernels: {'NumPy alone' if kernels is None else f'in C, {kernels.level}'}")
    print(f"CPU time; ratios to the yardstick of the same run. Load at the start: {load:.1f}\n")
    if "start" in parts:
        from tests.bench import starting

        for text in starting.report():
            print(text, flush=True)
        print()
    if "tracking" in parts:
        from tests.bench import tracking

        for text in tracking.report(arguments.rounds):
            print(text, flush=True)
        print()
    if "whole-hand" in parts:
        from tests.bench import whole_hand

        for text in whole_hand.report(arguments.rounds, compare=arguments.compare):
            print(text, flush=True)
        print()
    if "writing" in parts:
        from tests.bench import writing

        for text in writing.report():
            print(text, flush=True)
        print()
    if "batch" in parts:
        from tests.bench import batch

        for text in batch.report():
            print(text, flush=True)
        print()
    if "zoom" in parts:
        from tests.bench import zooming

        for text in zooming.report():
            print(text, flush=True)
        print()
    if "window" in parts:
        from tests.bench import window

        for text in window.report(arguments.seconds, pictures=arguments.raw, whole_hand=arguments.hand):
            print(text, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
