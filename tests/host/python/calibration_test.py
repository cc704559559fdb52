"""Calibration from Python against the command line, which uses the same libraries."""

import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from typing import Any

try:
    import numpy
except ImportError as missing:
    raise unittest.SkipTest(f"{missing}: install python3-numpy")
# An extension that is there and cannot be imported is a fault, which skipping would hide.
if not any(pathlib.Path(os.environ["ASTROLABE_PACKAGE"]).glob("_native*.so")):
    raise unittest.SkipTest("the extension is missing: install pybind11-dev, and build host.python")

import astrolabe
from astrolabe import calibration

PROGRAM = os.environ["ASTROLABE_PROGRAM"]
DATA = pathlib.Path(os.environ["ASTROLABE_CHECKOUT"]).parent / "shared/data/sousa_optiodom/square/231220200029"
SIZES = {"wheel_diameter_m": 0.084, "counts_per_turn": 2796.8, "wheelbase_m": 0.2}


def by_command_line(*words: str) -> Any:
    """What it prints as JSON. It exits with 1 if it advises against the factors that it found."""
    done = subprocess.run([PROGRAM, "calibrate", *words, "--json"], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)


class RealDrives(unittest.TestCase):
    """Ten squares of another robot; the synchronised files hold t, x, y, theta, and the counts right and left of each interval."""

    def setUp(self) -> None:
        if not DATA.is_dir():
            self.skipTest(f"not at hand: {DATA}")
        self.files = sorted(DATA.glob("*_run-[0-9][0-9].csv"))
        self.assertGreater(len(self.files), 3)

    def test_arrays_give_the_factors_of_the_command_line_to_the_last_digit(self) -> None:
        drives = []
        for file in self.files:
            rows = numpy.loadtxt(file, delimiter=",")
            wheels = numpy.column_stack([rows[:, 0], numpy.cumsum(rows[:, 5]), numpy.cumsum(rows[:, 4])])
            drives.append((wheels, rows[:, :4]))
        found = calibration.calibrate(
            calibration.runs_of(drives, **SIZES, names=[file.stem for file in self.files]), method="ml"
        )
        words = ["files", "--per-interval", "--wheel-diameter", "0.084", "--counts-per-turn", "2796.8", "--wheelbase", "0.2"]
        words += ["--wheel-columns", "time_s,-,-,-,right_counts,left_counts"]
        words += ["--truth-columns", "time_s,x_m,y_m,theta_rad,-,-"]
        for file in self.files:
            words += ["--wheels", str(file), "--truth", str(file)]
        expected = by_command_line(*words)
        self.assertEqual(calibration.details(found), expected)
        self.assertEqual(found.factors.c_R, expected["c_R"])
        self.assertEqual(found.covariance.tolist(), expected["covariance"]["matrix"])

    def test_files_of_the_tracker_give_the_factors_of_the_command_line_to_the_last_digit(self) -> None:
        pairs = [(str(DATA / f"{file.stem}_odo.csv"), str(DATA / f"{file.stem}_opti.csv.gz")) for file in self.files]
        columns = "time_s,left_counts,right_counts"
        found = calibration.calibrate(
            calibration.import_runs(pairs, wheel_columns=columns, per_interval=True, **SIZES), method="ml"
        )
        words = ["files", "--per-interval", "--wheel-diameter", "0.084", "--counts-per-turn", "2796.8", "--wheelbase", "0.2"]
        words += ["--wheel-columns", columns]
        for wheels, truth in pairs:
            words += ["--wheels", wheels, "--truth", truth]
        self.assertEqual(calibration.details(found), by_command_line(*words))


class SimulatedDrives(unittest.TestCase):
    def setUp(self) -> None:
        robot = calibration.SimulatedRobot(true_ed=1.00416, true_wheelbase_m=0.28861, slip_m=2.645e-6, seed=1)
        paths = 2 * [astrolabe.square(1), astrolabe.square(1, ccw=False)]
        self.runs = [robot.drive(path, f"square {number}") for number, path in enumerate(paths)]

    def test_the_factors_with_which_the_robot_was_built_are_within_their_errors(self) -> None:
        found = calibration.calibrate(self.runs)
        difference = numpy.array([found.factors.c_R / found.factors.c_L - 1.00416, found.factors.b_m - 0.28861])
        errors = numpy.array([found.standard_errors["E_d"], found.standard_errors["b_m"]])
        self.assertTrue((abs(difference) < 4 * errors).all(), f"{difference} of {errors}")  # the seed is fixed
        self.assertLess(errors[1], 2e-3)
        self.assertEqual(found.verdict, "better")

    def test_recordings_survive_a_file_and_are_those_of_the_command_line(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            for run in self.runs:
                run.write(os.path.join(folder, f"{run.name}.mcap"))
            again = calibration.read_runs(folder)
            expected = by_command_line("runs", folder)
        numpy.testing.assert_array_equal(again[0].odometry["left_counts"], self.runs[0].odometry["left_counts"])
        self.assertEqual(calibration.details(calibration.calibrate(again)), expected)

    def test_new_factors_leave_less_than_those_in_the_robot(self) -> None:
        found = calibration.calibrate(self.runs)
        before = calibration.dead_reckon(self.runs, found.loaded)
        after = calibration.dead_reckon(self.runs, found.factors)
        for loaded, new in zip(before, after):
            self.assertLess(new["final_m"], loaded["final_m"])

    def test_the_same_seed_gives_the_same_drive(self) -> None:
        twins = [calibration.SimulatedRobot(seed=7).drive(astrolabe.line(0.3)) for _ in range(2)]
        numpy.testing.assert_array_equal(twins[0].truth, twins[1].truth)

    def test_a_study_is_that_of_the_command_line(self) -> None:
        study = calibration.study(trials=3, runs=2, seed=5, sigma_theta_rad=math.radians(0.15))
        printed = subprocess.run(
            [PROGRAM, "study", "--trials", "3", "--runs", "2", "--seed", "5", "--json"], capture_output=True, text=True, check=True
        )
        by_name = {row["name"]: row for row in json.loads(printed.stdout)["methods"]}
        for row in study["methods"]:
            self.assertEqual(row["rms"][0], by_name[row["method"]]["rms"]["E_d"])


    def test_a_ctrl_c_ends_a_drive_and_leaves_the_robot_usable(self) -> None:
        robot = calibration.SimulatedRobot()
        go = threading.Lock()
        go.acquire()

        def press() -> None:
            with go:
                signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)

        # So long a switch interval gives the thread its turn only when the drive releases Python's lock.
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(600)
        pressing = threading.Thread(target=press)
        pressing.start()
        path = 1000 * astrolabe.square(10)
        with self.assertRaises(KeyboardInterrupt):
            go.release()
            robot.drive(path)
        pressing.join()
        self.assertEqual(robot.drive(astrolabe.line(0.1)).facts["board"], "sim")

    def test_threads_take_turns_at_one_robot(self) -> None:
        robot = calibration.SimulatedRobot()
        runs: list[calibration.Run] = []
        threads = [threading.Thread(target=lambda: runs.append(robot.drive(astrolabe.line(0.3)))) for _ in range(3)]
        for thread in threads:
            thread.start()
        for _ in range(3):
            self.assertEqual(robot.parameters["b"], 0.29)
        for thread in threads:
            thread.join()
        for run in runs:
            self.assertAlmostEqual(run.odometry["x_m"][-1], 0.3, delta=2e-3)  # what the speed loop leaves of a stop
        self.assertEqual(len(runs), 3)


class Arrays(unittest.TestCase):
    """A straight start and a turn to the left, by wheels without any error."""

    def setUp(self) -> None:
        times = numpy.arange(0, 20, 0.05)
        v, omega = numpy.full_like(times, 0.2), numpy.where(times < 5, 0.0, 0.3)
        theta = numpy.concatenate([[0], numpy.cumsum(omega[:-1] * 0.05)])
        along, across = numpy.cos(theta + omega * 0.025), numpy.sin(theta + omega * 0.025)
        x, y = (numpy.concatenate([[0], numpy.cumsum(v[:-1] * 0.05 * part[:-1])]) for part in (along, across))
        turn_m = SIZES["wheelbase_m"] / 2 * theta
        travel = numpy.concatenate([[0], numpy.cumsum(v[:-1] * 0.05)])
        per_m = SIZES["counts_per_turn"] / (math.pi * SIZES["wheel_diameter_m"])
        self.times, self.truth = times, numpy.column_stack([times, x, y, theta])
        self.left, self.right = per_m * (travel - turn_m), per_m * (travel + turn_m)

    def runs(self, left: Any, right: Any, **statements: Any) -> Any:
        stated: dict[str, Any] = {**SIZES, **statements}
        wheels = numpy.column_stack([self.times, left, right])
        return calibration.runs_of([(wheels, self.truth)], **stated)[0].odometry

    def test_what_is_stated_of_the_wheels_is_undone(self) -> None:
        expected = self.runs(self.left, self.right)
        numpy.testing.assert_array_equal(self.runs(self.right, self.left, swap_wheels=True), expected)
        numpy.testing.assert_array_equal(self.runs(-self.left, -self.right, reverse_wheels=True), expected)
        both = self.runs(-self.right, -self.left, swap_wheels=True, reverse_wheels=True)
        numpy.testing.assert_array_equal(both, expected)

    def test_what_does_not_apply_to_arrays_is_refused_by_its_name(self) -> None:
        statements = {
            "truth_unit": "mm", "counter_range": 65536, "per_interval": True, "wheels_unit": "rad", "wheel_columns": "a,b,c",
            "truth_columns": "a,b,c", "body": "robot", "wheels_topic": "/a", "truth_topic": "/b",
        }  # fmt: skip
        for name, value in statements.items():
            with self.assertRaisesRegex(astrolabe.DataError, f"{name} does not apply here"):
                self.runs(self.left, self.right, **{name: value})

    def test_sizes_that_no_robot_has_are_refused(self) -> None:
        for name in SIZES:
            for value in (math.nan, math.inf, -1, 0, 1e9):
                with self.assertRaisesRegex(astrolabe.DataError, f"{name.removesuffix('_m')} is .* must be from"):
                    self.runs(self.left, self.right, **{name: value})
                with self.assertRaisesRegex(astrolabe.DataError, f"{name.removesuffix('_m')} is .* must be from"):
                    calibration.import_runs([("/nonexistent", "/nonexistent")], **{**SIZES, name: value})


class Refusals(unittest.TestCase):
    def test_none_is_no_run(self) -> None:
        nothing: Any = [None]
        with self.assertRaisesRegex(TypeError, "None in place of a run"):
            calibration.calibrate(nothing)
        with self.assertRaisesRegex(TypeError, "None in place of a run"):
            calibration.dead_reckon(nothing, calibration.Factors(b_m=0.3))

    def test_a_sentence_of_the_libraries_becomes_an_exception(self) -> None:
        with self.assertRaisesRegex(astrolabe.DataError, "does not exist"):
            calibration.read_runs("/nonexistent")
        with self.assertRaises(astrolabe.DataError):
            calibration.study(trials=0)

    def test_arrays_that_are_no_drives_are_refused(self) -> None:
        times = numpy.arange(0, 10, 0.1)
        wheels = numpy.column_stack([times, times, times])
        truth = numpy.column_stack([times, times, times, times])
        for bad in [(wheels[:, :2], truth), (wheels, truth[:, :2]), (wheels * numpy.nan, truth), (wheels.ravel(), truth)]:
            with self.assertRaises(ValueError):
                calibration.runs_of([bad], **SIZES)
        for bad in [(wheels[::-1], truth), (wheels[:1], truth), (wheels, truth[:0])]:
            with self.assertRaisesRegex(astrolabe.DataError, "'drive 1': "):
                calibration.runs_of([bad], **SIZES)

    def test_a_word_that_means_nothing_is_named(self) -> None:
        with self.assertRaisesRegex(astrolabe.InvalidValue, "there is no 'wheel_base'"):
            calibration.SimulatedRobot(wheel_base=0.3)
        with self.assertRaisesRegex(ValueError, "clock must be"):
            calibration.calibrate([], clock="sundial")


if __name__ == "__main__":
    unittest.main()
