"""A robot at a port: what a program begins with."""

from __future__ import annotations

import time
from contextlib import contextmanager
from types import TracebackType
from typing import Iterator

from astrolabe import messages
from astrolabe.client import Client
from astrolabe.drive import Drive
from astrolabe.errors import InvalidValue
from astrolabe.line import DEFAULT_BAUD, open_line
from astrolabe.messages import Fault, HelloReply, Status
from astrolabe.parameters import Parameters
from astrolabe.recording import GROUPS, Recording, Sample

_SAMPLE_WAIT_S = 1.0


def connect(address: str, baud: int = DEFAULT_BAUD) -> Robot:
    """Connects to a robot; use it in a `with` block.

    Args:
        address: a serial port ("/dev/ttyACM0"), the pty of a simulator, or tcp:HOST:PORT on this machine
        baud: of a serial port

    Raises:
        PortError: it cannot be opened, or no robot answers.
    """
    line = open_line(address, baud)
    client = Client(line)
    try:
        client.connect()
    except BaseException:
        client.close()
        raise
    return Robot(client)


class Robot:
    """One robot, for one thread. At the end of its `with` block the port is closed; what drives is a Drive's."""

    def __init__(self, client: Client) -> None:
        self.client = client
        self._parameters: Parameters | None = None
        self._streams = False

    def __enter__(self) -> Robot:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Closes the port."""
        self.client.close()

    @property
    def identity(self) -> HelloReply:
        """Name, board and firmware version of the robot."""
        return self.client.robot

    def status(self) -> Status:
        """Mode, latched faults, battery (mV) and more, as the robot says them."""
        return self.client.request(messages.GetStatus())

    @property
    def parameters(self) -> Parameters:
        """The parameter table, read at first use: robot.parameters["b"].value, robot.parameters.set({"b": 0.29})."""
        if self._parameters is None:
            self._parameters = Parameters(self.client)
        return self._parameters

    def drive(self) -> Drive:
        """The armed robot, for a `with` block: see Drive."""
        return Drive(self.client)

    def stop(self) -> None:
        """Ramps the robot to rest, whoever drives it. It moves for nobody until it is armed again."""
        self.client.request(messages.Stop())

    def emergency_stop(self) -> None:
        """Zero duty at once, and a latched fault that clear_faults() clears."""
        self.client.request(messages.EmergencyStop())

    def faults(self) -> list[Fault]:
        """The latched faults; FAULT_HELP says what to check."""
        latched = self.client.request(messages.GetFaults()).latched
        return [fault for fault in Fault if fault != Fault.none and latched >> fault & 1]

    def clear_faults(self) -> None:
        """Clears the latched faults. Look for their reason first."""
        self.client.request(messages.ClearFaults())

    @contextmanager
    def record(self, period_s: float = 0.02) -> Iterator[Recording]:
        """Records telemetry inside the block, while the robot drives or the program waits in this package.

        Args:
            period_s: time between two samples, 0.001 s to 65.535 s; a slow line loses whole samples
        """
        recording = Recording()
        with self._streaming(period_s), self.client.listening(messages.Telemetry, recording.add):
            yield recording

    def watch(self, seconds: float, period_s: float = 0.1) -> Iterator[Sample]:
        """Yields samples as they come, for so many seconds."""
        recording = Recording()
        deadline = time.monotonic() + seconds
        with self._streaming(period_s), self.client.listening(messages.Telemetry, recording.add):
            seen = 0
            while time.monotonic() < deadline:
                self.client.pump_until(lambda: len(recording) > seen, min(_SAMPLE_WAIT_S, deadline - time.monotonic()))
                while seen < len(recording):
                    yield recording[seen]
                    seen += 1

    def wait(self, seconds: float) -> None:
        """Waits, and keeps recording."""
        self.client.pump(seconds)

    @contextmanager
    def _streaming(self, period_s: float) -> Iterator[None]:
        period_ms = round(period_s * 1000) if 0 < period_s < 66 else 0
        if not 0 < period_ms <= 0xFFFF:
            raise InvalidValue(f"a period of {period_s} s is not possible: 0.001 s to 65.535 s are")
        if self._streams:
            raise InvalidValue("the robot sends one telemetry at a time, and a block of record() or watch() has it")
        self._streams = True
        try:
            self.client.request(messages.SetTelemetry(period_ms, GROUPS))
            yield
            self.client.request(messages.SetTelemetry())
        finally:
            self._streams = False
