"""What was promised of the accuracy, and whether the table keeps it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.model.types import FloatArray
from tests.accuracy.runs import CARPUS, SIMPLEST, Run
from tests.accuracy.scenarios import FAST, SLOW, TROUBLE, Scenario
from tests.accuracy.scores import Score, score

MOST_RMSE_DEG: dict[str, tuple[float, float, float]] = {SLOW: (0.3, 1.0, 1.2), FAST: (0.4, 1.0, 1.3)}
INSIDE = (0.90, 0.98)
LEAST_INSIDE_OF_ANY = 0.70
MOST_SD_OVER_RMSE = 1.5
MOST_WRONG = 0.002
ENOUGH_RECORDINGS = 30
HARDER = ("10 false blobs", "30 % hidden")
MOST_HARDER = 2.0
MOST_WRONG_OF_ANY = 0.001
MOST_SWAP_S = MOST_BACK_S = 0.5


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
        lost = [f"{run.scenario} {run.seed}" for run in carpus if run.ends_lost]
        out.append(Verdict("no recording ends lost", ", ".join(lost) or "none", not lost))
        out.append(_better_than_simplest(runs, scenarios))
        out += [*_troubles(carpus, scenarios), *_names(carpus), _smoother(carpus, scenarios)]
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


def _of(runs: Sequence[Run], scenario: Scenario, *, smoothed: bool = False) -> Score | None:
    return score([run for run in runs if run.scenario == scenario.name], scenario.columns, smoothed=smoothed)


def _text(values: FloatArray) -> str:
    return " / ".join(f"{value:.2f}" for value in values)


def _troubles(carpus: Sequence[Run], scenarios: Sequence[Scenario]) -> list[Verdict]:
    """Every trouble keeps the limits of the exercises, the two hardest twice those."""
    limits = np.array(MOST_RMSE_DEG[SLOW])
    beyond: dict[bool, list[str]] = {False: [], True: []}
    count = {False: 0, True: 0}
    for scenario in scenarios:
        found = _of(carpus, scenario)
        if scenario not in TROUBLE or found is None:
            continue
        hard = scenario.name in HARDER
        count[hard] += 1
        if (found.rmse > limits * (MOST_HARDER if hard else 1.0)).any():
            beyond[hard].append(f"{scenario.name} {_text(found.rmse)}")
    claim = {
        False: f"every trouble: RMSE at most {_text(limits)} degrees",
        True: f"{' and '.join(HARDER)}: at most {MOST_HARDER:g} times those",
    }
    return [
        Verdict(claim[hard], f"{count[hard] - len(beyond[hard])} of {count[hard]} rows" + "".join(
            f"; {row}" for row in beyond[hard]), not beyond[hard])
        for hard in (False, True) if count[hard]
    ]  # fmt: skip


def _names(carpus: Sequence[Run]) -> list[Verdict]:
    rows = sorted({run.scenario for run in carpus})
    share = {
        row: sum(run.wrong for run in carpus if run.scenario == row)
        / max(1, sum(run.taken for run in carpus if run.scenario == row))
        for row in rows
    }
    worst = max(rows, key=lambda row: share[row])
    swap = max(carpus, key=lambda run: run.longest_wrong_s)
    back = max(carpus, key=lambda run: run.longest_untracked_s)
    return [
        Verdict(
            f"wrong associations below {100 * MOST_WRONG_OF_ANY:g} % in every row",
            f"worst {100 * share[worst]:.3f} % ({worst})",
            share[worst] < MOST_WRONG_OF_ANY,
        ),
        Verdict(
            f"a swap lasts at most {MOST_SWAP_S:g} s",
            f"longest {swap.longest_wrong_s:.2f} s ({swap.scenario})",
            swap.longest_wrong_s <= MOST_SWAP_S,
        ),
        Verdict(
            f"tracked again within {MOST_BACK_S:g} s of four discs showing",
            f"longest {back.longest_untracked_s:.2f} s ({back.scenario})",
            back.longest_untracked_s <= MOST_BACK_S,
        ),
    ]


def _smoother(carpus: Sequence[Run], scenarios: Sequence[Scenario]) -> Verdict:
    above, rows = [], 0
    for scenario in scenarios:
        live, back = _of(carpus, scenario), _of(carpus, scenario, smoothed=True)
        if live is None or back is None:
            continue
        rows += 1
        if (back.rmse >= live.rmse).any():
            above.append(f"{scenario.name} {_text(back.rmse)} after {_text(live.rmse)}")
    found = f"{rows - len(above)} of {rows}" + "".join(f"; not {row}" for row in above)
    return Verdict("looking back below live in every row", found, not above)
