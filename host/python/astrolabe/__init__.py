"""Astrolabe's robots and their calibration, from Python.

    import astrolabe

    with astrolabe.connect("/dev/ttyACM0") as robot:
        with robot.record() as recording, robot.drive() as drive:
            drive.run(astrolabe.square(1.0))
    path = recording.to_numpy()

The client (this module) needs pyserial for serial ports and ptys, and numpy only for to_numpy(). astrolabe.calibration holds
the calibration.
"""

from astrolabe.drive import Drive
from astrolabe.errors import (
    AstrolabeError,
    DataError,
    DriveEnded,
    DriveFault,
    InvalidValue,
    LinkLost,
    NotStopped,
    PortError,
    RobotRefused,
)
from astrolabe.messages import FAULT_HELP, Fault, Mode
from astrolabe.parameters import Parameter, Parameters
from astrolabe.paths import Path, arc, circle, line, spin, square
from astrolabe.recording import Recording, Sample
from astrolabe.robot import Robot, connect

__all__ = [
    "AstrolabeError", "DataError", "Drive", "DriveEnded", "DriveFault", "FAULT_HELP", "Fault", "InvalidValue", "LinkLost", "Mode",
    "NotStopped", "Parameter", "Parameters", "Path", "PortError", "Recording", "Robot", "RobotRefused", "Sample", "arc",
    "circle", "connect", "line", "spin", "square",
]
