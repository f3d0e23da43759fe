"""Exercises: movement of wrist, fingers and arm over time (clinical reference 4.4 and 8.2).

Every recording starts with a still neutral pose of :data:`STILL_S`. Wrist angles are clinical: deviation + radial,
flexion + flexion, pronosupination + supination. Ranges: flexion 50 degrees to both sides, deviation 25, pronosupination
35. Reaching follows measured reach-to-grasp: 0.39 m in 1.05 s, speed peak near 0.73 m/s.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.hand.protocols import joint_angle_names
from carpus.core.model.types import FloatArray
from carpus.core.simulation.hand_motion import STILL_S, HandMotion, StrokePathBuilder, sample_habits, sample_sway
from carpus.core.simulation.spec import RandomStream, RecordingSpec

FLEXION_RAD, DEVIATION_RAD, SUPINATION_RAD = math.radians(50.0), math.radians(25.0), math.radians(35.0)
REACH_M, REACH_S = 0.39, 1.05

_HOLD_SHARE = 0.25
"""Share of a stroke's time spent holding, in exercises with holds."""


class _MotionBuilder:
    """Builds the strokes of one exercise with a person's small irregularities."""

    def __init__(self, spec: RecordingSpec, rng: np.random.Generator, default_hz: float) -> None:
        self.rng = rng
        self.end_s = spec.seconds
        self.range_share = spec.range_share
        self.cycle_s = 1.0 / (default_hz if spec.speed_hz is None else spec.speed_hz)
        self.repetitions = math.inf if spec.repetitions is None else spec.repetitions
        self.pain_limited = spec.pain_limited
        self.dip_free = spec.dip == "free"
        self.joint_names = joint_angle_names(self.dip_free)
        self.neutral = self._sample_neutral_joints(spec.marker_protocol.has_fingers)
        self.wrist = StrokePathBuilder(np.zeros(3), STILL_S)
        self.joints = StrokePathBuilder(self.neutral, STILL_S)
        self.arm = StrokePathBuilder(np.zeros(3), STILL_S)

    def _sample_neutral_joints(self, is_flat: bool) -> FloatArray:
        """Draw the joint angles of the start: nearly flat with finger markers, else relaxed."""
        rng, posture = self.rng, dict.fromkeys(self.joint_names, 0.0)
        bend = (2.0, 8.0) if is_flat else (8.0, 18.0)
        for k in (2, 3, 4, 5):
            posture[f"MCP{k}_flexion"] = math.radians(rng.uniform(*bend))
            posture[f"PIP{k}_flexion"] = math.radians(rng.uniform(*bend))
            posture[f"MCP{k}_abduction"] = math.radians(rng.uniform(-1.5, 1.5) + (2.0, 0.0, -1.0, -3.0)[k - 2])
            if self.dip_free:
                posture[f"DIP{k}_flexion"] = posture[f"PIP{k}_flexion"] * 2.0 / 3.0
        posture["CMC1_extension"] = math.radians(rng.uniform(8.0, 18.0))
        posture["CMC1_abduction"] = math.radians(rng.uniform(5.0, 15.0))
        posture["MCP1_flexion"] = math.radians(rng.uniform(2.0, 8.0))
        posture["IP1_flexion"] = math.radians(rng.uniform(2.0, 10.0))
        return np.array([posture[name] for name in self.joint_names])

    def finger_posture(self, **degrees: float) -> FloatArray:
        """Return the neutral joints with some replaced, in degrees.

        ``MCP_flexion=70`` sets all four fingers, ``MCP2_flexion`` one.
        """
        out = self.neutral.copy()
        for name, value in degrees.items():
            base, _, kind = name.partition("_")
            for i, joint in enumerate(self.joint_names):
                joint_base, _, joint_kind = joint.partition("_")
                same = joint_base == base or (joint_base[:-1] == base and joint_base[-1] in "2345")
                if same and joint_kind == kind:
                    out[i] = math.radians(value * self.range_share)
        if self.dip_free and not any(name.startswith("DIP") for name in degrees):
            for k in "2345":
                dip, pip = (self.joint_names.index(f"{j}{k}_flexion") for j in ("DIP", "PIP"))
                out[dip] = out[pip] * 2.0 / 3.0
        return out

    def add_stroke(self, writer: StrokePathBuilder, target: FloatArray, duration_s: float, hold_share: float) -> None:
        """Move to a target and hold; with pain stop short of it, in two to four sub-movements."""
        duration_s *= self.rng.uniform(0.93, 1.07)
        start = writer.posture
        end = start + (target - start) * self.rng.uniform(0.94, 1.0)
        move_s = duration_s * (1.0 - hold_share)
        if self.pain_limited:
            end = start + (target - start) * self.rng.uniform(0.35, 0.65)
            pieces = int(self.rng.integers(2, 5))
            shares = np.sort(self.rng.uniform(0.15, 0.95, pieces - 1)).tolist() + [1.0]
            for share in shares:
                writer.add_stroke(start + share * (end - start), 1.3 * move_s / pieces)
        else:
            writer.add_stroke(end, move_s)
        writer.add_hold(duration_s * hold_share)

    def add_repetitions(
        self, writer: StrokePathBuilder, targets: list[FloatArray], neutral: FloatArray, hold_share: float = _HOLD_SHARE
    ) -> None:
        """Visit the targets in turn, repeatedly, then return to neutral."""
        done = 0
        share_s = self.cycle_s / len(targets)
        while done < self.repetitions and writer.time_s + 0.5 * share_s < self.end_s:
            for target in targets:
                self.add_stroke(writer, target, share_s, hold_share)
            done += 1
        writer.add_stroke(neutral, 0.5 * share_s)

    def add_postures(self, *steps: tuple[FloatArray, FloatArray, FloatArray, float]) -> None:
        """Move arm, wrist and joints together from posture to posture, each with its duration."""
        for place, posture, joints, duration_s in steps:
            self.arm.add_stroke(place, duration_s)
            self.wrist.add_stroke(posture, duration_s)
            self.joints.add_stroke(joints, duration_s)

    def wrist_target(self, deviation: float = 0.0, flexion: float = 0.0, supination: float = 0.0) -> FloatArray:
        """Return wrist angles from shares of their full range."""
        angles = (deviation * DEVIATION_RAD, flexion * FLEXION_RAD, supination * SUPINATION_RAD)
        return self.range_share * np.array(angles)


def _build_rest(builder: _MotionBuilder) -> None:
    pass


def _make_wrist_exercise(
    hold_share: float = _HOLD_SHARE, return_share: float = 1.0, **shares: float
) -> Callable[[_MotionBuilder], None]:
    """Make an exercise from one end of an angle's range to ``return_share`` of the other."""

    def build(builder: _MotionBuilder) -> None:
        ends = [
            builder.wrist_target(**shares),
            builder.wrist_target(**{name: -return_share * share for name, share in shares.items()}),
        ]
        builder.add_repetitions(builder.wrist, ends, np.zeros(3), hold_share)

    return build


def _build_mixed(builder: _MotionBuilder) -> None:
    """Move all three axes at once to random targets within their ranges."""
    while builder.wrist.time_s < builder.end_s:
        target = builder.wrist_target(*builder.rng.uniform(-1.0, 1.0, 3))
        builder.add_stroke(builder.wrist, target, 0.5 * builder.cycle_s, _HOLD_SHARE)


def _sample_reach_m(builder: _MotionBuilder) -> FloatArray:
    """Draw a reach forward and to the radial side, which keeps hand and forearm in the image."""
    angle = math.radians(builder.rng.uniform(35.0, 60.0))
    return builder.range_share * REACH_M * np.array([math.cos(angle), math.sin(angle), 0.0])


def _build_reach(builder: _MotionBuilder) -> None:
    way = _sample_reach_m(builder)
    stroke_s = REACH_S if builder.cycle_s == _DEFAULT_REACH_S else 0.35 * builder.cycle_s
    wait_s = 0.5 * builder.cycle_s - stroke_s
    turned = builder.wrist_target(deviation=0.3, flexion=-0.35, supination=0.3)
    done = 0
    while done < builder.repetitions and builder.arm.time_s < builder.end_s:
        for target, posture in ((way, turned), (np.zeros(3), np.zeros(3))):
            builder.add_stroke(builder.arm, target, stroke_s, 0.0)
            builder.add_stroke(builder.wrist, posture, builder.arm.time_s - builder.wrist.time_s, 0.0)
            builder.arm.add_hold(wait_s * builder.rng.uniform(0.8, 1.2))
            builder.wrist.add_hold(builder.arm.time_s - builder.wrist.time_s)
        done += 1


def _build_reach_grasp(builder: _MotionBuilder) -> None:
    way, lift = _sample_reach_m(builder), np.array([0.0, 0.0, 0.05])
    opened = builder.finger_posture(MCP_flexion=15, PIP_flexion=25, CMC1_extension=25, CMC1_abduction=40)
    closed = builder.finger_posture(
        MCP_flexion=40, PIP_flexion=45, CMC1_extension=12, CMC1_abduction=40, IP1_flexion=25
    )
    turned = builder.wrist_target(flexion=-0.4, supination=0.4)
    pace = builder.cycle_s / _DEFAULT_REACH_S
    done = 0
    while done < builder.repetitions and builder.arm.time_s < builder.end_s:
        builder.add_postures(
            (way, turned, opened, REACH_S * pace),
            (way, turned, closed, 0.4 * pace),
            (way + lift, turned, closed, 0.5 * pace),
            (way, turned, closed, 0.5 * pace),
            (way, turned, opened, 0.4 * pace),
            (np.zeros(3), np.zeros(3), builder.neutral, REACH_S * pace),
        )
        done += 1


def _make_finger_exercise(*postures: Mapping[str, float]) -> Callable[[_MotionBuilder], None]:
    """Make an exercise through postures of the fingers in degrees; the empty one is neutral."""

    def build(builder: _MotionBuilder) -> None:
        targets = [builder.finger_posture(**posture) for posture in postures]
        builder.add_repetitions(builder.joints, targets, builder.neutral)

    return build


_FIST = {
    "MCP_flexion": 70.0, "PIP_flexion": 80.0, "MCP_abduction": 0.0, "CMC1_extension": -5.0, "CMC1_abduction": 25.0,
    "MCP1_flexion": 35.0, "IP1_flexion": 40.0,
}  # fmt: skip
_HOOK = {"MCP_flexion": 8.0, "PIP_flexion": 85.0, "DIP_flexion": 45.0}
_SPREAD = {
    "MCP2_abduction": 16.0, "MCP3_abduction": 2.0, "MCP4_abduction": -12.0, "MCP5_abduction": -20.0,
    "CMC1_extension": 38.0,
}  # fmt: skip
_THUMB_OUT = {"CMC1_extension": 35.0, "CMC1_abduction": 15.0}
_THUMB_ACROSS = {"CMC1_extension": -8.0, "CMC1_abduction": 40.0, "MCP1_flexion": 35.0, "IP1_flexion": 35.0}
_HALF_BENT = {"MCP_flexion": 45.0, "PIP_flexion": 45.0}
"""What the palm's skin does then is no wrist movement."""


def _build_single_fingers(builder: _MotionBuilder) -> None:
    """Flex one finger after the other; the neighbours follow a little (enslaving, reference 5)."""
    targets = []
    for k in (2, 3, 4, 5):
        near = {f"MCP{n}_flexion": 12.0 for n in (k - 1, k + 1) if 2 <= n <= 5}
        targets += [
            builder.finger_posture(**near, **{f"MCP{k}_flexion": 55.0, f"PIP{k}_flexion": 60.0}),
            builder.neutral,
        ]
    builder.cycle_s *= 4.0
    builder.add_repetitions(builder.joints, targets, builder.neutral)


_TOUCH_ANGLES_DEG = {
    2: {"CMC1_extension": -9, "CMC1_abduction": 35, "MCP1_flexion": 19, "IP1_flexion": 21, "MCP2_flexion": 64,
        "PIP2_flexion": 45},
    3: {"CMC1_extension": -20, "CMC1_abduction": 37, "MCP1_flexion": 25, "IP1_flexion": 22, "MCP3_flexion": 65,
        "PIP3_flexion": 49},
    4: {"CMC1_extension": -28, "CMC1_abduction": 36, "MCP1_flexion": 35, "IP1_flexion": 25, "MCP4_flexion": 67,
        "PIP4_flexion": 46},
    5: {"CMC1_extension": -28, "CMC1_abduction": 34, "MCP1_flexion": 55, "MCP1_abduction": -9, "IP1_flexion": 28,
        "MCP5_flexion": 76, "PIP5_flexion": 41},
}  # fmt: skip
"""Angles at which the thumb meets each fingertip, within 12 mm on hands of any size."""


def _build_opposition(builder: _MotionBuilder) -> None:
    """Touch each fingertip with the thumb in turn, opened wide in between."""
    wide = builder.finger_posture(CMC1_extension=28, CMC1_abduction=25)
    way_s = 0.5 * builder.cycle_s
    done = 0
    while done < builder.repetitions and builder.joints.time_s + way_s < builder.end_s:
        touch = builder.finger_posture(
            **{name: float(angle) for name, angle in _TOUCH_ANGLES_DEG[2 + done % 4].items()}
        )
        if not builder.pain_limited:  # the tips stop each other: no touch falls short
            builder.joints.add_stroke(touch, way_s * (1.0 - _HOLD_SHARE) * builder.rng.uniform(0.93, 1.07))
            builder.joints.add_hold(way_s * _HOLD_SHARE)
        else:
            builder.add_stroke(builder.joints, touch, way_s, _HOLD_SHARE)
        builder.add_stroke(builder.joints, wide, way_s, 0.0)
        done += 1
    builder.joints.add_stroke(builder.neutral, way_s)


def _build_power_grip(builder: _MotionBuilder) -> None:
    """Make a full grip with a little wrist extension."""
    closed = builder.finger_posture(MCP_flexion=75, PIP_flexion=85, MCP_abduction=0, **_GRIPPING_THUMB)
    extended = builder.wrist_target(flexion=-builder.rng.uniform(0.15, 0.4))
    grip = np.concatenate((extended, closed))
    both = StrokePathBuilder(np.concatenate((np.zeros(3), builder.neutral)), STILL_S)
    builder.add_repetitions(both, [grip, both.posture], both.posture, hold_share=0.4)
    # add strokes of wrist (3) and joints at once to their two paths
    path = both.build()
    for time_s, value in zip(path.time_s[2:], path.value[2:], strict=True):
        builder.wrist.add_stroke(value[:3], time_s - builder.wrist.time_s)
        builder.joints.add_stroke(value[3:], time_s - builder.joints.time_s)


def _build_grasp_mug(builder: _MotionBuilder) -> None:
    """Reach for a mug, close finger after finger around it, lift, put it back, release."""
    rng = builder.rng
    way, lift = 0.5 * _sample_reach_m(builder), np.array([0.0, 0.0, 0.05])
    opened = builder.finger_posture(MCP_flexion=12, PIP_flexion=25, CMC1_extension=28, CMC1_abduction=42)
    bend = {
        f"MCP{k}_flexion": angle + rng.normal(0.0, 6.0) for k, angle in ((2, 42.0), (3, 50.0), (4, 56.0), (5, 60.0))
    }
    bend |= {
        f"PIP{k}_flexion": angle + rng.normal(0.0, 6.0) for k, angle in ((2, 42.0), (3, 48.0), (4, 50.0), (5, 46.0))
    }
    closed = builder.finger_posture(**bend, CMC1_extension=12, CMC1_abduction=48, MCP1_flexion=15, IP1_flexion=30)
    early = closed.copy()
    late = [
        i for i, name in enumerate(builder.joint_names) if name[:4] in ("MCP2", "PIP2", "DIP2", "MCP3", "PIP3", "DIP3")
    ]
    early[late] = 0.5 * (opened[late] + closed[late])
    turned = builder.wrist_target(flexion=-rng.uniform(0.3, 0.6), supination=rng.uniform(0.2, 0.5), deviation=-0.2)
    pace = builder.cycle_s / _DEFAULT_REACH_S
    done = 0
    while done < builder.repetitions and builder.arm.time_s < builder.end_s:
        builder.add_postures(
            (way, turned, opened, 0.9 * pace),
            (way, turned, early, 0.25 * pace),
            (way, turned, closed, 0.25 * pace),
            (way + lift, turned, closed, 0.5 * pace),
            (way + lift, turned, closed, 0.4 * pace),
            (way, turned, closed, 0.5 * pace),
            (way, turned, opened, 0.4 * pace),
            (np.zeros(3), np.zeros(3), builder.neutral, 0.9 * pace),
        )
        done += 1


_GRIPPING_THUMB = {"CMC1_extension": -5.0, "CMC1_abduction": 35.0, "MCP1_flexion": 30.0, "IP1_flexion": 35.0}


def _build_held_grip(builder: _MotionBuilder) -> None:
    """Hold a grip during the wrist exercise, never quite steady, released once."""
    rng = builder.rng
    builder.joints.add_stroke(builder.neutral, 0.1)
    lets_go_s = float(rng.uniform(0.45, 0.7)) * builder.end_s
    mcp, pip = rng.uniform(50.0, 65.0), rng.uniform(55.0, 75.0)
    while builder.joints.time_s < builder.end_s:
        if builder.joints.time_s > lets_go_s:
            builder.joints.add_stroke(builder.neutral, 0.6)
            builder.joints.add_hold(0.5)
            lets_go_s = math.inf
        squeeze = rng.uniform(0.9, 1.1)
        held = builder.finger_posture(MCP_flexion=mcp * squeeze, PIP_flexion=pip * squeeze, **_GRIPPING_THUMB)
        builder.joints.add_stroke(held, 0.7)
        builder.joints.add_hold(0.6)


def _build_open_close(builder: _MotionBuilder) -> None:
    """Open and close the fingers, as while waiting."""
    rng = builder.rng
    while builder.joints.time_s < builder.end_s:
        closed = builder.finger_posture(MCP_flexion=rng.uniform(30, 65), PIP_flexion=rng.uniform(30, 75))
        builder.joints.add_stroke(closed, rng.uniform(0.5, 0.9))
        builder.joints.add_stroke(builder.neutral, rng.uniform(0.5, 0.9))
        builder.joints.add_hold(rng.uniform(0.0, 0.6))


_DEFAULT_REACH_S = 4.0

MOTIONS: dict[str, tuple[Callable[[_MotionBuilder], None], float]] = {
    "rest": (_build_rest, 0.3),
    "flexion": (_make_wrist_exercise(flexion=1.0), 0.3),
    "deviation": (_make_wrist_exercise(deviation=1.0), 0.4),
    "pronosupination": (_make_wrist_exercise(supination=1.0), 0.35),
    "palm_up": (_make_wrist_exercise(return_share=0.1, supination=1.5), 0.35),
    "mixed": (_build_mixed, 0.4),
    "fast_deviation": (_make_wrist_exercise(0.0, deviation=1.0), 1.7),
    "reach": (_build_reach, 1.0 / _DEFAULT_REACH_S),
    "reach_grasp": (_build_reach_grasp, 1.0 / _DEFAULT_REACH_S),
    "fist": (_make_finger_exercise(_FIST, {}), 0.3),
    "hook": (_make_finger_exercise(_HOOK, {}), 0.3),
    "fingers": (_build_single_fingers, 0.4),
    "abduction": (_make_finger_exercise(_SPREAD, {}), 0.4),
    "thumb": (_make_finger_exercise(_THUMB_OUT, _THUMB_ACROSS), 0.35),
    "opposition": (_build_opposition, 0.35),
    "tremor": (_build_rest, 0.3),
    "bend45": (_make_finger_exercise(_HALF_BENT, {}), 0.35),
    "power_grip": (_build_power_grip, 0.3),
    "grasp_mug": (_build_grasp_mug, 1.0 / _DEFAULT_REACH_S),
}
"""Exercise and its repetitions per second if the spec gives none."""

_TREMOR_DEG = 2.0


def create_motion(spec: RecordingSpec) -> HandMotion:
    """Create the motion of a spec. Raises :class:`SettingsInvalid` for an unknown name."""
    if spec.motion not in MOTIONS:
        raise SettingsInvalid("motion", f"{spec.motion} ({', '.join(MOTIONS)})")
    write, default_hz = MOTIONS[spec.motion]
    rng = spec.generator(RandomStream.MOTION)
    patient = _MotionBuilder(spec, rng, default_hz)
    write(patient)
    habit = spec.generator(RandomStream.HABIT)
    _add_finger_habits(patient, spec, habit)
    if spec.leaves_picture:
        # take the arm out of the image in the middle of the recording, and return
        away_s, out_s = 0.6, patient.rng.uniform(0.8, 1.5)
        start_s = 0.45 * patient.end_s
        path = StrokePathBuilder(np.zeros(3), max(start_s, STILL_S))
        path.add_stroke(np.array([-0.55, 0.0, 0.0]), away_s)
        path.add_hold(out_s)
        path.add_stroke(np.zeros(3), away_s)
        patient.arm = path
    tremor_deg = spec.tremor_deg or (_TREMOR_DEG if spec.motion == "tremor" else 0.0)
    axis = rng.normal(size=3)
    return HandMotion(
        joint_names=patient.joint_names,
        wrist=patient.wrist.build(),
        joints=patient.joints.build(),
        arm=patient.arm.build(),
        sway=sample_sway(rng, len(patient.joint_names)),
        tremor_rad=math.radians(tremor_deg),
        tremor_hz=spec.tremor_hz,
        tremor_axis=axis / np.linalg.norm(axis),
        habits=sample_habits(habit, spec.habits, len(patient.joint_names)),
    )


def _add_finger_habits(builder: _MotionBuilder, spec: RecordingSpec, rng: np.random.Generator) -> None:
    """Add habits of the fingers if the exercise does not use them."""
    if builder.joints.time_s > STILL_S:
        return
    exercise, builder.rng = builder.rng, rng
    if "grip" in spec.habits:
        _build_held_grip(builder)
    elif "open_close" in spec.habits:
        _build_open_close(builder)
    builder.rng = exercise
