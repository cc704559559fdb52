"""Paths as segments for the robot's queue.

Lengths are in metres and rounded to 1 nm. Angles are in turns, counter-clockwise and left positive; a quarter turn is exact.
A speed limit of 0 is the robot's own. All functions raise InvalidValue for numbers that are not possible.
"""

from __future__ import annotations

import math

from astrolabe.errors import InvalidValue
from astrolabe.messages import AddSegment, SegmentKind

Path = list[AddSegment]


def scaled(value: float, scale: float, bits: int, what: str) -> int:
    """`value` * `scale` to the nearest integer that a signed field of so many bits can hold."""
    steps = value * scale
    if not abs(steps) < 2.0 ** (bits - 1) - 1:
        raise InvalidValue(f"{what} of {value} is not possible")
    return math.floor(steps + 0.5) if steps >= 0 else math.ceil(steps - 0.5)


def _segment(kind: SegmentKind, length_m: float, turns: float, speed_mps: float, yaw_rate_radps: float) -> AddSegment:
    if speed_mps < 0 or yaw_rate_radps < 0:
        raise InvalidValue("a speed limit cannot be negative")
    return AddSegment(
        kind=kind,
        length_nm=scaled(length_m, 1e9, 64, "a length in metres"),
        angle=scaled(turns, 2.0**32, 64, "an angle in turns"),
        speed_umps=scaled(speed_mps, 1e6, 32, "a speed in m/s"),
        yaw_rate_uradps=scaled(yaw_rate_radps, 1e6, 32, "a yaw rate in rad/s"),
    )


def line(length_m: float, *, speed_mps: float = 0, yaw_rate_radps: float = 0) -> Path:
    """Straight ahead; backwards if negative."""
    return [_segment(SegmentKind.line, length_m, 0, speed_mps, yaw_rate_radps)]


def spin(turns: float, *, speed_mps: float = 0, yaw_rate_radps: float = 0) -> Path:
    """Turns on the spot, to the left if positive."""
    return [_segment(SegmentKind.spin, 0, turns, speed_mps, yaw_rate_radps)]


def arc(length_m: float, turns: float, *, speed_mps: float = 0, yaw_rate_radps: float = 0) -> Path:
    """The robot's centre moves along `length_m` while the heading changes by `turns`."""
    return [_segment(SegmentKind.arc, length_m, turns, speed_mps, yaw_rate_radps)]


def circle(
    radius_m: float, turns: float = 1, *, ccw: bool = True, speed_mps: float = 0, yaw_rate_radps: float = 0
) -> Path:
    """`turns` times round a centre beside the start, on its left if `ccw`."""
    if not radius_m > 0 or not turns > 0:
        raise InvalidValue("a circle needs a positive radius and number of turns")
    signed = turns if ccw else -turns
    return arc(2 * math.pi * radius_m * turns, signed, speed_mps=speed_mps, yaw_rate_radps=yaw_rate_radps)


def square(side_m: float, *, ccw: bool = True, speed_mps: float = 0, yaw_rate_radps: float = 0) -> Path:
    """Four times a side and a quarter turn; ends in the pose where it began."""
    if not side_m > 0:
        raise InvalidValue("a square needs a positive side")
    corner = 0.25 if ccw else -0.25
    limits = {"speed_mps": speed_mps, "yaw_rate_radps": yaw_rate_radps}
    return 4 * (line(side_m, **limits) + spin(corner, **limits))
