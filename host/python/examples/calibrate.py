"""From arrays to factors, cell by cell as in a notebook. Usage: python3 calibrate.py"""

# %% A robot whose wheels and wheelbase are off drives squares and circles both ways under simulated cameras.
import astrolabe
from astrolabe import calibration

robot = calibration.SimulatedRobot(true_ed=1.00416, true_wheelbase_m=0.28861, slip_m=2.645e-6, seed=1)
paths = 3 * [astrolabe.square(2, ccw=False), astrolabe.square(2)]
recorded = [robot.drive(path, f"square {number}") for number, path in enumerate(paths, start=1)]

# %% What any robot has: times and counts of its wheels, times and poses of its tracker.
import numpy

def columns(samples, *names):
    return numpy.column_stack([samples["time_us"] / 1e6] + [samples[name] for name in names])

drives = [
    (columns(run.odometry, "left_counts", "right_counts"), columns(run.truth, "x_m", "y_m", "theta_rad"))
    for run in recorded
]

# %% Factors, how certain they are, and whether they are better on drives that they have not seen.
sizes = robot.parameters
runs = calibration.runs_of(
    drives,
    wheel_diameter_m=sizes["wheel_diameter"],
    wheelbase_m=sizes["b"],
    counts_per_turn=sizes["counts_per_motor_rev"] * sizes["gear_numerator"] / sizes["gear_denominator"],
)
found = calibration.calibrate(runs)
print(found.factors)
print("standard errors:", found.standard_errors)
print(found.sentence)

# %% What is left on each drive, before and after.
for before, after in zip(calibration.dead_reckon(runs, found.loaded), calibration.dead_reckon(runs, found.factors)):
    print(f"{before['name']}: {1e3 * before['final_m']:.0f} mm -> {1e3 * after['final_m']:.0f} mm")

# %% Load them and drive again.
robot.load({"c_R": found.factors.c_R, "c_L": found.factors.c_L, "b": found.factors.b_m})
again = robot.drive(astrolabe.square(2), "again")
print("again:", calibration.dead_reckon([again], calibration.Factors(b_m=sizes["b"]))[0]["final_m"], "m by the old factors")
