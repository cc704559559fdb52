"""The wheel: packed, installed in a fresh environment, and used from there."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

try:
    import ensurepip  # noqa: F401
    import numpy  # noqa: F401
    import serial  # noqa: F401
except ImportError as missing:
    raise unittest.SkipTest(f"{missing}: install python3-venv, python3-numpy and python3-serial")

import robots

CHECKOUT = pathlib.Path(os.environ["ASTROLABE_CHECKOUT"])
PACKAGE = pathlib.Path(os.environ["ASTROLABE_PACKAGE"])
OUTSIDE = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}


class Wheel(unittest.TestCase):
    def setUp(self) -> None:
        if not list(PACKAGE.glob("_native.*.so")):
            self.skipTest(f"{PACKAGE} has no compiled part: build host.python")
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def packed(self, folder: str) -> pathlib.Path:
        words = [sys.executable, str(CHECKOUT / "host/python/pack_wheel.py"), str(PACKAGE), "1.2.3", str(self.folder / folder)]
        return pathlib.Path(subprocess.run(words, check=True, capture_output=True, text=True).stdout.strip())

    def test_is_the_same_bytes_each_time(self) -> None:
        self.assertEqual(self.packed("one").read_bytes(), self.packed("two").read_bytes())

    def test_holds_the_types_and_no_source_of_the_extension(self) -> None:
        names = zipfile.ZipFile(self.packed("wheel")).namelist()
        self.assertIn("astrolabe/py.typed", names)
        self.assertIn("astrolabe/_native.pyi", names)
        self.assertFalse([name for name in names if name.endswith((".cpp", ".hpp", ".pyc"))])

    def test_works_in_a_fresh_environment(self) -> None:
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", self.folder / "venv"], check=True)
        python = str(self.folder / "venv/bin/python")
        pip = [python, "-m", "pip", "install", "--quiet", "--no-index", "--disable-pip-version-check"]
        subprocess.run([*pip, str(self.packed("wheel"))], check=True, env=OUTSIDE, cwd=self.folder)

        def run(*words: str) -> str:
            done = subprocess.run([python, *words], check=True, env=OUTSIDE, cwd=self.folder, capture_output=True, text=True)
            return done.stdout

        self.assertIn(str(self.folder), run("-c", "import astrolabe; print(astrolabe.__file__)"))
        self.assertIn("1.2.3", run("-m", "pip", "show", "astrolabe"))
        with robots.simulated() as port:
            drive = "with astrolabe.connect(sys.argv[1]) as robot, robot.drive() as drive: drive.run(astrolabe.spin(0.1))"
            run("-c", f"import sys, astrolabe\n{drive}", port)
        self.assertIn("Better than what the robot carries", run(str(CHECKOUT / "host/python/examples/calibrate.py")))


if __name__ == "__main__":
    unittest.main()
