"""Drives a square and plots it. Usage: python3 square.py PORT PICTURE"""
import sys
import matplotlib.pyplot as plt
import astrolabe

with astrolabe.connect(sys.argv[1]) as robot:
    with robot.record() as recording, robot.drive() as drive:
        drive.run(astrolabe.square(0.5))
path = recording.to_numpy()
plt.plot(path["x_m"], path["y_m"])
plt.axis("equal")
plt.savefig(sys.argv[2])
