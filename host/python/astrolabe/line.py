"""Bytes to and from one robot: a serial port, a pty, TCP on this machine, or the program that holds the port already."""

from __future__ import annotations

import errno
import ipaddress
import os
import socket
import struct
import time
from typing import Protocol

from astrolabe import messages
from astrolabe.codec import Framer, header
from astrolabe.errors import LinkLost, PortError

DEFAULT_BAUD = 1_000_000
_GREETING_S = 1.0  # an idle holder greets within a millisecond
_CONNECT_S = 5.0
_WRITE_S = 1.0  # a message takes milliseconds, unless the other end does not read
_HOLDER_CHANGES_S = 1.0  # a program that starts or ends holds the port for a moment in which it does not share it
_POLL_S = 0.01  # a read looks at its deadline this often
_READ_BYTES = 4096


class Line(Protocol):
    """A stream of bytes. Once the other end is gone, all calls raise LinkLost."""

    @property
    def name(self) -> str:
        """The address as people know it."""

    def write(self, data: bytes) -> None:
        """Sends all bytes."""

    def read(self, timeout_s: float) -> bytes:
        """What has come; waits up to `timeout_s` for a first byte, and returns b"" if none comes."""

    def close(self) -> None:
        """Ends the connection; may be called twice."""


class SocketLine:
    """A line over a connected socket."""

    def __init__(self, name: str, connection: socket.socket, lock: socket.socket | None = None) -> None:
        self._name = name
        self._connection = connection
        self._lock = lock  # a name that other programs find taken for as long as it is open

    @property
    def name(self) -> str:
        return self._name

    def write(self, data: bytes) -> None:
        try:
            self._connection.settimeout(_CONNECT_S)
            self._connection.sendall(data)
        except OSError as error:
            raise LinkLost(f"lost {self._name}: {error.strerror or error}") from None

    def read(self, timeout_s: float) -> bytes:
        try:
            self._connection.settimeout(max(timeout_s, 1e-4))  # 0 would mean: do not wait, and raise another error
            received = self._connection.recv(_READ_BYTES)
        except (socket.timeout, BlockingIOError):
            return b""
        except OSError as error:
            raise LinkLost(f"lost {self._name}: {error.strerror or error}") from None
        if not received:
            raise LinkLost(f"lost {self._name}: the other end has closed the connection")
        return received

    def close(self) -> None:
        self._connection.close()
        if self._lock is not None:
            self._lock.close()


class SerialLine:
    """A serial port or a pty, locked against other programs for as long as it is open."""

    def __init__(self, path: str, baud: int) -> None:
        import serial  # type: ignore[import]

        self._name = path
        self._serial_error = serial.SerialException
        self._port = serial.Serial(path, baud, timeout=_POLL_S, write_timeout=_WRITE_S, exclusive=True)

    @property
    def name(self) -> str:
        return self._name

    def write(self, data: bytes) -> None:
        try:
            self._port.write(data)
        except (OSError, self._serial_error) as error:
            raise LinkLost(f"lost {self._name}: {error}") from None

    def read(self, timeout_s: float) -> bytes:
        deadline = time.monotonic() + timeout_s
        try:
            while True:
                received = self._port.read(self._port.in_waiting or 1)
                if received or time.monotonic() >= deadline:
                    return bytes(received)
        except (OSError, self._serial_error) as error:
            raise LinkLost(f"lost {self._name}: {error}") from None

    def close(self) -> None:
        self._port.close()


class _NotShared(PortError):
    """Another program has the port, and does not share it now."""


def open_line(address: str, baud: int = DEFAULT_BAUD) -> Line:
    """Opens the line to a robot.

    Args:
        address: a path (serial port or pty), or tcp:HOST:PORT on this machine
        baud: bits per second; a pty and TCP have none

    Raises:
        PortError: it cannot be opened; the sentence says why.
    """
    deadline = time.monotonic() + _HOLDER_CHANGES_S
    while True:
        try:
            return _open_tcp(address) if address.startswith("tcp:") else _open_serial(address, baud)
        except _NotShared:
            if time.monotonic() >= deadline:
                raise
        time.sleep(_POLL_S)


def _open_serial(path: str, baud: int) -> Line:
    try:
        import serial
    except ImportError:
        raise PortError("the package pyserial is missing: install python3-serial") from None
    try:
        return SerialLine(path, baud)
    except serial.SerialException as error:
        if error.errno in (None, errno.EWOULDBLOCK) and os.path.exists(path):
            return _join(path, _key_of(path))
        raise PortError(f"{path} cannot be opened: {os.strerror(error.errno) if error.errno else error}") from None
    except (OSError, ValueError) as error:
        raise PortError(f"{path} cannot be opened: {error}") from None


def _parse_tcp(address: str) -> tuple[str, int]:
    host, _, port = address[len("tcp:") :].rpartition(":")
    host = host[1:-1] if host.startswith("[") and host.endswith("]") else host
    if not host or not port.isdecimal() or not 0 < int(port) <= 0xFFFF:
        raise PortError(f"'{address}' is not an address of the form tcp:HOST:PORT, such as tcp:localhost:5555")
    try:
        ip = ipaddress.ip_address("127.0.0.1" if host == "localhost" else host)
    except ValueError:
        ip = None
    if ip is None or not ip.is_loopback:
        raise PortError(f"{address} is not on this machine: a robot's link has no protection, so only localhost is allowed")
    return str(ip), int(port)


def _open_tcp(address: str) -> Line:
    host, port = _parse_tcp(address)
    key = f"port-tcp-{host}-{port}"
    lock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        lock.bind(_socket_name(key))
    except OSError:
        lock.close()
        return _join(address, key)
    try:
        connection = socket.create_connection((host, port), _CONNECT_S)
    except OSError as error:
        lock.close()
        raise PortError(f"nothing listens at {address} ({error.strerror or error}): is the simulator running?") from None
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return SocketLine(address, connection, lock)


def _socket_name(key: str) -> str:
    return "\0astrolabe-" + key


def _key_of(path: str) -> str:
    """The name of a device for all programs of this machine, as host/robot/port/serial_port.cpp writes it."""
    about = os.stat(path)
    major, minor = os.major(about.st_rdev), os.minor(about.st_rdev)
    is_pty = 136 <= major <= 143  # each container numbers its ptys from 0, in a file system of its own
    return f"{f'pty-{about.st_dev}' if is_pty else 'port'}-{major}-{minor}"


def _join(address: str, key: str) -> Line:
    """The line through the program that holds the port, which shares it with programs of the same user."""
    connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        connection.connect(_socket_name(key))
        _, user, _ = struct.unpack("3i", connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, 12))
        if os.geteuid() not in (0, user) and user != 0:
            raise PortError(f"{address} is in use by another user")
        _await_welcome(connection)
    except (OSError, LinkLost):
        connection.close()
        raise _NotShared(f"{address} is in use by another program, which does not share it") from None
    except PortError:
        connection.close()
        raise
    return SocketLine(address, connection)


def _await_welcome(connection: socket.socket) -> None:
    """Reads the first frame and no byte after it. Raises OSError if none comes in time."""
    connection.settimeout(_GREETING_S)
    framer = Framer()
    while True:
        byte = connection.recv(1)
        if not byte:
            raise ConnectionResetError
        for body in framer.push(byte):
            if header(body)[0] != messages.Welcome.ID:
                raise ConnectionResetError
            return
