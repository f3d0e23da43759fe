"""What was promised of troubles, of looking back and of speeds, and whether the table keeps it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from carpus.core.model.types import FloatArray
from tests.accuracy.runs import CARPUS, INFORMED, Run
from tests.accuracy.scenarios import REACHING, SLOW, TROUBLE, Scenario
from tests.accuracy.scores import Score, score
from tests.accuracy.targets import MOST_RMSE_DEG, Verdict

HARDER = ("10 false blobs", "30 % hidden")
MOST_HARDER = 2.0
MOST_WRONG_OF_ANY = 0.001
MOST_SWAP_S = MOST_BACK_S = 0.5
MOST_OVER_BOUND = 1.15
MOST_SPEED_ERROR = {"angular": 0.05, "linear": 0.03}


def robustness_verdicts(runs: Sequence[Run], scenarios: Sequence[Scenario]) -> list[Verdict]:
    """One for every promise that was run."""
    carpus = [run for run in runs if run.method == CARPUS]
    if not carpus:
        return []
    return [
        *_troubles(carpus, scenarios),
        *_names(carpus),
        _smoother(carpus, scenarios),
        *_ratios(runs, scenarios),
        *_speeds(carpus, scenarios),
    ]


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


def _ratios(runs: Sequence[Run], scenarios: Sequence[Scenario]) -> list[Verdict]:
    """Against the same filter that was told true names, geometry and noise."""
    out = []
    slow = [scenario for scenario in scenarios if scenario.pool == SLOW]
    for name, rows in (("rest", [s for s in scenarios if s.name == "rest"]), (SLOW, slow)):
        names = {row.name for row in rows}
        mine, bound = (
            score([run for run in runs if run.scenario in names and run.method == method], rows[0].columns)
            if rows
            else None
            for method in (CARPUS, INFORMED)
        )
        if mine is not None and bound is not None:
            ratio = mine.rmse / bound.rmse
            claim = f"{name}: RMSE at most {MOST_OVER_BOUND:g} times the bound's"
            out.append(Verdict(claim, _text(ratio), bool((ratio <= MOST_OVER_BOUND).all())))
    return out


def _speeds(carpus: Sequence[Run], scenarios: Sequence[Scenario]) -> list[Verdict]:
    """Peak speeds of the exercises' strokes (turning) and of reaching (linear), looking back, usual troubles only."""
    usual = {scenario.name for scenario in scenarios if scenario.pool is not None}
    out = []
    speeds = [(run.scenario, run.speeds) for run in carpus if run.scenario in usual and run.speeds is not None]
    for kind, errors in (
        ("angular", [found.turning for name, found in speeds if name != REACHING]),
        ("linear", [found.moving for name, found in speeds if name == REACHING]),
    ):
        error = np.concatenate(errors) if errors else np.empty(0)
        if error.size:
            rms = float(np.sqrt(np.mean(error**2)))
            most = MOST_SPEED_ERROR[kind]
            found = (
                f"{100 * rms:.1f} % (mean {100 * error.mean():+.1f}, sd {100 * error.std():.1f}; {error.size} strokes)"
            )
            out.append(Verdict(f"peak {kind} speed of a stroke within {100 * most:g} %, rms", found, rms <= most))
    return out
