"""Calibration of a differential-drive robot's wheels from numpy arrays, recordings and simulations.

The rules are those of Astrolabe's libraries, which the extension _native holds; numbers are equal to those of its command
line to the last digit. Lengths are metres, angles radians counter-clockwise, times seconds. What the libraries refuse is a
DataError with their sentence; an array of another shape is a ValueError.
"""

from __future__ import annotations

import json
import os
from typing import Any, Mapping, Sequence

from astrolabe import _native
from astrolabe._native import Calibration, Factors, Run
from astrolabe.errors import InvalidValue
from astrolabe.messages import AddSegment

__all__ = [
    "FIGURES", "Calibration", "Factors", "Run", "SimulatedRobot", "calibrate", "dead_reckon", "details", "import_runs",
    "read_runs", "runs_of", "study",
]

# The columns of study(): errors of E_d, of b over S (relative), of S and of e, the greatest end error of the square (m), the
# heading error at its end (rad), the end error of a line of 10 m (m).
FIGURES = ("E_d", "b_over_S", "S", "e", "E_max_m", "theta_rad", "line_m")


def _with(made: Any, values: Mapping[str, Any]) -> Any:
    """Sets members of an options object by their names."""
    for name, value in values.items():
        if not hasattr(type(made), name):
            known = ", ".join(member for member in dir(type(made)) if not member.startswith("_"))
            raise InvalidValue(f"there is no '{name}' here; there are {known}")
        setattr(made, name, value)
    return made


def runs_of(
    drives: Sequence[tuple[Any, Any]],
    *,
    wheel_diameter_m: float,
    wheelbase_m: float,
    counts_per_turn: float | None = None,
    unit: str = "counts",
    names: Sequence[str] | None = None,
    **statements: Any,
) -> list[Run]:
    """Drives of any robot under any tracker, from arrays.

    Args:
        drives: wheels and ground truth of each drive.
            wheels: (n, 3) array of time_s, left, right: travel since any start, forward positive, times increasing.
            truth: (m, 4) array of time_s, x_m, y_m, theta_rad, or (m, 3) without headings; rows with a NaN were lost. Its
                clock and frame may be others than the robot's.
        wheel_diameter_m, wheelbase_m: nominal sizes, as the robot's odometry takes them
        counts_per_turn: encoder counts in a turn of the wheel; of wheels in counts only
        unit: "counts", "radians" or "metres" of the wheels
        names: how messages call the drives
        statements: swap_wheels, reverse_wheels, drives_backward: what is true of these drives

    Raises:
        DataError: drives that cannot be what they are said to be, with the reason.
        ValueError: arrays of another shape, or values that are not finite.
    """
    sizes = {"wheel_diameter_m": wheel_diameter_m, "wheelbase_m": wheelbase_m, "counts_per_turn": counts_per_turn}
    stated = _with(_native.Statements(), {**sizes, **statements})
    called = names or [f"drive {number}" for number in range(1, len(drives) + 1)]
    if len(called) != len(drives):
        raise InvalidValue(f"there are {len(called)} names for {len(drives)} drives")
    return _native.runs_of([(name, *drive) for name, drive in zip(called, drives)], unit, stated)


def import_runs(files: Sequence[tuple[str | os.PathLike[str], str | os.PathLike[str]]], **statements: Any) -> list[Run]:
    """Drives that other programs recorded.

    Args:
        files: the files of wheels and of ground truth of each drive; one bag twice if it holds both
        statements: what is not recognised by itself: wheel_columns, truth_columns, per_interval, counter_range, body, up,
            truth_unit, wheels_topic, truth_topic, wheels_unit, robot_file, wheel_diameter_m, counts_per_turn, wheelbase_m,
            swap_wheels, reverse_wheels, drives_backward
    """
    pairs = [(os.fspath(wheels), os.fspath(truth)) for wheels, truth in files]
    return _native.import_runs(pairs, _with(_native.Statements(), statements))


def read_runs(path: str | os.PathLike[str]) -> list[Run]:
    """Astrolabe's own recordings: one MCAP file, or all below a folder. Run.write() writes one."""
    return _native.read_runs(os.fspath(path))


def calibrate(
    runs: Sequence[Run],
    *,
    method: str = "auto",
    clock: str = "auto",
    noise: tuple[float, float, float] | None = None,
    sessions: Sequence[str] = (),
) -> Calibration:
    """Finds the factors of the wheels.

    Args:
        runs: all of one robot
        method: "auto", "ml" (maximum likelihood over whole drives), "umbmark", "extended", "least-squares", "robust"
        clock: of the ground truth: "known" if it is the robot's, "estimated", or "auto": as the recordings say
        noise: of maximum likelihood: slip in m (variance per metre), noise of the truth per coordinate in m and of its heading
            in rad; estimated unless given
        sessions: the session of each run, in which the tracked body and the clocks stay; found from the drives unless given

    Returns:
        factors, loaded (while it drove), covariance of c_R, c_L, b and e as a (4, 4) array (None by end poses),
        standard_errors by name, verdict ("better", "worse", "undecided" or "unknown", on drives that the factors have not
        seen), use and sentence: whether to load them, and why. details() has the rest.
    """
    return _native.calibrate(list(runs), method, clock, noise, list(sessions))


def details(found: Calibration) -> dict[str, Any]:
    """All results as the command line prints them in JSON: residuals by run and by motion, noise, lever arm, clock, remarks."""
    result: dict[str, Any] = json.loads(found.json)
    return result


def dead_reckon(runs: Sequence[Run], factors: Factors) -> list[dict[str, Any]]:
    """What is left between odometry by these factors and ground truth.

    Returns:
        of each run: name, final_m and final_heading_rad at its end, path_rms_m over all samples
    """
    return _native.dead_reckon(list(runs), factors)


class SimulatedRobot:
    """The firmware on a simulated board, under virtual cameras, in this process: seconds of driving take milliseconds.

    Args:
        cameras: rate_hz, position_sd_m, heading_sd_rad, ahead_m and left_m (place of the tracked body), seed
        robot: true_wheelbase_m, true_ed (right diameter over left), scale, true_e, slip_m (variance per metre), seed
    """

    def __init__(self, cameras: Mapping[str, float] | None = None, **robot: float) -> None:
        self._robot = _native.SimulatedRobot(
            _with(_native.RobotOptions(), robot), _with(_native.Cameras(), cameras or {})
        )

    @property
    def parameters(self) -> dict[str, float]:
        """The robot's parameters in their units."""
        return self._robot.parameters()

    def load(self, values: Mapping[str, float]) -> None:
        """Puts new parameters in force, for instance the factors that were found: {"c_R": ..., "c_L": ..., "b": ...}."""
        self._robot.load(dict(values))

    def drive(self, path: Sequence[AddSegment], name: str = "drive") -> Run:
        """Drives a path (astrolabe.square and others) from rest to rest and records it with its ground truth."""
        segments = [(int(s.kind), s.length_nm, s.angle, s.speed_umps, s.yaw_rate_uradps) for s in path]
        return self._robot.drive(name, segments)


def study(*, jobs: int = 1, **setup: Any) -> dict[str, Any]:
    """How good the methods are: a Monte Carlo over simulated experiments.

    Args:
        jobs: threads; they change no bit of the result
        setup: trials, seed, runs (squares in each direction), side_m, circles, circle_radius_m, wheelbase_m, E_d, E_b, scale, e,
            K_m, sigma_xy_m, sigma_theta_rad (as noise of calibrate()), truth_rate_hz, clock_known, noise_known, model
            ("kinematic", or "simulator": the firmware drives)

    Returns:
        methods: of each method its name, trials, and rms and se of the FIGURES; bound: the Cramer-Rao bound; failures
    """
    return _native.run_study(_with(_native.StudySetup(), setup), jobs)
