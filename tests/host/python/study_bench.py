#!@ASTROLABE_PYTHON@
"""A study of 100 squares by the command line and from Python, one thread each: the smallest of five times."""

import subprocess
import sys
import time

sys.path.insert(0, "@CMAKE_BINARY_DIR@/python")
from astrolabe import calibration

TRIALS, RUNS = 10, 5  # of ten squares each


def by_command_line() -> None:
    words = ["--trials", str(TRIALS), "--runs", str(RUNS), "--jobs", "1", "--json"]
    subprocess.run(["@CMAKE_BINARY_DIR@/bin/astrolabe", "study", *words], check=True, stdout=subprocess.DEVNULL)


def by_python() -> None:
    calibration.study(trials=TRIALS, runs=RUNS, jobs=1)


def seconds(work) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


times = [(seconds(by_command_line), seconds(by_python)) for _ in range(5)]
command_line, python = (min(column) for column in zip(*times))
print(f"{TRIALS * 2 * RUNS} squares: command line {command_line:.3f} s, Python {python:.3f} s, {python / command_line - 1:+.1%}")
