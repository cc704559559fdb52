"""The client of the package against a line that answers as a test wants."""

import unittest
from typing import Callable

from astrolabe import messages
from astrolabe.client import Client
from astrolabe.codec import Framer, Message, encode_frame, header
from astrolabe.errors import AstrolabeError, LinkLost
from astrolabe.messages import ErrorReply, HelloReply, Pong


class CutReply(Message):
    """A reply of another firmware: the check sum is right, and the last field is missing."""

    LAYOUT = ()

    def __init__(self, kind: type[Message]) -> None:
        self.ID = kind.ID  # type: ignore[misc]


class AnsweringLine:
    """Answers each request at once."""

    name = "a test"

    def __init__(self, answer: Callable[[int], Message]) -> None:
        self._answer = answer  # of the id of a message
        self._requests = Framer()
        self._answers = b""

    def write(self, data: bytes) -> None:
        for body in self._requests.push(data):
            message_id, request_id = header(body)
            self._answers += encode_frame(self._answer(message_id), request_id)

    def read(self, timeout_s: float) -> bytes:
        answers, self._answers = self._answers, b""
        return answers

    def close(self) -> None:
        pass


class RepliesThatDoNotDecode(unittest.TestCase):
    def assert_not_understood(self, call: Callable[[], object]) -> None:
        with self.assertRaisesRegex(AstrolabeError, "cannot be understood") as raised:
            call()
        self.assertNotIsInstance(raised.exception, LinkLost)  # the robot is there: nobody need look for a cable

    def test_a_reply_of_another_firmware_is_not_a_lost_link(self) -> None:
        for kind in (messages.Status, ErrorReply):
            client = Client(AnsweringLine(lambda _: CutReply(kind)))
            self.assert_not_understood(lambda: client.request(messages.GetStatus()))

    def test_the_same_of_a_pong(self) -> None:
        client = Client(AnsweringLine(lambda _: CutReply(Pong)))
        self.assert_not_understood(lambda: client.request(messages.Ping()))

    def test_the_same_of_the_answers_to_the_handshake(self) -> None:
        for kind in (HelloReply, ErrorReply):
            self.assert_not_understood(Client(AnsweringLine(lambda _: CutReply(kind))).connect)

    def test_a_pong_that_does_not_decode_is_no_sign_of_life(self) -> None:
        client = Client(AnsweringLine(lambda _: CutReply(Pong)))
        with self.assertRaisesRegex(LinkLost, "does not answer any more"):
            client.pump(60)


if __name__ == "__main__":
    unittest.main()
