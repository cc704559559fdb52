"""Messages to bytes and back: bodies, CRC-32, COBS frames, and the receiver of a stream of frames.

The layout of each message is in messages.py. What is on the wire, and why, is told in common/protocol/README.md.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from enum import Enum, IntEnum
from typing import Any, ClassVar, Generic, NamedTuple, Sequence, TypeVar, Union

HEADER_SIZE = 3
MAX_BODY = 256
_CRC_SIZE = 4
_MAX_CODE = MAX_BODY + _CRC_SIZE + 2  # COBS adds one byte for each 254 that are begun


class Field(NamedTuple):
    """One value on the wire. `code` is that of the module struct; "24t" is a text in 24 bytes, "16s" are 16 bytes."""

    name: str
    code: str
    enum: type[IntEnum] | None = None


class Group(NamedTuple):
    """A record that is on the wire only if bit `bit` of the message's `fields` is set."""

    name: str
    bit: int
    record: type[Record]


Layout = tuple[Union[Field, Group], ...]


class Record:
    """Fields in wire order."""

    LAYOUT: ClassVar[Layout]


class Message(Record):
    """A record with an id of its own."""

    ID: ClassVar[int]


Reply = TypeVar("Reply", bound=Message, covariant=True)


class Request(Message, Generic[Reply]):
    """A message that the host sends; the robot answers it with its REPLY or an ErrorReply."""

    REPLY: ClassVar[type[Message]]


AnyMessage = TypeVar("AnyMessage", bound=Message)


class DecodeProblem(Enum):
    """What is wrong with a body."""

    too_short = "it ends before the message does"
    too_long = "bytes are left over"
    wrong_id = "it holds another message"
    bad_value = "an unknown enumeration value or group, or text after a NUL"


class DecodeError(ValueError):
    """A body that is no message of the expected kind."""

    def __init__(self, message: str, problem: DecodeProblem) -> None:
        super().__init__(f"the body is no {message}: {problem.value}")
        self.problem = problem


def _has(message: Record, group: Group) -> bool:
    return bool(getattr(message, "fields") >> group.bit & 1)


def _encode_field(field: Field, value: Any) -> bytes:
    if field.code.endswith("t"):
        text = value.encode("utf-8", "surrogateescape")
        size = int(field.code[:-1])
        if len(text) > size:
            raise ValueError(f"{field.name} = {value!r} has {len(text)} bytes; at most {size} are possible")
        return bytes(text.ljust(size, b"\0"))
    try:
        return struct.pack("<" + field.code, value)
    except struct.error as error:
        raise ValueError(f"{field.name} = {value!r} is not possible: {error}") from None


def _encode_record(record: Record) -> bytes:
    parts = []
    for entry in record.LAYOUT:
        value = getattr(record, entry.name)
        if isinstance(entry, Field):
            parts.append(_encode_field(entry, value))
        elif _has(record, entry):
            parts.append(_encode_record(value))
    return b"".join(parts)


def encode(message: Message, request_id: int) -> bytes:
    """The body of a message. Raises ValueError for a value that its field cannot hold."""
    return struct.pack("<BH", message.ID, request_id) + _encode_record(message)


class _Reader:
    """Takes fields off the front of a body. A value that is not allowed is noted and raised last: the length is judged first."""

    def __init__(self, message: str, body: bytes) -> None:
        self._message, self._body, self._at = message, body, HEADER_SIZE
        self._good = True

    def take(self, field: Field) -> Any:
        text = field.code.endswith("t")
        code = "<" + (field.code[:-1] + "s" if text else field.code)
        end = self._at + struct.calcsize(code)
        if end > len(self._body):
            raise DecodeError(self._message, DecodeProblem.too_short)
        (value,) = struct.unpack_from(code, self._body, self._at)
        self._at = end
        if text:
            characters, _, rest = value.partition(b"\0")
            self._good = self._good and not rest.strip(b"\0")
            return characters.decode("utf-8", "surrogateescape")
        if field.enum is None:
            return value
        try:
            return field.enum(value)
        except ValueError:
            self._good = False
            return value

    def record(self, kind: type[Record]) -> dict[str, Any]:
        values: dict[str, Any] = {}
        groups: list[Group] = []
        for entry in kind.LAYOUT:
            if isinstance(entry, Field):
                values[entry.name] = self.take(entry)
            else:
                groups.append(entry)
        if groups and values["fields"] & ~sum(1 << group.bit for group in groups):
            raise DecodeError(self._message, DecodeProblem.bad_value)
        for group in groups:
            if values["fields"] >> group.bit & 1:
                values[group.name] = group.record(**self.record(group.record))
        return values

    def finish(self) -> None:
        if self._at < len(self._body):
            raise DecodeError(self._message, DecodeProblem.too_long)
        if not self._good:
            raise DecodeError(self._message, DecodeProblem.bad_value)


def decode(kind: type[AnyMessage], body: bytes) -> AnyMessage:
    """The message in a body. Raises DecodeError, also for one that is a byte too long."""
    if len(body) < HEADER_SIZE:
        raise DecodeError(kind.__name__, DecodeProblem.too_short)
    if body[0] != kind.ID:
        raise DecodeError(kind.__name__, DecodeProblem.wrong_id)
    reader = _Reader(kind.__name__, body)
    values = reader.record(kind)
    reader.finish()
    return kind(**values)


def header(body: bytes) -> tuple[int, int]:
    """Message id and request id of a body that a Framer has let through."""
    message_id, request_id = struct.unpack_from("<BH", body)
    return message_id, request_id


def cobs_encode(data: bytes) -> bytes:
    """`data` without zeros (Cheshire and Baker 1999)."""
    out = bytearray()
    blocks = data.split(b"\0")
    for index, block in enumerate(blocks):
        last = index + 1 == len(blocks)
        while len(block) > 254 or (len(block) == 254 and not last):
            out += b"\xff" + block[:254]
            block = block[254:]
        if last and len(block) == 254:
            return bytes(out + b"\xff" + block)
        out += bytes((len(block) + 1,)) + block
    return bytes(out)


def cobs_decode(code: bytes) -> bytes:
    """Raises ValueError for bytes that are no encoding."""
    if not code or 0 in code:
        raise ValueError("no COBS encoding: it is empty or holds a zero")
    out = bytearray()
    at = 0
    while at < len(code):
        block = code[at]
        if block > len(code) - at:
            raise ValueError("no COBS encoding: its last block is cut short")
        out += code[at + 1 : at + block]
        at += block
        if block != 0xFF and at < len(code):
            out.append(0)
    return bytes(out)


def encode_frame(message: Message, request_id: int) -> bytes:
    """All bytes of a message's frame, with the 0x00 at its end."""
    body = encode(message, request_id)
    return cobs_encode(body + struct.pack("<I", zlib.crc32(body))) + b"\0"


@dataclass
class FrameCounts:
    """Numbers of received frames."""

    good: int = 0
    bad_crc: int = 0
    bad_cobs: int = 0
    oversize: int = 0
    undersize: int = 0


class Framer:
    """Receives a byte stream from any point on. A damaged frame is counted and dropped."""

    def __init__(self) -> None:
        self._code = bytearray()
        self.counts = FrameCounts()

    def push(self, received: bytes) -> Sequence[bytes]:
        """The bodies that these bytes complete."""
        bodies = []
        *ends, rest = received.split(b"\0")
        for part in ends:
            self._keep(part)
            body = self._finish(bytes(self._code))
            self._code.clear()
            if body is not None:
                bodies.append(body)
        self._keep(rest)
        return bodies

    def _keep(self, part: bytes) -> None:
        self._code += part[: _MAX_CODE + 1 - len(self._code)]  # one more than fits tells that it is too long

    def _finish(self, code: bytes) -> bytes | None:
        if not code:
            return None
        if len(code) > _MAX_CODE:
            self.counts.oversize += 1
            return None
        try:
            data = cobs_decode(code)
        except ValueError:
            self.counts.bad_cobs += 1
            return None
        body, crc = data[:-_CRC_SIZE], data[-_CRC_SIZE:]
        if len(body) < HEADER_SIZE:
            self.counts.undersize += 1
        elif len(body) > MAX_BODY:
            self.counts.oversize += 1
        elif struct.pack("<I", zlib.crc32(body)) != crc:
            self.counts.bad_crc += 1
        else:
            self.counts.good += 1
            return body
        return None
