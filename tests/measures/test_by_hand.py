"""What counts of what was entered by hand, when it is a change, and that none of it is lost or left behind."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sqlalchemy import update

from carpus.core.measures.manual_measurements import (
    MEASURES,
    QUESTIONNAIRES,
    ManualValue,
    compute_change,
    current_values,
    find_manual_measure,
    find_superseded_entries,
    is_unusual,
    previous_value,
    value_history,
    value_on_day,
)
from carpus.core.model.errors import ConcurrentChange
from carpus.core.records.patients import add_manual_measurements, read_manual_measurements
from carpus.core.records.schema import MANUAL_MEASUREMENT
from tests.records.samples import HERON, LINDEN, open_store

DAY = date(2026, 11, 20)


def flexion(value: float, day: date = DAY, way: str = "active") -> ManualValue:
    return ManualValue("FLEXION", way, "right", day, (value,), rater="MK")  # type: ignore[arg-type]


def test_manual_measure_limits_hold_the_usual_range() -> None:
    assert len({one.id for one in MEASURES}) == len(MEASURES)
    for of in MEASURES:
        assert of.min_value <= of.usual_range[0] < of.usual_range[1] <= of.max_value, of.id
        for way in of.modes:
            side = "left" if of.is_per_hand else ""
            for end in of.usual_range:
                value = ManualValue(of.id, way, side, DAY, (end,) * of.trial_count)
                assert value.value == pytest.approx(end)
                assert not is_unusual(of, end)
            for beyond in (of.min_value - 0.1, of.max_value + 0.1, math.nan, math.inf):
                with pytest.raises(ValueError, match=of.id):
                    ManualValue(of.id, way, side, DAY, (beyond,))
            with pytest.raises(ValueError, match="tries"):
                ManualValue(of.id, way, side, DAY, (of.usual_range[1],) * (of.trial_count + 1))
        with pytest.raises(ValueError, match="side"):
            ManualValue(of.id, of.modes[0], "" if of.is_per_hand else "left", DAY, ())


def test_current_values_of_a_day_are_the_latest_and_earlier_ones_stay() -> None:
    entries = [flexion(40.0), flexion(45.0), flexion(60.0, way="passive"), flexion(30.0, DAY - timedelta(days=7))]
    assert [one.value for one in current_values(entries)] == [30.0, 45.0, 60.0]
    assert find_superseded_entries(entries, flexion(0.0).key, DAY) == [flexion(40.0)]
    assert value_on_day(entries, flexion(0.0).key, DAY) == flexion(45.0)
    assert previous_value(entries, flexion(0.0).key, DAY) == flexion(30.0, DAY - timedelta(days=7))
    taken_back = [*entries, replace(flexion(0.0), trials=())]
    assert value_on_day(taken_back, flexion(0.0).key, DAY) is None
    assert [one.value for one in value_history(taken_back, flexion(0.0).key)] == [30.0]


@given(flexion_deg=st.lists(st.floats(0, 110), min_size=3, max_size=3), extension=st.floats(-60, 30))
def test_current_values_hold_the_total_of_a_finger_measured_whole(flexion_deg: list[float], extension: float) -> None:
    ends = {f"{joint}4_FLEXION": angle for joint, angle in zip(("MCP", "PIP", "DIP"), flexion_deg, strict=True)}
    ends |= {"MCP4_EXTENSION": 0.0, "PIP4_EXTENSION": extension, "DIP4_EXTENSION": 0.0}
    entries = [ManualValue(name, "active", "left", DAY, (angle,)) for name, angle in ends.items()]
    (total,) = (one for one in current_values(entries) if one.measure == "TAM4")
    assert total.key == ("TAM4", "active", "left")
    assert total.value == pytest.approx(sum(flexion_deg) - max(-extension, 0.0)), "hyperextension counts as 0"
    assert current_values(current_values(entries)) == current_values(entries), "counted once"
    taken_back = [*entries, replace(entries[4], trials=())]
    assert all(not one.measure.startswith("TAM") for one in current_values(taken_back)), "one end is not known"


def test_questionnaire_scores_run_from_0_to_100_and_lack_answers_as_published() -> None:
    for name, item in QUESTIONNAIRES.items():
        for answer, score in ((item.min_answer, 0.0), (item.max_answer, 100.0)):
            assert item.compute_score([float(answer)] * item.item_count) == score, name
        given = [float(item.max_answer)] * item.min_answered
        lacking = [math.nan] * (item.item_count - item.min_answered)
        assert item.compute_score([*given, *lacking]) == 100.0, "as many as may lack"
        assert math.isnan(item.compute_score([*given[1:], math.nan, *lacking])), "one too few"
        assert math.isnan(item.compute_score(given[1:])), "not all items were gone through"
        blank = " " if item.max_answer > 9 else ""
        assert item.parse_answers(blank.join(["-", str(item.max_answer)]))[1] == item.max_answer
        assert item.parse_answers(f"{item.max_answer + 1}") is None
    for name, most_lacking in (("QUICK_DASH", 1), ("DASH", 3), ("PRWE", 0)):
        item = QUESTIONNAIRES[name]
        scores = [item.compute_score([1.0] * (item.item_count - k) + [math.nan] * k) for k in range(5)]
        assert [math.isnan(one) for one in scores].index(True) == most_lacking + 1, name
    pain_counts_double = QUESTIONNAIRES["PRWE"].compute_score([10.0] * 5 + [0.0] * 10)
    assert pain_counts_double == QUESTIONNAIRES["PRWE"].compute_score([0.0] * 5 + [10.0] * 10) == 50.0


@given(first=st.floats(0, 90), last=st.floats(0, 90))
def test_change_verdict_follows_limit_and_direction_of_the_measure(first: float, last: float) -> None:
    def verdict(name: str, share: float = 1.0) -> str:
        of = find_manual_measure(name)
        values = [share * first, share * last]
        side = "right" if of.is_per_hand else ""
        course = [ManualValue(name, of.modes[0], side, DAY + timedelta(days=k), (v,)) for k, v in enumerate(values)]
        change = compute_change(course)
        return change.verdict

    gain = last - first
    assert verdict("FLEXION") == ("within_error" if abs(gain) <= 10.0 else "improved" if gain > 0 else "worse")
    assert verdict("PRWE") == ("within_error" if abs(gain) <= 14.0 else "worse" if gain > 0 else "improved")
    assert verdict("KEY_PINCH") == "not_judged", "no figure is known of what a change must exceed"
    assert compute_change([flexion(first)]) is None


def test_store_returns_manual_values_in_order_of_entry(tmp_path: Path) -> None:
    with open_store(tmp_path) as house:
        linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
        size = ManualValue("WRIST_ROUND", "", "left", DAY, (17.6,), "over both styloids", "MK")
        add_manual_measurements(house.store, linden, [flexion(40.0), size])
        add_manual_measurements(house.store, linden, [flexion(45.0)])
        add_manual_measurements(house.store, heron, [ManualValue("GRIP", "", "right", DAY, (18.0, 19.5, 17.0))])
        with pytest.raises(ConcurrentChange):
            add_manual_measurements(house.store, "nobody", [flexion(1.0)])
    with open_store(tmp_path) as house:
        found = read_manual_measurements(house.store, linden)
        assert [replace(one, entered_at=None) for one in found] == [flexion(40.0), size, flexion(45.0)]
        assert all(one.entered_at is not None and one.entered_at.tzinfo is not None for one in found)
        house.store.execute_local(
            update(MANUAL_MEASUREMENT).where(MANUAL_MEASUREMENT.c.measure == "WRIST_ROUND").values(measure="NOSE")
        )
        assert len(read_manual_measurements(house.store, linden)) == 2, "a measure of a newer Carpus"
        assert read_manual_measurements(house.store, heron)[0].value == pytest.approx(18.1667, abs=1e-3)
