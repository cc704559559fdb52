"""The codec of the package by the vectors that the C++ codec has written."""

import json
import pathlib
import unittest
from typing import Any

from astrolabe import codec, messages
from astrolabe.codec import DecodeError, Field, Framer, Message, Record

VECTORS = json.loads((pathlib.Path(__file__).parent / "vectors.json").read_text())
KINDS = {kind.__name__: kind for kind in messages.MESSAGES}


def fields_of(record: Record) -> dict[str, Any]:
    """As the vectors write them: bytes in hexadecimal, only those groups that are on the wire."""
    values: dict[str, Any] = {}
    for entry in record.LAYOUT:
        value = getattr(record, entry.name)
        if isinstance(entry, Field):
            values[entry.name] = value.hex() if isinstance(value, bytes) else value
        elif getattr(record, "fields") >> entry.bit & 1:
            values[entry.name] = fields_of(value)
    return values


class Codec(unittest.TestCase):
    def test_each_message_of_the_schema_has_vectors(self) -> None:
        self.assertEqual({vector["message"] for vector in VECTORS["messages"]}, set(KINDS))
        self.assertEqual(VECTORS["protocol_version"], messages.PROTOCOL_VERSION)

    def test_bodies_decode_to_their_fields_and_encode_to_the_same_bytes(self) -> None:
        for vector in VECTORS["messages"]:
            with self.subTest(vector=vector):
                kind: type[Message] = KINDS[vector["message"]]
                body = bytes.fromhex(vector["body"])
                message = codec.decode(kind, body)
                self.assertEqual(fields_of(message), vector["fields"])
                self.assertEqual(codec.header(body), (kind.ID, vector["request_id"]))
                self.assertEqual(codec.encode(message, vector["request_id"]), body)
                self.assertEqual(codec.encode_frame(message, vector["request_id"]).hex(), vector["frame"])

    def test_damaged_bodies_are_refused_for_the_same_reason(self) -> None:
        for refused in VECTORS["refused"]:
            with self.subTest(refused=refused):
                with self.assertRaises(DecodeError) as raised:
                    codec.decode(KINDS[refused["message"]], bytes.fromhex(refused["body"]))
                self.assertEqual(raised.exception.problem.name, refused["error"])

    def test_streams_give_the_same_bodies_and_counts_whole_and_byte_by_byte(self) -> None:
        for stream in VECTORS["streams"]:
            received = bytes.fromhex(stream["bytes"])
            for size in (len(received), 1):
                with self.subTest(what=stream["what"], size=size):
                    framer = Framer()
                    bodies: list[str] = []
                    for at in range(0, len(received), size):
                        bodies.extend(body.hex() for body in framer.push(received[at : at + size]))
                    self.assertEqual(bodies, stream["bodies"])
                    self.assertEqual(vars(framer.counts), stream["counts"])

    def test_cobs_gives_back_what_it_was_given_around_the_size_of_a_block(self) -> None:
        for size in (0, 1, 253, 254, 255, 508, 509):
            for data in (bytes(size), b"\x01" * size, b"\x01" * size + b"\0", b"\0" + b"\x01" * size):
                code = codec.cobs_encode(data)
                self.assertNotIn(0, code)
                self.assertEqual(codec.cobs_decode(code), data)

    def test_a_value_that_its_field_cannot_hold_is_refused_by_name(self) -> None:
        with self.assertRaisesRegex(ValueError, "v_umps"):
            codec.encode(messages.Velocity(v_umps=2**31), 1)
        with self.assertRaisesRegex(ValueError, "text = .* has 25 bytes; at most 24"):
            codec.encode(messages.StageParameter(text="x" * 25), 1)


if __name__ == "__main__":
    unittest.main()
