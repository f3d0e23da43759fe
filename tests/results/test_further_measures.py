"""What exercises have beside their ranges, of sessions of the simulated hand."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import date

import numpy as np
import pytest

from carpus.core.formats.measures_table import build_measure_rows
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.phrase import phrase
from carpus.core.records.values import Patient
from carpus.core.results.measure import Measure, summarise_values
from carpus.core.results.norms import (
    SHARE_OF_OTHER,
    Person,
    compute_total_shares,
    grade_share,
    wrist_norm,
)
from carpus.core.results.session_results import SessionResults, compute_session_results
from carpus.core.results.task_measures import (
    QUANTITIES,
    MeasureInput,
    Quantity,
    _thumb_distance_sd_m,
    find_session_reaches,
)
from carpus.ui.kit.table import cell_text
from carpus.ui.words.ranges import range_table
from carpus.ui.words.session import method_words
from carpus.ui.words.task_measures import measure_name, short_task_summary, task_summary, task_table
from carpus.ui.words.terms import to_person
from tests.ui.fakes import figures_once, session
from tests.ui.hand_fakes import hand_session


def named(figures: SessionResults, name: str, of: str) -> Measure:
    return next(item for item in figures.measures_in_group("task") if item.key == (of, name))


def without_words(figures: SessionResults) -> set[str]:
    """Measures that the report calls by the name they have in files."""
    return {item.quantity for item in figures.measures_in_group("task") if measure_name(item).startswith(item.quantity)}


def test_task_measures_reach_and_grasp_complete() -> None:
    made = hand_session(exercise="REACH_GRASP", motion="reach_grasp")
    figures = figures_once(made)
    assert without_words(figures) == set()
    reaches = named(figures, "movement time", "reach")
    assert len(reaches.values) >= 3
    assert all(0.2 < value < 3.0 for value in reaches.values)
    assert named(figures, "straightness", "reach").mean >= 1.0
    assert named(figures, "peak speed", "reach").mean > 200.0
    aperture = np.linalg.norm(np.diff(made.motion.joint_position_m[:, [4, 8]], axis=1)[:, 0], axis=1)
    assert named(figures, "largest aperture", "TIP1-TIP2").mean <= 1e3 * float(np.nanmax(aperture)) + 1e-6
    assert not any(row.subject.startswith("TAM") for row in figures.joint_ranges)
    assert "TAM" not in method_words(figures, 21, compared=False)


def test_opposition_counts_touches_and_thumb_path() -> None:
    made = hand_session(exercise="THUMB_OPP", motion="opposition")
    figures = figures_once(made)
    assert without_words(figures) == set()
    distances = [named(figures, "least distance", f"TIP1-TIP{k}").mean for k in (2, 3, 4, 5)]
    assert all(0.0 < value < 15.0 for value in distances)
    touches = [named(figures, "touches", f"TIP1-TIP{k}").mean for k in (2, 3, 4, 5)]
    assert touches == [2.0, 2.0, 2.0, 2.0]
    across = named(figures, "path length", "thumb across")
    assert len(across.values) == 8, "one for each touch, opened to the other side in between"
    assert all(60.0 < value < 200.0 for value in across.values)
    assert all(1.0 <= value < 1.6 for value in named(figures, "straightness", "thumb across").values)
    # The whole hand goes along the table meanwhile: the thumb's way in the hand stays the same.
    carried = made.motion.position_m + np.linspace(0.0, 0.3, len(made))[:, None] * [1.0, 0.0, 0.0]
    tips = made.motion.joint_position_m + (carried - made.motion.position_m)[:, None]
    moved = figures_once(replace(made, motion=replace(made.motion, position_m=carried, joint_position_m=tips)))
    assert np.allclose(named(moved, "path length", "thumb across").values, across.values, atol=1e-6)


@pytest.mark.parametrize(("least_mm", "touches"), [(14.0, 2.0), (16.0, 0.0)])
def test_opposition_touch_below_15_mm(least_mm: float, touches: float) -> None:
    made = hand_session(exercise="THUMB_OPP", motion="opposition")
    tips = made.motion.joint_position_m.copy()
    away = tips[:, 4] - tips[:, 8]
    distance = np.linalg.norm(away, axis=1, keepdims=True)
    tips[:, 4] += away / distance * (1e-3 * least_mm - np.nanmin(distance))
    figures = figures_once(replace(made, motion=replace(made.motion, joint_position_m=tips)))
    assert named(figures, "least distance", "TIP1-TIP2").mean == pytest.approx(least_mm, abs=0.1)
    assert named(figures, "touches", "TIP1-TIP2").mean == touches


def test_thumb_coherence_lost_when_pose_breaks() -> None:
    hidden = [(8.0, 9.5, name) for name in ("IP1", "TIP1")]
    made = hand_session(exercise="REACH_GRASP", motion="reach_grasp", hidden=hidden)
    figures = figures_once(made)
    assert named(figures, "thumb hidden", "thumb").mean == pytest.approx(1.5 / 40.0, rel=0.05)
    # Known to 15 degrees for the first second: its sd grows by 12 degrees times the root of the time.
    assert named(figures, "coherent though hidden", "thumb").mean == 1.0
    assert 0.6 < named(figures, "known though hidden", "thumb").mean < 0.8
    joints = made.motion.joint_angles_rad.copy()
    joints[:, made.header.joint_names.index("IP1_flexion")] = np.radians(-80.0)
    (jump,) = named(figures, "jump when seen again", "TIP1").values
    tips = made.motion.joint_position_m.copy()
    tips[np.isnan(made.markers.measured_px[:, 4, 0]), 4, 0] += 0.03
    lost = figures_once(replace(made, motion=replace(made.motion, joint_position_m=tips)))
    (far,) = named(lost, "jump when seen again", "TIP1").values
    assert (jump < 5.0, far > 25.0) == (True, True), "told when it is seen again"
    broken = figures_once(replace(made, motion=replace(made.motion, joint_angles_rad=joints)))
    assert named(broken, "coherent though hidden", "thumb").mean == 0.0


def test_fist_has_graded_totals_and_coordination() -> None:
    figures = figures_once(hand_session(exercise="FIST_COMPOSITE", motion="fist"))
    assert without_words(figures) == set()
    shares = figures.measures_in_group("share")
    assert {share.subject for share in shares} <= {f"TAM{finger}" for finger in (1, 2, 3, 4, 5)}
    for share in shares:
        row = figures.find(share.subject, "arc")
        assert share.mean == row.mean / (140.0 if share.subject == "TAM1" else 260.0)
        assert (grade_share(share) is None) == row.is_lower_bound
    other = figures_once(hand_session(exercise="FIST_COMPOSITE", motion="fist", share=0.6, hides_beyond_deg=999.0))
    beside = compute_total_shares(figures.joint_ranges, figures.exercise, other.joint_ranges)
    assert all(share.quantity == SHARE_OF_OTHER for share in beside)
    assert all(share.mean > 1.0 for share in beside if share.subject != "TAM1"), "of a hand that bends less"
    assert named(figures, "co-flexion", "PIP2_flexion, PIP3_flexion").mean > 0.5


def test_range_deficit_has_its_own_row() -> None:
    made = session()
    motion = made.motion
    # From 20 to 60 degrees of flexion and back, as long as the exercise takes.
    angles = motion.angles_rad.copy()
    flexion = angles[:, 1]
    low, high = np.nanpercentile(flexion, (2, 98))
    angles[:, 1] = np.radians(20.0) + (flexion - low) / (high - low) * np.radians(40.0)
    figures = figures_once(replace(made, motion=replace(motion, angles_rad=angles)))
    row = figures.find("flexion", "extension")
    assert -24.0 < row.mean < -12.0
    shown = {cell_text(line[0]): line[1] for line in range_table(figures, None, None).rows}
    assert "Extension deficit" in shown
    assert "-" not in shown["Extension deficit"]
    assert "\N{MINUS SIGN}" not in shown["Extension deficit"]


def test_speed_hidden_by_noise_is_too_slow() -> None:
    lost = summarise_values("task", "reach", "smoothness", "SPARC", (math.nan, math.nan), unknown_reason="too_slow")
    gone = summarise_values("task", "return", "smoothness", "SPARC", (math.nan,))
    figures = figures_once(hand_session(exercise="REACH_GRASP", motion="reach_grasp"))
    figures = replace(figures, measures=(lost, gone))
    (row,) = task_table(figures).rows
    assert row[:2] == ("Smoothness (SPARC), outward", "too slow to assess")
    assert not any(row[2:])
    row = next(row for row in build_measure_rows(figures, "s") if (row.measure, row.of) == ("smoothness", "reach"))
    assert row.count == 0
    assert math.isnan(row.mean)


def test_opposition_hidden_touches_are_unknown() -> None:
    plain = figures_once(hand_session(exercise="THUMB_OPP", motion="opposition"))
    hidden = [(0.5, 60.0, name) for name in ("IP1", "TIP1")]
    figures = figures_once(hand_session(exercise="THUMB_OPP", motion="opposition", hidden=hidden))
    for k in (2, 3, 4, 5):
        for name in ("touches", "least distance"):
            unseen = named(figures, name, f"TIP1-TIP{k}")
            assert unseen.unknown_reason == "hidden"
            assert math.isnan(unseen.mean)
            assert named(plain, name, f"TIP1-TIP{k}").unknown_reason == ""
    assert task_summary(figures) == "Thumb contact was occluded"
    assert short_task_summary(figures) == "Thumb contact occluded"
    assert not any(
        math.isfinite(item.mean)
        for item in figures.measures_in_group("task")
        if item.subject in ("thumb across", "thumb back")
    )
    rows = [row[place : place + 2] for row in task_table(figures).rows for place in (0, 3)]
    said = [today for name, today in rows if "across" in str(name)]
    assert said == ["occluded"], "one line for all that is not known of the ways"


@pytest.mark.parametrize(("sds", "touches"), [(2.2, 0.0), (1.8, math.nan)])
def test_opposition_hidden_tips_within_two_sds_are_unknown(sds: float, touches: float) -> None:
    made = hand_session(exercise="THUMB_OPP", motion="abduction", hidden=[(0.5, 60.0, "TIP1")])
    tips = made.motion.joint_position_m.copy()
    away = tips[:, 4] - tips[:, 8]
    tips[:, 4] = tips[:, 8] + 0.030 * away / np.linalg.norm(away, axis=1, keepdims=True)
    apart = replace(made.motion, joint_position_m=tips)
    scale = (0.030 - 0.015) / sds / _thumb_distance_sd_m(replace(made, motion=apart), 1)
    unsure = replace(apart, joint_angles_sd_rad=apart.joint_angles_sd_rad * scale[:, None])
    found = named(figures_once(replace(made, motion=unsure)), "touches", "TIP1-TIP2")
    assert found.mean == pytest.approx(touches, nan_ok=True)


def test_reach_hidden_half_way_has_no_time() -> None:
    made = hand_session(exercise="REACH_GRASP", motion="reach_grasp")
    plain = figures_once(made)
    times = find_session_reaches(made, np.ones(len(made), dtype=bool))
    middle = 0.5 * (times[0].start_s + times[0].end_s)
    gone = hand_session(exercise="REACH_GRASP", motion="reach_grasp", lost=[(middle, middle + 0.5)])
    figures = figures_once(gone)
    for name in ("movement time", "path length", "peak speed"):
        values = named(figures, name, "reach").values
        assert math.isnan(values[0]), "it ended where it was no longer seen, not where the hand stopped"
        assert values[1:] == pytest.approx(named(plain, name, "reach").values[1:], rel=1e-6)
    assert math.isnan(named(figures, "largest aperture", "TIP1-TIP2").values[0])


def test_aperture_hidden_tips_needs_small_sd() -> None:
    made = hand_session(exercise="REACH_GRASP", motion="reach_grasp", hidden=[(5.0, 60.0, "TIP1")])
    first, *_, last = named(figures_once(made), "largest aperture", "TIP1-TIP2").values
    assert first > 50.0
    assert math.isnan(last), "half a minute after the tip was last seen"
    sure = made.motion.joint_angles_sd_rad * 0.01
    known = figures_once(replace(made, motion=replace(made.motion, joint_angles_sd_rad=sure)))
    assert min(named(known, "largest aperture", "TIP1-TIP2").values) > 50.0


def test_span_uses_seen_tips_only() -> None:
    made = hand_session(exercise="FINGER_ABAD", motion="abduction")
    tips = made.motion.joint_position_m.copy()
    rows = slice(300, 330)
    tips[rows, 20] += [0.0, -0.1, 0.0]  # a hidden tip that is guessed 100 mm too far out
    pixels = made.markers.measured_px.copy()
    pixels[rows, 20] = np.nan
    guessed = replace(
        made, motion=replace(made.motion, joint_position_m=tips), markers=replace(made.markers, measured_px=pixels)
    )
    for of in ("TIP1-TIP5", "TIP4-TIP5"):
        name = "hand span" if of == "TIP1-TIP5" else "tip span"
        span = named(figures_once(made), name, of).mean
        assert named(figures_once(guessed), name, of).mean == pytest.approx(span, abs=2.0)


def test_wrist_norm_of_a_person_replaces_the_one_for_adults_where_a_source_has_it() -> None:
    exercise = get_exercise("WRIST_FE")
    adults = wrist_norm("flexion", 1, exercise)
    for person in (None, Person("female", 40), Person("male", 60), Person("male", 90), Person("", 12)):
        assert wrist_norm("flexion", 1, exercise, person) == adults, person
    for person in (Person("male", 18), Person("female", 65), Person("", 85)):
        own = [wrist_norm(movement, 1, exercise, person) for movement in ("flexion", "extension", "arc")]
        assert own[2].low_deg == own[0].low_deg + own[1].low_deg
        assert own[0] != adults
    assert wrist_norm("radial", 1, get_exercise("WRIST_RU"), Person("male", 30)) is None, "not the trained angle"


def test_age_of_a_person_rises_on_the_birthday() -> None:
    patient = Patient("Linden 42", "both", birth_day=date(1960, 3, 12), sex="female")
    ages = [to_person(patient, day).age for day in (date(2026, 3, 11), date(2026, 3, 12), date(2026, 12, 1))]
    assert ages == [65, 66, 66]
    assert to_person(replace(patient, birth_day=None), date(2026, 3, 12)) is None


def test_range_table_gives_the_share_of_the_other_hand() -> None:
    made = figures_once(session())
    half = replace(made, measures=tuple(replace(one, mean=one.mean / 2.0) for one in made.measures), side="left")
    hidden = replace(made, measures=tuple(replace(one, is_lower_bound=True) for one in made.measures))

    def shares(today: SessionResults, other: SessionResults) -> set[str]:
        return {cell_text(line[3]).partition("(")[2] for line in range_table(today, None, other).rows if line[3]}

    assert shares(half, made) == {"50\N{NO-BREAK SPACE}%)"}
    assert {one[:1] for one in shares(hidden, half)} == {"≥"}
    assert shares(half, hidden) == {""}, "of a range that was not seen whole"
    short = replace(half, measures=tuple(replace(one, mean=-one.mean) for one in half.measures))
    assert shares(short, made) == {""}, "degrees that lack to neutral are no share of a range"


def test_further_measure_is_one_row_of_the_table(monkeypatch: pytest.MonkeyPatch) -> None:
    def measure_arcs(data: MeasureInput) -> list[Measure]:
        assert data.trained is not None
        arcs = [math.degrees(one.row.arc_rad) for one in data.counted_repetitions]
        return [summarise_values("task", data.trained.name, "further", "N", arcs)]

    monkeypatch.setitem(
        QUANTITIES,
        "further",
        Quantity(phrase("Further measure"), "N", 1, measure_arcs, ("WRIST_FE",), positive="stronger"),
    )
    figures = compute_session_results(session())
    (row,) = [row for row in build_measure_rows(figures, "s") if row.measure == "further"]
    assert (row.of, row.unit, row.count, row.positive) == ("flexion", "N", figures.repetition_count, "stronger")
    assert row.mean == pytest.approx(next(one.mean for one in figures.wrist_ranges if one.quantity == "arc"), abs=1.0)
    cells = [cell_text(cell) for line in task_table(figures).rows for cell in line]
    at = cells.index("Further measure")
    assert cells[at + 1].startswith(f"{row.mean:.1f}")
    assert cells[at + 1].endswith("N")
    other = compute_session_results(session(exercise="WRIST_RU", motion="deviation"))
    assert all(one.quantity != "further" for one in other.measures)
