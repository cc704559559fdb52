"""Packs the built package as a wheel. The same files give the same bytes.

Usage: python3 pack_wheel.py PACKAGE_FOLDER VERSION OUTPUT_FOLDER
"""

import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import sysconfig
import tempfile
import time
import zipfile

METADATA = """Metadata-Version: 2.1
Name: astrolabe
Version: {version}
Summary: Client of Astrolabe robots, and calibration of their odometry
License: MIT
Requires-Python: >=3.11
Requires-Dist: numpy
Requires-Dist: pyserial
Classifier: Typing :: Typed
"""
WHEEL = "Wheel-Version: 1.0\nGenerator: astrolabe\nRoot-Is-Purelib: false\nTag: {tag}\n"


def stripped(library: pathlib.Path) -> bytes:
    """Without debug information, which is most of it."""
    with tempfile.TemporaryDirectory() as folder:
        small = pathlib.Path(folder) / library.name
        subprocess.run(["strip", "--strip-unneeded", "-o", small, library], check=True)
        return small.read_bytes()


def contents(package: pathlib.Path) -> dict[str, bytes]:
    files = {}
    for path in sorted(package.iterdir()):
        if path.suffix == ".so":
            files[f"astrolabe/{path.name}"] = stripped(path)
        elif path.suffix in (".py", ".pyi", ".typed"):
            files[f"astrolabe/{path.name}"] = path.read_bytes()
    return files


def record(files: dict[str, bytes], name: str) -> bytes:
    lines = []
    for path, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        lines.append(f"{path},sha256={digest},{len(data)}\n")
    return "".join([*lines, f"{name},,\n"]).encode()


def main(package: str, version: str, output: str) -> None:
    files = contents(pathlib.Path(package))
    if not any(name.endswith(".so") for name in files):
        sys.exit(f"{package} has no compiled part: build host.python first")
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    info = f"astrolabe-{version}.dist-info"
    files[f"{info}/METADATA"] = METADATA.format(version=version).encode()
    files[f"{info}/WHEEL"] = WHEEL.format(tag=tag).encode()
    files[f"{info}/RECORD"] = record(files, f"{info}/RECORD")
    date = time.gmtime(max(315532800, int(os.environ.get("SOURCE_DATE_EPOCH", "0"))))[:6]  # zip begins in 1980
    wheel = pathlib.Path(output) / f"astrolabe-{version}-{tag}.whl"
    wheel.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(wheel, "w") as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, date)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    print(wheel)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
