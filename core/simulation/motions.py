"""The exercises: what wrist, fingers and arm do over time (clinical reference 4.4 and 8.2).

Every recording starts with a still neutral pose of :data:`STILL_S`. Wrist angles are clinical: deviation + radial,
flexion + flexion, pro/supination + supination. Ranges: flexion 50 degrees to both sides, deviation 25,
pro/supination 35. Reaching follows measured reach-to-grasp: 0.39 m in 1.05 s, speed peak near 0.73 m/s.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from carpus.core.errors import SettingsInvalid
from carpus.core.hand.protocols import joint_angle_names
from carpus.core.simulation.hand_motion import STILL_S, HandMotion, StrokeWriter, drawn_habits, drawn_sway
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.types import FloatArray

FLEXION_RAD, DEVIATION_RAD, SUPINATION_RAD = math.radians(50.0), math.radians(25.0), math.radians(35.0)
REACH_M, REACH_S = 0.39, 1.05

_HOLD_SHARE = 0.25
"""Share of a stroke's time that is spent holding, where the exercise has holds."""


class _Patient:
    """Hands out strokes with the small irregularities of a person; used by one exercise while it is written."""

    def __init__(self, spec: RecordingSpec, rng: np.random.Generator, default_hz: float) -> None:
        self.rng = rng
        self.end_s = spec.seconds
        self.range_share = spec.range_share
        self.cycle_s = 1.0 / (default_hz if spec.speed_hz is None else spec.speed_hz)
        self.repetitions = math.inf if spec.repetitions is None else spec.repetitions
        self.pain_limited = spec.pain_limited
        self.dip_free = spec.dip == "free"
        self.joint_names = joint_angle_names(self.dip_free)
        self.neutral = self._neutral(spec.marker_protocol.has_fingers)
        self.wrist = StrokeWriter(np.zeros(3), STILL_S)
        self.joints = StrokeWriter(self.neutral, STILL_S)
        self.carry = StrokeWriter(np.zeros(3), STILL_S)

    def _neutral(self, is_flat: bool) -> FloatArray:
        """Joint angles of the still start: nearly flat for the finger protocol, relaxed otherwise."""
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

    def fingers(self, **degrees: float) -> FloatArray:
        """The neutral joints with some replaced; ``MCP_flexion=70`` sets all four fingers, ``MCP2_flexion`` one."""
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

    def stroke(self, writer: StrokeWriter, target: FloatArray, duration_s: float, hold_share: float) -> None:
        """To a target and hold; a patient in pain stops short of it, in two to four sub-movements."""
        duration_s *= self.rng.uniform(0.93, 1.07)
        start = writer.posture
        end = start + (target - start) * self.rng.uniform(0.94, 1.0)
        move_s = duration_s * (1.0 - hold_share)
        if self.pain_limited:
            end = start + (target - start) * self.rng.uniform(0.35, 0.65)
            pieces = int(self.rng.integers(2, 5))
            shares = np.sort(self.rng.uniform(0.15, 0.95, pieces - 1)).tolist() + [1.0]
            for share in shares:
                writer.move(start + share * (end - start), 1.3 * move_s / pieces)
        else:
            writer.move(end, move_s)
        writer.hold(duration_s * hold_share)

    def repeat(
        self, writer: StrokeWriter, targets: list[FloatArray], neutral: FloatArray, hold_share: float = _HOLD_SHARE
    ) -> None:
        """Visit the targets in turn, over and over, then come back to neutral."""
        done = 0
        share_s = self.cycle_s / len(targets)
        while done < self.repetitions and writer.time_s + 0.5 * share_s < self.end_s:
            for target in targets:
                self.stroke(writer, target, share_s, hold_share)
            done += 1
        writer.move(neutral, 0.5 * share_s)

    def go_through(self, *steps: tuple[FloatArray, FloatArray, FloatArray, float]) -> None:
        """Arm, wrist and joints together to one posture after the other, each in its seconds."""
        for place, posture, joints, duration_s in steps:
            self.carry.move(place, duration_s)
            self.wrist.move(posture, duration_s)
            self.joints.move(joints, duration_s)

    def wrist_target(self, deviation: float = 0.0, flexion: float = 0.0, supination: float = 0.0) -> FloatArray:
        """Shares of the full range of each angle, as angles."""
        return self.range_share * np.array(
            [deviation * DEVIATION_RAD, flexion * FLEXION_RAD, supination * SUPINATION_RAD]
        )


def _rest(patient: _Patient) -> None:
    pass


def _to_and_fro(hold_share: float = _HOLD_SHARE, back: float = 1.0, **shares: float) -> Callable[[_Patient], None]:
    """The wrist from one end of the range of an angle to the other, ``back`` as far beyond neutral as there."""

    def write(patient: _Patient) -> None:
        ends = [
            patient.wrist_target(**shares),
            patient.wrist_target(**{name: -back * share for name, share in shares.items()}),
        ]
        patient.repeat(patient.wrist, ends, np.zeros(3), hold_share)

    return write


def _mixed(patient: _Patient) -> None:
    """All three axes at once, random targets inside the box of their ranges."""
    while patient.wrist.time_s < patient.end_s:
        target = patient.wrist_target(*patient.rng.uniform(-1.0, 1.0, 3))
        patient.stroke(patient.wrist, target, 0.5 * patient.cycle_s, _HOLD_SHARE)


def _reach_way(patient: _Patient) -> FloatArray:
    """Forward and to the radial side of the right hand: keeps hand and forearm in the picture."""
    angle = math.radians(patient.rng.uniform(35.0, 60.0))
    return patient.range_share * REACH_M * np.array([math.cos(angle), math.sin(angle), 0.0])


def _reach(patient: _Patient) -> None:
    way = _reach_way(patient)
    stroke_s = REACH_S if patient.cycle_s == _DEFAULT_REACH_S else 0.35 * patient.cycle_s
    wait_s = 0.5 * patient.cycle_s - stroke_s
    turned = patient.wrist_target(deviation=0.3, flexion=-0.35, supination=0.3)
    done = 0
    while done < patient.repetitions and patient.carry.time_s < patient.end_s:
        for target, posture in ((way, turned), (np.zeros(3), np.zeros(3))):
            patient.stroke(patient.carry, target, stroke_s, 0.0)
            patient.stroke(patient.wrist, posture, patient.carry.time_s - patient.wrist.time_s, 0.0)
            patient.carry.hold(wait_s * patient.rng.uniform(0.8, 1.2))
            patient.wrist.hold(patient.carry.time_s - patient.wrist.time_s)
        done += 1


def _reach_grasp(patient: _Patient) -> None:
    way, lift = _reach_way(patient), np.array([0.0, 0.0, 0.05])
    opened = patient.fingers(MCP_flexion=15, PIP_flexion=25, CMC1_extension=25, CMC1_abduction=40)
    closed = patient.fingers(MCP_flexion=40, PIP_flexion=45, CMC1_extension=12, CMC1_abduction=40, IP1_flexion=25)
    turned = patient.wrist_target(flexion=-0.4, supination=0.4)
    pace = patient.cycle_s / _DEFAULT_REACH_S
    done = 0
    while done < patient.repetitions and patient.carry.time_s < patient.end_s:
        patient.go_through(
            (way, turned, opened, REACH_S * pace),
            (way, turned, closed, 0.4 * pace),
            (way + lift, turned, closed, 0.5 * pace),
            (way, turned, closed, 0.5 * pace),
            (way, turned, opened, 0.4 * pace),
            (np.zeros(3), np.zeros(3), patient.neutral, REACH_S * pace),
        )
        done += 1


def _fist(patient: _Patient) -> None:
    thumb = {"CMC1_extension": -5.0, "CMC1_abduction": 25.0, "MCP1_flexion": 35.0, "IP1_flexion": 40.0}
    closed = patient.fingers(MCP_flexion=70, PIP_flexion=80, MCP_abduction=0, **thumb)
    patient.repeat(patient.joints, [closed, patient.neutral], patient.neutral)


def _hook(patient: _Patient) -> None:
    bent = {"DIP_flexion": 45.0} if patient.dip_free else {}
    closed = patient.fingers(MCP_flexion=8, PIP_flexion=85, **bent)
    patient.repeat(patient.joints, [closed, patient.neutral], patient.neutral)


def _fingers(patient: _Patient) -> None:
    """One finger after the other; the neighbours follow a little (enslaving, reference 5)."""
    targets = []
    for k in (2, 3, 4, 5):
        near = {f"MCP{n}_flexion": 12.0 for n in (k - 1, k + 1) if 2 <= n <= 5}
        targets += [patient.fingers(**near, **{f"MCP{k}_flexion": 55.0, f"PIP{k}_flexion": 60.0}), patient.neutral]
    patient.cycle_s *= 4.0
    patient.repeat(patient.joints, targets, patient.neutral)


def _abduction(patient: _Patient) -> None:
    wide = patient.fingers(MCP2_abduction=16, MCP3_abduction=2, MCP4_abduction=-12, MCP5_abduction=-20,
                           CMC1_extension=38)  # fmt: skip
    patient.repeat(patient.joints, [wide, patient.neutral], patient.neutral)


def _thumb(patient: _Patient) -> None:
    """The thumb out to the side, then across towards the little finger."""
    wide = patient.fingers(CMC1_extension=35, CMC1_abduction=15)
    across = patient.fingers(CMC1_extension=-8, CMC1_abduction=40, MCP1_flexion=35, IP1_flexion=35)
    patient.repeat(patient.joints, [wide, across], patient.neutral)


_TOUCHES = {
    2: {"CMC1_extension": -9, "CMC1_abduction": 35, "MCP1_flexion": 19, "IP1_flexion": 21, "MCP2_flexion": 64,
        "PIP2_flexion": 45},
    3: {"CMC1_extension": -20, "CMC1_abduction": 37, "MCP1_flexion": 25, "IP1_flexion": 22, "MCP3_flexion": 65,
        "PIP3_flexion": 49},
    4: {"CMC1_extension": -28, "CMC1_abduction": 36, "MCP1_flexion": 35, "IP1_flexion": 25, "MCP4_flexion": 67,
        "PIP4_flexion": 46},
    5: {"CMC1_extension": -28, "CMC1_abduction": 34, "MCP1_flexion": 55, "MCP1_abduction": -9, "IP1_flexion": 28,
        "MCP5_flexion": 76, "PIP5_flexion": 41},
}  # fmt: skip
"""Angles in degrees at which the tip of the thumb meets that of a finger, within 12 mm on hands of any size."""


def _opposition(patient: _Patient) -> None:
    """The thumb's tip to that of each finger in turn, opened wide in between; each touch is a repetition."""
    wide = patient.fingers(CMC1_extension=28, CMC1_abduction=25)
    way_s = 0.5 * patient.cycle_s
    done = 0
    while done < patient.repetitions and patient.joints.time_s + way_s < patient.end_s:
        touch = patient.fingers(**{name: float(angle) for name, angle in _TOUCHES[2 + done % 4].items()})
        if not patient.pain_limited:  # the tips stop each other: no touch falls short
            patient.joints.move(touch, way_s * (1.0 - _HOLD_SHARE) * patient.rng.uniform(0.93, 1.07))
            patient.joints.hold(way_s * _HOLD_SHARE)
        else:
            patient.stroke(patient.joints, touch, way_s, _HOLD_SHARE)
        patient.stroke(patient.joints, wide, way_s, 0.0)
        done += 1
    patient.joints.move(patient.neutral, way_s)


def _bend45(patient: _Patient) -> None:
    """All fingers to 45 degrees and back: what the palm's skin does then is no movement of the wrist."""
    closed = patient.fingers(MCP_flexion=45, PIP_flexion=45)
    patient.repeat(patient.joints, [closed, patient.neutral], patient.neutral)


def _power_grip(patient: _Patient) -> None:
    """A full grip; the wrist extends a little with it, as it does by itself."""
    closed = patient.fingers(MCP_flexion=75, PIP_flexion=85, MCP_abduction=0, **_GRIPPING_THUMB)
    extended = patient.wrist_target(flexion=-patient.rng.uniform(0.15, 0.4))
    grip = np.concatenate((extended, closed))
    both = StrokeWriter(np.concatenate((np.zeros(3), patient.neutral)), STILL_S)
    patient.repeat(both, [grip, both.posture], both.posture, hold_share=0.4)
    _split(patient, both)


def _grasp_mug(patient: _Patient) -> None:
    """Reach for a mug, close finger after finger around it, lift, put it back, let go."""
    rng = patient.rng
    way, lift = 0.5 * _reach_way(patient), np.array([0.0, 0.0, 0.05])
    opened = patient.fingers(MCP_flexion=12, PIP_flexion=25, CMC1_extension=28, CMC1_abduction=42)
    bend = {
        f"MCP{k}_flexion": angle + rng.normal(0.0, 6.0) for k, angle in ((2, 42.0), (3, 50.0), (4, 56.0), (5, 60.0))
    }
    bend |= {
        f"PIP{k}_flexion": angle + rng.normal(0.0, 6.0) for k, angle in ((2, 42.0), (3, 48.0), (4, 50.0), (5, 46.0))
    }
    closed = patient.fingers(**bend, CMC1_extension=12, CMC1_abduction=48, MCP1_flexion=15, IP1_flexion=30)
    early = closed.copy()
    late = [
        i for i, name in enumerate(patient.joint_names) if name[:4] in ("MCP2", "PIP2", "DIP2", "MCP3", "PIP3", "DIP3")
    ]
    early[late] = 0.5 * (opened[late] + closed[late])
    turned = patient.wrist_target(flexion=-rng.uniform(0.3, 0.6), supination=rng.uniform(0.2, 0.5), deviation=-0.2)
    pace = patient.cycle_s / _DEFAULT_REACH_S
    done = 0
    while done < patient.repetitions and patient.carry.time_s < patient.end_s:
        patient.go_through(
            (way, turned, opened, 0.9 * pace),
            (way, turned, early, 0.25 * pace),
            (way, turned, closed, 0.25 * pace),
            (way + lift, turned, closed, 0.5 * pace),
            (way + lift, turned, closed, 0.4 * pace),
            (way, turned, closed, 0.5 * pace),
            (way, turned, opened, 0.4 * pace),
            (np.zeros(3), np.zeros(3), patient.neutral, 0.9 * pace),
        )
        done += 1


def _split(patient: _Patient, both: StrokeWriter) -> None:
    """Strokes of wrist (3) and joints at once, into the two."""
    path = both.path()
    for time_s, value in zip(path.time_s[2:], path.value[2:], strict=True):
        patient.wrist.move(value[:3], time_s - patient.wrist.time_s)
        patient.joints.move(value[3:], time_s - patient.joints.time_s)


_GRIPPING_THUMB = {"CMC1_extension": -5.0, "CMC1_abduction": 35.0, "MCP1_flexion": 30.0, "IP1_flexion": 35.0}


def _hold_grip(patient: _Patient) -> None:
    """A grip that is held while the wrist does its exercise, let go once, never quite steady."""
    rng = patient.rng
    patient.joints.move(patient.neutral, 0.1)
    lets_go_s = float(rng.uniform(0.45, 0.7)) * patient.end_s
    mcp, pip = rng.uniform(50.0, 65.0), rng.uniform(55.0, 75.0)
    while patient.joints.time_s < patient.end_s:
        if patient.joints.time_s > lets_go_s:
            patient.joints.move(patient.neutral, 0.6)
            patient.joints.hold(0.5)
            lets_go_s = math.inf
        squeeze = rng.uniform(0.9, 1.1)
        held = patient.fingers(MCP_flexion=mcp * squeeze, PIP_flexion=pip * squeeze, **_GRIPPING_THUMB)
        patient.joints.move(held, 0.7)
        patient.joints.hold(0.6)


def _open_and_close(patient: _Patient) -> None:
    """Fingers that open and close, as they do while somebody waits."""
    rng = patient.rng
    while patient.joints.time_s < patient.end_s:
        closed = patient.fingers(MCP_flexion=rng.uniform(30, 65), PIP_flexion=rng.uniform(30, 75))
        patient.joints.move(closed, rng.uniform(0.5, 0.9))
        patient.joints.move(patient.neutral, rng.uniform(0.5, 0.9))
        patient.joints.hold(rng.uniform(0.0, 0.6))


_DEFAULT_REACH_S = 4.0

MOTIONS: dict[str, tuple[Callable[[_Patient], None], float]] = {
    "rest": (_rest, 0.3),
    "flexion": (_to_and_fro(flexion=1.0), 0.3),
    "deviation": (_to_and_fro(deviation=1.0), 0.4),
    "pronosupination": (_to_and_fro(supination=1.0), 0.35),
    "palm_up": (_to_and_fro(back=0.1, supination=1.5), 0.35),
    "mixed": (_mixed, 0.4),
    "fast_deviation": (_to_and_fro(0.0, deviation=1.0), 1.7),
    "reach": (_reach, 1.0 / _DEFAULT_REACH_S),
    "reach_grasp": (_reach_grasp, 1.0 / _DEFAULT_REACH_S),
    "fist": (_fist, 0.3),
    "hook": (_hook, 0.3),
    "fingers": (_fingers, 0.4),
    "abduction": (_abduction, 0.4),
    "thumb": (_thumb, 0.35),
    "opposition": (_opposition, 0.35),
    "tremor": (_rest, 0.3),
    "bend45": (_bend45, 0.35),
    "power_grip": (_power_grip, 0.3),
    "grasp_mug": (_grasp_mug, 1.0 / _DEFAULT_REACH_S),
}
"""Exercise and its repetitions per second where the spec gives none."""

_TREMOR_DEG = 2.0


def motion_of(spec: RecordingSpec) -> HandMotion:
    """The motion a spec asks for; raises :class:`SettingsInvalid` for an unknown name."""
    if spec.motion not in MOTIONS:
        raise SettingsInvalid("motion", f"{spec.motion} ({', '.join(MOTIONS)})")
    write, default_hz = MOTIONS[spec.motion]
    rng = spec.random(RandomStream.MOTION)
    patient = _Patient(spec, rng, default_hz)
    write(patient)
    habit = spec.random(RandomStream.HABIT)
    _with_fingers(patient, spec, habit)
    if spec.leaves_picture:
        _leave(patient)
    tremor_deg = spec.tremor_deg or (_TREMOR_DEG if spec.motion == "tremor" else 0.0)
    axis = rng.normal(size=3)
    return HandMotion(
        joint_names=patient.joint_names,
        wrist=patient.wrist.path(),
        joints=patient.joints.path(),
        carry=patient.carry.path(),
        sway=drawn_sway(rng, len(patient.joint_names)),
        tremor_rad=math.radians(tremor_deg),
        tremor_hz=spec.tremor_hz,
        tremor_axis=axis / np.linalg.norm(axis),
        habits=drawn_habits(habit, spec.habits, len(patient.joint_names)),
    )


def _with_fingers(patient: _Patient, spec: RecordingSpec, rng: np.random.Generator) -> None:
    """Habits of the fingers, where the exercise leaves these alone."""
    if patient.joints.time_s > STILL_S:
        return
    exercise, patient.rng = patient.rng, rng
    if "grip" in spec.habits:
        _hold_grip(patient)
    elif "open_close" in spec.habits:
        _open_and_close(patient)
    patient.rng = exercise


def _leave(patient: _Patient) -> None:
    """Draw the whole arm back out of the picture in the middle of the recording, wait, and return."""
    away_s, out_s = 0.6, patient.rng.uniform(0.8, 1.5)
    start_s = 0.45 * patient.end_s
    path = StrokeWriter(np.zeros(3), max(start_s, STILL_S))
    path.move(np.array([-0.55, 0.0, 0.0]), away_s)
    path.hold(out_s)
    path.move(np.zeros(3), away_s)
    patient.carry = path
