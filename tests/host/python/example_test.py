"""The example of the package as a reader runs it, and the package's types."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy  # noqa: F401
    import serial  # noqa: F401
except ImportError as missing:
    raise unittest.SkipTest(f"{missing}: install python3-numpy and python3-serial")

import robots

CHECKOUT = pathlib.Path(os.environ["ASTROLABE_CHECKOUT"])
EMULATOR = os.environ["ASTROLABE_EMULATOR_PROGRAM"]
IMAGE = CHECKOUT / "build/teensy40/bin/astrolabe-teensy40.hex"


class Example(unittest.TestCase):
    def setUp(self) -> None:
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("matplotlib is missing: install python3-matplotlib")

    def drive_and_plot(self, address: str) -> None:
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "square.png"
            example = CHECKOUT / "host/python/examples/square.py"
            subprocess.run(
                [sys.executable, str(example), address, str(picture)],
                check=True,
                env={**os.environ, "MPLBACKEND": "Agg", "MPLCONFIGDIR": folder},
            )
            self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")

    def test_drives_the_simulator_at_its_pty(self) -> None:
        with robots.simulated() as port:
            self.drive_and_plot(port)

    def test_drives_the_simulator_behind_tcp(self) -> None:
        with robots.simulated() as port, robots.behind_tcp(port) as address:
            self.drive_and_plot(address)

    def test_drives_the_emulated_teensy(self) -> None:
        if not IMAGE.exists():
            self.skipTest(f"{IMAGE} is not built")
        with robots.served([EMULATOR, str(IMAGE), "--fast"]) as port:
            self.drive_and_plot(port)


class Types(unittest.TestCase):
    def test_are_right_throughout_the_package(self) -> None:
        if shutil.which("mypy") is None:
            self.skipTest("mypy is missing: install mypy")
        with tempfile.TemporaryDirectory() as cache:
            checked = subprocess.run(
                ["mypy", "--strict", "--cache-dir", cache, str(CHECKOUT / "host/python/astrolabe")],
                capture_output=True,
                text=True,
                cwd=CHECKOUT / "host/python",
            )
        self.assertEqual(checked.returncode, 0, checked.stdout)


if __name__ == "__main__":
    unittest.main()
