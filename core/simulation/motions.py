"""The exercises: what wrist, fingers and arm do over time (clinical reference 4.4 and 8.2).

Every recording starts with a still neutral pose of :data:`STILL_S`. Wrist angles are clinical: deviation + radial,
flexion + flexion, pro/supination + supination. Ranges: flexion 50 degrees to both sides, deviation 25,
pro/supination 35. Reaching follows measured reach-to-grasp: 0.39 m in 1.05 s, speed peak near 0.73 m/s.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from core.errors import SettingsInvalid
from core.hand.protocols import joint_angle_names
from core.simulation.hand_motion import STILL_S, HandMotion, drawn_sway
from core.simulation.spec import RecordingSpec, Stream
from core.simulation.strokes import StrokeWriter
from core.types import FloatArray

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

    def wrist_target(self, deviation: float = 0.0, flexion: float = 0.0, supination: float = 0.0) -> FloatArray:
        """Shares of the full range of each angle, as angles."""
        return self.range_share * np.array(
            [deviation * DEVIATION_RAD, flexion * FLEXION_RAD, supination * SUPINATION_RAD]
        )


def _rest(patient: _Patient) -> None:
    pass


def _flexion(patient: _Patient) -> None:
    targets = [patient.wrist_target(flexion=1.0), patient.wrist_target(flexion=-1.0)]
    patient.repeat(patient.wrist, targets, np.zeros(3))


def _deviation(patient: _Patient) -> None:
    targets = [patient.wrist_target(deviation=1.0), patient.wrist_target(deviation=-1.0)]
    patient.repeat(patient.wrist, targets, np.zeros(3))


def _fast_deviation(patient: _Patient) -> None:
    targets = [patient.wrist_target(deviation=1.0), patient.wrist_target(deviation=-1.0)]
    patient.repeat(patient.wrist, targets, np.zeros(3), hold_share=0.0)


def _pronosupination(patient: _Patient) -> None:
    targets = [patient.wrist_target(supination=1.0), patient.wrist_target(supination=-1.0)]
    patient.repeat(patient.wrist, targets, np.zeros(3))


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
        steps: list[tuple[FloatArray, FloatArray, FloatArray, float]] = [
            (way, turned, opened, REACH_S * pace),
            (way, turned, closed, 0.4 * pace),
            (way + lift, turned, closed, 0.5 * pace),
            (way, turned, closed, 0.5 * pace),
            (way, turned, opened, 0.4 * pace),
            (np.zeros(3), np.zeros(3), patient.neutral, REACH_S * pace),
        ]
        for place, posture, joints, duration_s in steps:
            patient.carry.move(place, duration_s)
            patient.wrist.move(posture, duration_s)
            patient.joints.move(joints, duration_s)
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


_DEFAULT_REACH_S = 4.0

MOTIONS: dict[str, tuple[Callable[[_Patient], None], float]] = {
    "rest": (_rest, 0.3),
    "flexion": (_flexion, 0.3),
    "deviation": (_deviation, 0.4),
    "pronosupination": (_pronosupination, 0.35),
    "mixed": (_mixed, 0.4),
    "fast_deviation": (_fast_deviation, 1.7),
    "reach": (_reach, 1.0 / _DEFAULT_REACH_S),
    "reach_grasp": (_reach_grasp, 1.0 / _DEFAULT_REACH_S),
    "fist": (_fist, 0.3),
    "hook": (_hook, 0.3),
    "fingers": (_fingers, 0.4),
    "abduction": (_abduction, 0.4),
    "thumb": (_thumb, 0.35),
    "tremor": (_rest, 0.3),
}
"""Exercise and its repetitions per second where the spec gives none."""

_TREMOR_DEG = 2.0


def motion_of(spec: RecordingSpec) -> HandMotion:
    """The motion a spec asks for; raises :class:`SettingsInvalid` for an unknown name."""
    if spec.motion not in MOTIONS:
        raise SettingsInvalid("motion", f"{spec.motion} ({', '.join(MOTIONS)})")
    write, default_hz = MOTIONS[spec.motion]
    rng = spec.random(Stream.MOTION)
    patient = _Patient(spec, rng, default_hz)
    write(patient)
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
    )


def _leave(patient: _Patient) -> None:
    """Draw the whole arm back out of the picture in the middle of the recording, wait, and return."""
    away_s, out_s = 0.6, patient.rng.uniform(0.8, 1.5)
    start_s = 0.45 * patient.end_s
    path = StrokeWriter(np.zeros(3), max(start_s, STILL_S))
    path.move(np.array([-0.55, 0.0, 0.0]), away_s)
    path.hold(out_s)
    path.move(np.zeros(3), away_s)
    patient.carry = path
