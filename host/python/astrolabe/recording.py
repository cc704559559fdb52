"""Telemetry in SI units, as it comes or as a whole drive."""

from __future__ import annotations

import csv
import math
import os
from dataclasses import astuple, dataclass, fields
from typing import TYPE_CHECKING, Any, Iterator, Sequence, overload

from astrolabe.messages import Mode, Telemetry

if TYPE_CHECKING:
    import numpy

# The groups that a Sample holds: pose to state.
GROUPS = sum(1 << bit for bit in range(8))
_METRE = 2.0**-40
_TURN = 2.0**-64


@dataclass(frozen=True)
class Sample:
    """What the robot measured in one tick.

    Attributes:
        time_s: since the robot was switched on, on its clock
        x_m, y_m, theta_rad: odometry, the base in the odom frame; the heading does not wrap
        v_mps, omega_radps: observed velocity of the robot centre
        left_counts, right_counts: encoder counts since start, forward positive; they wrap at 2^32
        left_mps, right_mps: observed speeds of the wheels' rims
        left_setpoint_mps, right_setpoint_mps: the speeds that were commanded
        left_duty, right_duty: fraction of the supply voltage, -1 to 1
        battery_V: motor supply
        mode: the number of a Mode
        segment: the tag of the running segment, 0 if none runs
        latched_faults: bit n is Fault n
    """

    time_s: float
    x_m: float
    y_m: float
    theta_rad: float
    v_mps: float
    omega_radps: float
    left_counts: int
    right_counts: int
    left_mps: float
    right_mps: float
    left_setpoint_mps: float
    right_setpoint_mps: float
    left_duty: float
    right_duty: float
    battery_V: float
    mode: Mode
    segment: int
    latched_faults: int

    @classmethod
    def of(cls, telemetry: Telemetry) -> Sample:
        """A Telemetry that holds all GROUPS in SI units."""
        pose, counts, speed = telemetry.pose, telemetry.counts, telemetry.wheel_speed
        return cls(
            telemetry.device_time_us / 1e6,
            pose.x * _METRE,
            pose.y * _METRE,
            2 * math.pi * (pose.turns + pose.theta * _TURN),
            telemetry.twist.v_umps / 1e6,
            telemetry.twist.omega_uradps / 1e6,
            counts.left,
            counts.right,
            speed.left_umps / 1e6,
            speed.right_umps / 1e6,
            telemetry.setpoint.left_umps / 1e6,
            telemetry.setpoint.right_umps / 1e6,
            telemetry.duty.left * 2.0**-15,
            telemetry.duty.right * 2.0**-15,
            telemetry.battery.mv / 1e3,
            telemetry.state.mode,
            telemetry.state.tag,
            telemetry.state.latched_faults,
        )


COLUMNS = tuple(field.name for field in fields(Sample))
_INTEGERS = ("left_counts", "right_counts", "mode", "segment", "latched_faults")


class Recording(Sequence[Sample]):
    """The samples of a drive, in the order of the robot's clock."""

    def __init__(self) -> None:
        self._samples: list[Sample] = []

    @overload
    def __getitem__(self, index: int) -> Sample: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[Sample]: ...

    def __getitem__(self, index: int | slice) -> Sample | Sequence[Sample]:
        return self._samples[index]

    def __len__(self) -> int:
        return len(self._samples)

    def __iter__(self) -> Iterator[Sample]:
        return iter(self._samples)

    def add(self, telemetry: Telemetry) -> None:
        """Appends a sample. One that lacks a group belongs to an earlier choice of groups and is left out."""
        if telemetry.fields & GROUPS == GROUPS:
            self._samples.append(Sample.of(telemetry))

    def to_numpy(self) -> numpy.ndarray[Any, numpy.dtype[numpy.void]]:
        """A structured array, one field for each attribute of a Sample: recording.to_numpy()["x_m"]."""
        import numpy

        kinds = [(name, "i8" if name in _INTEGERS else "f8") for name in COLUMNS]
        return numpy.array([astuple(sample) for sample in self._samples], dtype=kinds)

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """A table with a heading, one row for each sample; `mode` by name. A file that is there is replaced."""
        with open(path, "w", newline="", encoding="utf-8") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(COLUMNS)
            for sample in self._samples:
                table.writerow(value.name if isinstance(value, Mode) else value for value in astuple(sample))
