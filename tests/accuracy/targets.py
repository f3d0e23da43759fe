"""What was promised of the accuracy, and whether the table keeps it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tests.accuracy.runs import CARPUS, SIMPLEST, Run
from tests.accuracy.scenarios import FAST, SLOW, Scenario
from tests.accuracy.scores import Score, score

MOST_RMSE_DEG: dict[str, tuple[float, float, float]] = {SLOW: (0.3, 1.0, 1.2), FAST: (0.4, 1.0, 1.3)}
INSIDE = (0.90, 0.98)
LEAST_INSIDE_OF_ANY = 0.70
MOST_SD_OVER_RMSE = 1.5
MOST_WRONG = 0.002
ENOUGH_RECORDINGS = 30


@dataclass(frozen=True, slots=True)
class Verdict:
    """``claim`` with its limit, ``found`` with its figure; None for ``is_met`` when too little was run to say."""

    claim: str
    found: str
    is_met: bool | None

    def __str__(self) -> str:
        word = {True: "met", False: "MISSED", None: "not judged"}[self.is_met]
        return f"{word:>10}  {self.claim}: {self.found}"


def verdicts(runs: Sequence[Run], scenarios: Sequence[Scenario]) -> list[Verdict]:
    """One for every promise that was run."""
    out: list[Verdict] = []
    for pool, limits in MOST_RMSE_DEG.items():
        rows = {scenario.name: scenario for scenario in scenarios if scenario.pool == pool}
        mine = [run for run in runs if run.method == CARPUS and run.scenario in rows]
        if not mine:
            continue
        columns = next(iter(rows.values())).columns
        figures = score(mine, columns)
        assert figures is not None
        out += _of_pool(pool, figures, columns, limits)
    carpus = [run for run in runs if run.method == CARPUS]
    if carpus:
        wrong, taken = sum(run.wrong for run in carpus), sum(run.taken for run in carpus)
        share = wrong / max(1, taken)
        out.append(
            Verdict(
                f"wrong associations below {100 * MOST_WRONG:g} % of measurements",
                f"{100 * share:.3f} % ({wrong} of {taken})",
                share < MOST_WRONG,
            )
        )
        lost = [f"{run.scenario} {run.seed}" for run in runs if run.method == CARPUS and run.ends_lost]
        out.append(Verdict("no recording ends lost", ", ".join(lost) or "none", not lost))
        out.append(_better_than_simplest(runs, scenarios))
    return out


def _of_pool(pool: str, figures: Score, columns: Sequence[str], limits: Sequence[float]) -> list[Verdict]:
    names = list(dict.fromkeys(columns))
    out = [
        Verdict(f"{pool}: RMSE of {name} at most {limit:g} degrees", f"{value:.2f}", bool(value <= limit))
        for name, limit, value in zip(names, limits, figures.rmse, strict=True)
    ]
    enough = figures.recordings >= ENOUGH_RECORDINGS
    low, high = INSIDE
    out += [
        Verdict(
            f"{pool}: truth of {name} within 2 sd in {100 * low:.0f} to {100 * high:.0f} % of frames",
            f"{100 * value:.1f} % over {figures.recordings} recordings",
            bool(low <= value <= high) if enough else None,
        )
        for name, value in zip(names, figures.inside, strict=True)
    ]
    alone = " / ".join(f"{100 * value:.0f}" for value in figures.worst_inside_of)
    out.append(
        Verdict(
            f"{pool}: in no recording below {100 * LEAST_INSIDE_OF_ANY:.0f} %",
            f"worst recording {100 * figures.worst_inside:.0f} % (angle by angle {alone})",
            bool(figures.worst_inside >= LEAST_INSIDE_OF_ANY) if enough else None,
        )
    )
    out += [
        Verdict(
            f"{pool}: mean sd of {name} at most {MOST_SD_OVER_RMSE:g} times the RMSE",
            f"{value:.2f}",
            bool(value <= MOST_SD_OVER_RMSE) if enough else None,
        )
        for name, value in zip(names, figures.sd_over_rmse, strict=True)
    ]
    return out


def _better_than_simplest(runs: Sequence[Run], scenarios: Sequence[Scenario]) -> Verdict:
    worse, rows = [], 0
    for scenario in scenarios:
        for mode in ("blobs", "pictures"):
            mine, plain = (
                score([r for r in runs if (r.scenario, r.mode, r.method) == (scenario.name, mode, m)], scenario.columns)
                for m in (CARPUS, SIMPLEST)
            )
            if mine is None or plain is None:
                continue
            rows += 1
            # A method that loses a disc for good has no figure at all: that is not better.
            if np.any(mine.rmse >= np.where(np.isnan(plain.rmse), np.inf, plain.rmse)):
                worse.append(f"{scenario.name} by {mode}")
    return Verdict("better than the simplest thing in every row", f"{rows - len(worse)} of {rows}" + (
        f"; not in {', '.join(worse)}" if worse else ""), not worse if rows else None)  # fmt: skip
