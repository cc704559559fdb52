"""Robots for the tests: simulated and emulated ones at a pty, and the same behind TCP."""

import os
import select
import socket
import subprocess
import tempfile
import threading
from contextlib import contextmanager
from typing import ContextManager, Iterator, Sequence

PROGRAM = os.environ["ASTROLABE_PROGRAM"]


@contextmanager
def served(words: Sequence[str]) -> Iterator[str]:
    """The pty of a robot that this program serves, once it is ready; the program ends with the block."""
    with tempfile.TemporaryDirectory() as folder:
        pty = os.path.join(folder, "robot")
        with running([*words, "--pty", pty], until="next: "):
            yield pty


def simulated(*options: str) -> ContextManager[str]:
    """As fast as its host keeps up with it, unless there are other options."""
    return served([PROGRAM, "sim", *(options or ["--fast"])])


@contextmanager
def running(words: Sequence[str], until: str) -> Iterator[subprocess.Popen[str]]:
    """A program that has printed a line with `until` in it; what it prints later is read, too, and dropped."""
    program = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert program.stdout is not None
    said = ""
    for line in program.stdout:
        said += line
        if until in line:
            break
    else:
        raise RuntimeError(f"{words[0]} has ended with {program.wait()}: {said}")
    reader = threading.Thread(target=program.stdout.read)
    reader.start()
    try:
        yield program
    finally:
        program.kill()
        program.wait()
        reader.join()
        program.stdout.close()


@contextmanager
def behind_tcp(pty: str) -> Iterator[str]:
    """The address tcp:HOST:PORT at which the robot of a pty answers its first caller."""
    ended_here, ended_there = socket.socketpair()
    with socket.create_server(("127.0.0.1", 0)) as server:

        def relay() -> None:
            line = os.open(pty, os.O_RDWR | os.O_NOCTTY)
            caller, _ = server.accept()
            with caller:
                while True:
                    ready, _, _ = select.select([line, caller, ended_there], [], [])
                    if ended_there in ready:
                        break
                    if line in ready:
                        caller.sendall(os.read(line, 4096))
                    if caller in ready:
                        received = caller.recv(4096)
                        if not received:
                            break
                        os.write(line, received)
            os.close(line)

        thread = threading.Thread(target=relay)
        thread.start()
        try:
            yield f"tcp:localhost:{server.getsockname()[1]}"
        finally:
            ended_here.send(b"x")
            thread.join()
            ended_here.close()
            ended_there.close()
