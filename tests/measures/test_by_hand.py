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

from carpus.core.errors import ChangedMeanwhile
from carpus.core.measures.by_hand import (
    MEASURES,
    HandValue,
    before,
    change_of,
    counted,
    course_of,
    is_unusual,
    measure_named,
    on_day,
    replaced,
)
from carpus.core.records.patients import by_hand, enter_by_hand
from carpus.core.records.schema import MEASURED
from tests.records.samples import HERON, LINDEN, opened

DAY = date(2026, 11, 20)


def flexion(value: float, day: date = DAY, way: str = "active") -> HandValue:
    return HandValue("FLEXION", way, "right", day, (value,), by="MK")  # type: ignore[arg-type]


def test_every_measure_can_hold_what_is_usual_and_nothing_that_cannot_be() -> None:
    assert len({one.id for one in MEASURES}) == len(MEASURES)
    for of in MEASURES:
        assert of.least <= of.usual[0] < of.usual[1] <= of.most, of.id
        for way in of.ways:
            side = "left" if of.of_hand else ""
            for end in of.usual:
                value = HandValue(of.id, way, side, DAY, (end,) * of.tries)
                assert value.value == pytest.approx(end)
                assert not is_unusual(of, end)
            for beyond in (of.least - 0.1, of.most + 0.1, math.nan, math.inf):
                with pytest.raises(ValueError, match=of.id):
                    HandValue(of.id, way, side, DAY, (beyond,))
            with pytest.raises(ValueError, match="tries"):
                HandValue(of.id, way, side, DAY, (of.usual[1],) * (of.tries + 1))
        with pytest.raises(ValueError, match="side"):
            HandValue(of.id, of.ways[0], "" if of.of_hand else "left", DAY, ())


def test_the_last_entry_of_a_day_counts_and_what_it_replaced_stays_readable() -> None:
    entries = [flexion(40.0), flexion(45.0), flexion(60.0, way="passive"), flexion(30.0, DAY - timedelta(days=7))]
    assert [one.value for one in counted(entries)] == [30.0, 45.0, 60.0]
    assert replaced(entries, flexion(0.0).key, DAY) == [flexion(40.0)]
    assert on_day(entries, flexion(0.0).key, DAY) == flexion(45.0)
    assert before(entries, flexion(0.0).key, DAY) == flexion(30.0, DAY - timedelta(days=7))
    taken_back = [*entries, replace(flexion(0.0), tries=())]
    assert on_day(taken_back, flexion(0.0).key, DAY) is None
    assert [one.value for one in course_of(taken_back, flexion(0.0).key)] == [30.0]


@given(first=st.floats(0, 90), last=st.floats(0, 90))
def test_a_change_is_judged_by_its_own_way_and_direction(first: float, last: float) -> None:
    def verdict(name: str, share: float = 1.0) -> str:
        of = measure_named(name)
        values = [share * first, share * last]
        side = "right" if of.of_hand else ""
        course = [HandValue(name, of.ways[0], side, DAY + timedelta(days=k), (v,)) for k, v in enumerate(values)]
        change = change_of(course)
        return change.verdict

    gain = last - first
    assert verdict("FLEXION") == ("within_error" if abs(gain) <= 10.0 else "improved" if gain > 0 else "worse")
    assert verdict("PRWE") == ("within_error" if abs(gain) <= 14.0 else "worse" if gain > 0 else "improved")
    assert verdict("KEY_PINCH") == "not_judged", "no figure is known of what a change must exceed"
    assert change_of([flexion(first)]) is None


def test_the_store_keeps_every_entry_in_order_and_says_what_it_knows(tmp_path: Path) -> None:
    with opened(tmp_path) as house:
        linden, heron = house.patients.add(LINDEN), house.patients.add(HERON)
        size = HandValue("WRIST_ROUND", "", "left", DAY, (17.6,), "over both styloids", "MK")
        enter_by_hand(house.store, linden, [flexion(40.0), size])
        enter_by_hand(house.store, linden, [flexion(45.0)])
        enter_by_hand(house.store, heron, [HandValue("GRIP", "", "right", DAY, (18.0, 19.5, 17.0))])
        with pytest.raises(ChangedMeanwhile):
            enter_by_hand(house.store, "nobody", [flexion(1.0)])
    with opened(tmp_path) as house:
        found = by_hand(house.store, linden)
        assert [replace(one, entered=None) for one in found] == [flexion(40.0), size, flexion(45.0)]
        assert all(one.entered is not None and one.entered.tzinfo is not None for one in found)
        house.store.own(update(MEASURED).where(MEASURED.c.measure == "WRIST_ROUND").values(measure="NOSE"))
        assert len(by_hand(house.store, linden)) == 2, "a measure of a newer Carpus"
        assert by_hand(house.store, heron)[0].value == pytest.approx(18.1667, abs=1e-3)
