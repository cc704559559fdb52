"""Requests and replies over a line that loses and damages frames; events; the signs of life that a moving robot needs."""

from __future__ import annotations

import time
from contextlib import contextmanager
from typing import Any, Callable, Iterator, TypeVar

from astrolabe import messages
from astrolabe.codec import DecodeError, Framer, Message, Request, decode, encode_frame, header
from astrolabe.errors import AstrolabeError, LinkLost, PortError, RobotRefused
from astrolabe.line import Line
from astrolabe.messages import ErrorCode, ErrorReply, HelloReply

_TRY_S = 0.06  # the robot's time-out is 200 ms, and one lost frame must not stop a moving robot
_TRIES = 16
_COMMIT_TRY_S = 0.25  # a commit may have to erase flash
_HELLO_TRY_S = 0.3
_HELLO_TRIES = 5
_KEEP_ALIVE_S = 0.05
_RESTARTED_US = 1_000_000  # a larger step back of the robot's clock means a restart
_DRAIN_READS = 16
_LAST_REQUEST_ID = 0x7FFF  # ids with bit 15 belong to programs that share the port with its holder
_LAST_REQUEST_MESSAGE = 0x3F

AnyReply = TypeVar("AnyReply", bound=Message)
AnyEvent = TypeVar("AnyEvent", bound=Message)


class Client:
    """One robot at the other end of a line; for one thread.

    A request without an answer is sent again under the same id, and the robot carries it out once. While pump() runs, a
    Ping is sent 50 ms after the last request. A program that neither pumps nor requests gives no sign of life, so a moving
    robot stops by its own time-out.
    """

    def __init__(self, line: Line) -> None:
        self._line = line
        self._framer = Framer()
        self._bodies: list[bytes] = []
        self._listeners: list[tuple[type[Message], Callable[[Any], None]]] = []
        self._next_id = 0
        self._waiting_for = 0
        self._reply: bytes | None = None
        self._echo = False
        self._received = 0
        self._sent_at = 0.0
        self._ping: tuple[int, float] | None = None
        self._lost_pings = 0
        self._device_us = self._answered_us = 0
        self._stops_known: int | None = None
        self.robot = HelloReply()

    @property
    def name(self) -> str:
        """The address of the robot."""
        return self._line.name

    @property
    def robot_time_us(self) -> int:
        """The newest time of the robot's clock in any message, in microseconds; 0 before the first."""
        return self._device_us

    def close(self) -> None:
        """Closes the line. A robot that drives then stops by its own time-out."""
        self._line.close()

    def connect(self) -> HelloReply:
        """Shakes hands.

        Raises:
            PortError: no robot answers, or one of another protocol version.
            AstrolabeError: the robot's answer cannot be understood.
        """
        for _ in range(_DRAIN_READS):
            if not self._line.read(0):
                break
        self._line.write(b"\0")  # ends whatever was sent before
        request_id = self._take_id()
        body = self._ask(encode_frame(messages.Hello(), request_id), request_id, _HELLO_TRY_S, _HELLO_TRIES)
        if body is None:
            raise PortError(self._why_no_robot())
        if body[0] == ErrorReply.ID:
            error = self._understand(ErrorReply, body, "Hello")
            if error.code == ErrorCode.wrong_version:
                self._require_version(error.detail)
            raise RobotRefused("Hello", error.code, error.detail)
        self.robot = self._understand(HelloReply, body, "Hello")
        self._require_version(self.robot.protocol_version)
        return self.robot

    def request(self, message: Request[AnyReply], tries: int = _TRIES) -> AnyReply:
        """Sends, waits for the reply, and repeats.

        Raises:
            RobotRefused: the robot has not carried it out.
            LinkLost: no answer came; it may have been carried out.
            AstrolabeError: the answer cannot be understood; it may have been carried out.
            ValueError: a value that its field cannot hold; nothing was sent.
        """
        request_id = self._take_id()
        frame = encode_frame(message, request_id)
        name = type(message).__name__
        try_s = _COMMIT_TRY_S if isinstance(message, messages.CommitParameters) else _TRY_S
        body = self._ask(frame, request_id, try_s, tries)
        if body is None:
            raise LinkLost(
                f"{self.name} does not answer any more ({name}, {tries} tries): is the robot still on and connected?"
            )
        if body[0] == ErrorReply.ID:
            error = self._understand(ErrorReply, body, name)
            raise RobotRefused(name, error.code, error.detail)
        reply: AnyReply = self._understand(message.REPLY, body, name)  # type: ignore[assignment]
        return reply

    @contextmanager
    def listening(self, kind: type[AnyEvent], callback: Callable[[AnyEvent], None]) -> Iterator[None]:
        """Calls back for each event of this kind that arrives inside the block, while pump() or a request runs."""
        entry = (kind, callback)
        self._listeners.append(entry)
        try:
            yield
        finally:
            self._listeners.remove(entry)

    def pump(self, duration_s: float) -> None:
        """Reads, calls listeners and keeps the robot alive for this long."""
        self.pump_until(lambda: False, duration_s)

    def pump_until(self, done: Callable[[], bool], timeout_s: float) -> bool:
        """The same until `done` is true, which is returned."""
        deadline = time.monotonic() + timeout_s
        while True:
            if done():
                return True
            now = time.monotonic()
            if now >= deadline and not self._bodies:
                return False
            self._keep_alive(now)
            self._step(min(deadline, now + _KEEP_ALIVE_S))

    def learns_of_stop(self, status: messages.Status) -> bool:
        """Whether somebody else has stopped the robot since the previous call; False at the first one."""
        before, self._stops_known = self._stops_known, status.stops_by_others
        return before is not None and before != status.stops_by_others

    def _take_id(self) -> int:
        self._next_id = self._next_id % _LAST_REQUEST_ID + 1
        return self._next_id

    def _send(self, frame: bytes) -> None:
        self._sent_at = time.monotonic()
        self._line.write(frame)

    def _ask(self, frame: bytes, request_id: int, try_s: float, tries: int) -> bytes | None:
        self._waiting_for, self._reply = request_id, None
        try:
            for _ in range(tries):
                self._send(frame)
                deadline = time.monotonic() + try_s
                while time.monotonic() < deadline or self._bodies:
                    self._step(deadline)
                    if self._reply is not None:
                        return self._reply
            return None
        finally:
            self._waiting_for = 0

    def _step(self, deadline: float) -> None:
        """Dispatches one body, or reads once."""
        if not self._bodies:
            received = self._line.read(max(0.0, deadline - time.monotonic()))
            self._received += len(received)
            self._bodies.extend(self._framer.push(received))
        if self._bodies:
            self._dispatch(self._bodies.pop(0))

    def _dispatch(self, body: bytes) -> None:
        message_id, request_id = header(body)
        if request_id == 0:
            self._dispatch_event(message_id, body)
        elif message_id <= _LAST_REQUEST_MESSAGE:
            self._echo = True
        elif request_id == self._waiting_for and self._reply is None:
            self._reply = body
        if message_id == messages.Pong.ID:
            try:
                device_us = decode(messages.Pong, body).device_time_us
            except DecodeError:
                return  # no sign of life
            if self._ping is not None and self._ping[0] == request_id:
                self._ping = None
            self._note_time(device_us)
            self._answered_us = self._device_us
            self._lost_pings = 0

    def _dispatch_event(self, message_id: int, body: bytes) -> None:
        kind = next((kind for kind in messages.MESSAGES if kind.ID == message_id), None)
        if kind is None:
            return
        try:
            event: Any = decode(kind, body)
        except DecodeError:
            return
        if isinstance(event, messages.Farewell):
            raise LinkLost(f"lost {self.name}: {messages.FAREWELL_FACTS[event.reason]}")
        if hasattr(event, "device_time_us"):
            self._note_time(event.device_time_us)
        if isinstance(event, messages.Booted):
            self._ping, self._device_us, self._answered_us = None, 0, 0
        for wanted, callback in list(self._listeners):
            if wanted is kind:
                callback(event)
        if isinstance(event, messages.Booted) and self._waiting_for and self.robot.board:
            raise LinkLost(f"the robot at {self.name} has restarted: what was under way is lost")

    def _note_time(self, device_us: int) -> None:
        if device_us + _RESTARTED_US < self._device_us:
            self._device_us = self._answered_us = 0
        self._device_us = max(self._device_us, device_us)

    def _keep_alive(self, now: float) -> None:
        """Sends a Ping 50 ms after the last request, by this clock or by the robot's: a simulator in fast motion stops its
        clock to wait for a sign of life."""
        if self._ping is not None:
            if now < self._ping[1] + _TRY_S:
                return
            self._ping = None
            self._lost_pings += 1
            if self._lost_pings == _TRIES:
                self._lost_pings = 0
                raise LinkLost(f"{self.name} does not answer any more: is the robot still on and connected?")
        elif now < self._sent_at + _KEEP_ALIVE_S and self._device_us - self._answered_us < _KEEP_ALIVE_S * 1e6:
            return
        request_id = self._take_id()
        self._ping = (request_id, now)
        self._send(encode_frame(messages.Ping(), request_id))

    def _understand(self, kind: type[AnyReply], body: bytes, request: str) -> AnyReply:
        try:
            return decode(kind, body)
        except DecodeError:
            raise AstrolabeError(
                f"the answer of {self.name} to {request} cannot be understood although its check sum is right: "
                "firmware and this package differ; update both"
            ) from None

    def _require_version(self, theirs: int) -> None:
        ours = messages.PROTOCOL_VERSION
        if theirs != ours:
            update = "this package" if theirs > ours else "the robot's firmware"
            raise PortError(
                f"the robot at {self.name} speaks protocol {theirs}, this package speaks {ours}: update {update}"
            )

    def _why_no_robot(self) -> str:
        if self._echo:
            return f"{self.name} sends back what it is sent: it is a looped-back line or a terminal, not a robot"
        if self._received == 0:
            return f"{self.name} does not answer: is it a robot running Astrolabe, switched on and set to this baud rate?"
        if self._framer.counts.good == 0:
            return f"{self.name} is not an Astrolabe robot: it sends bytes that are no Astrolabe frames"
        return f"{self.name} sends Astrolabe frames but does not answer: is the line to the robot connected?"
