"""An armed robot for the duration of a `with` block."""

from __future__ import annotations

import time
from contextlib import ExitStack
from dataclasses import replace
from types import TracebackType
from typing import Callable, Iterable, NoReturn

from astrolabe import messages
from astrolabe.client import Client
from astrolabe.codec import Message, Request
from astrolabe.errors import DriveEnded, DriveFault, LinkLost, NotStopped, RobotRefused
from astrolabe.messages import POWERED_MODES, AddSegment, ErrorCode, Fault, Mode, SegmentOutcome
from astrolabe.paths import scaled

_LEFT_BEHIND = 1 << Fault.command_timeout | 1 << Fault.link_lost  # what a program leaves latched that ends while it drives
_POLL_S = 0.05
_EVENT_LOST_S = 1.0  # by then an event must have been lost, or the segment is long
_BECOMES_FREE_S = 4.0  # an armed robot whose program has gone notices it within 2.5 s
_LONGEST_RAMP_S = 60.0  # the robot ends every ramp by a deadline of its own, which is sooner
_REPEAT_VELOCITY_US = 50_000  # a quarter of the usual command time-out
_MOST_SEGMENTS = 0xFFFF


def first_fault(mask: int) -> Fault:
    """The first of a mask of latched faults; Fault.none if it is 0."""
    return next((fault for fault in Fault if fault != Fault.none and mask >> fault & 1), Fault.none)


class Drive:
    """Arms the robot when its block begins; brings it to rest and disarms it when the block ends, however it ends.

    Inside the block somebody has to be at work for the robot: run(), hold_velocity(), wait() and stop() give it the signs
    of life that it needs. A program that computes or sleeps longer than the robot's command time-out (0.2 s) while the robot
    moves stops it with the fault command_timeout or link_lost.

    Raises, at any call:
        DriveFault: a fault was latched, and the robot has stopped by itself.
        DriveEnded: another program has stopped, paused or taken the robot.
        LinkLost: the robot has gone or restarted.
    and at the end of the block
        NotStopped: the robot did not confirm that it is at rest and disarmed.
    A Ctrl-C while the robot ramps down disarms it at once.
    """

    def __init__(self, client: Client) -> None:
        self._client = client
        self._listening = ExitStack()
        self._fault: Fault | None = None
        self._booted = self._disarmed = False
        self._accepted = self._done = self._aborted = 0

    def __enter__(self) -> Drive:
        with ExitStack() as listening:
            listening.enter_context(self._client.listening(messages.SegmentDone, self._note_done))
            listening.enter_context(self._client.listening(messages.FaultRaised, self._note_fault))
            listening.enter_context(self._client.listening(messages.Booted, self._note_boot))
            self._arm()
            self._listening = listening.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with self._listening:
            try:
                self._rest_and_disarm()
            except BaseException as why:
                if self._disarmed and not isinstance(why, Exception):
                    raise
                reason = str(why) or type(why).__name__
                raise NotStopped(
                    f"the robot did not confirm that it stopped, and may still be moving: {reason}"
                ) from (error or why)
        if self._fault is not None and error is None:
            self._fail(self._fault)

    def run(self, segments: Iterable[AddSegment]) -> None:
        """Drives the segments one after the other and returns when the last has ended."""
        path = list(segments)
        if len(path) > _MOST_SEGMENTS:
            raise ValueError("a path of more than 65535 segments is not possible")
        self._accepted = self._done = self._aborted = 0
        for tag, segment in enumerate(path, start=1):
            while not self._add(replace(segment, tag=tag)):
                self._wait_for_progress()
            self._accepted = tag
        while self._done < self._accepted:
            self._wait_for_progress()
        self._check()

    def set_velocity(self, v_mps: float, omega_radps: float) -> None:
        """Sends one velocity, which holds until the robot's command time-out: for a loop that sends the next one in time.

        Args:
            v_mps: of the robot centre in m/s, forward positive
            omega_radps: yaw rate in rad/s, counter-clockwise positive
        """
        self._check()
        self._command(
            messages.Velocity(
                v_umps=scaled(v_mps, 1e6, 32, "a speed in m/s"),
                omega_uradps=scaled(omega_radps, 1e6, 32, "a yaw rate in rad/s"),
            )
        )

    def hold_velocity(self, v_mps: float, omega_radps: float, seconds: float) -> None:
        """Drives at this velocity for so many seconds of the robot's clock, then comes to rest. Units as in set_velocity()."""
        end_us = self._robot_time_us() + round(seconds * 1e6)
        while (now_us := self._robot_time_us()) < end_us:
            self.set_velocity(v_mps, omega_radps)
            next_us = min(now_us + _REPEAT_VELOCITY_US, end_us)
            self._pump_until(lambda: self._client.robot_time_us >= next_us, _REPEAT_VELOCITY_US * 1e-6)
        self.stop()

    def wait(self, seconds: float) -> None:
        """Waits, with signs of life for the robot; a velocity is not repeated."""
        self._pump_until(lambda: False, seconds)

    def stop(self) -> None:
        """Ramps to rest and empties the queue; returns when the robot is at rest. More motion may follow."""
        self._check()
        self._command(messages.Rest())
        self._wait_until_power_off()
        self._aborted = 0  # this stop caused the abort

    def _pump_until(self, done: Callable[[], bool], timeout_s: float) -> bool:
        happened = self._client.pump_until(lambda: done() or self._fault is not None or self._booted, timeout_s)
        self._check()
        return happened

    def _robot_time_us(self) -> int:
        return self._client.request(messages.Ping()).device_time_us

    def _note_done(self, done: messages.SegmentDone) -> None:
        self._done = max(self._done, done.tag)
        if done.outcome == SegmentOutcome.aborted and self._aborted == 0:
            self._aborted = done.tag

    def _note_fault(self, raised: messages.FaultRaised) -> None:
        self._fault = self._fault or raised.fault

    def _note_boot(self, _: messages.Booted) -> None:
        self._booted = True

    def _arm(self) -> None:
        """A program that was killed leaves an armed robot behind, until the robot's time-out ends that."""
        deadline = time.monotonic() + _BECOMES_FREE_S
        while self._status_unless_stopped().mode not in (Mode.disarmed, Mode.fault):
            if time.monotonic() >= deadline:
                raise DriveEnded("the robot is armed for another program: end that, or stop the robot")
            self._client.pump(_POLL_S)
        if self._require_no_other_fault() != 0:
            self._wait_until_power_off()
            self._require_no_other_fault()  # another may have come while the robot ramped down
            self._client.request(messages.ClearFaults())
        self._fault = None
        self._disarmed = False
        self._status_unless_stopped()  # checked last, directly before Arm
        try:
            self._command(messages.Arm())
        except Exception:
            raise  # refused, or the robot cannot be reached
        except BaseException:  # a Ctrl-C before the reply: the robot may be armed
            self._disarm()
            raise

    def _status_unless_stopped(self) -> messages.Status:
        """A stop between two drives of this program also holds for the next one."""
        status = self._client.request(messages.GetStatus())
        if self._client.learns_of_stop(status):
            raise DriveEnded(
                "another program has stopped the robot since this one drove it last: start again once it may drive"
            )
        return status

    def _require_no_other_fault(self) -> int:
        """The latched faults, all of which an earlier drive left behind; a person has to clear any other."""
        latched = self._client.request(messages.GetFaults()).latched
        if latched & ~_LEFT_BEHIND:
            raise DriveFault("the robot is not armed because of a latched fault", first_fault(latched & ~_LEFT_BEHIND))
        return latched

    def _add(self, segment: AddSegment) -> bool:
        self._check()
        try:
            self._command(segment)
        except RobotRefused as refused:
            if refused.code != ErrorCode.queue_full:
                raise
            return False
        return True

    def _wait_for_progress(self) -> None:
        before = self._done
        if self._pump_until(lambda: self._done != before, _EVENT_LOST_S):
            return
        status = self._client.request(messages.GetStatus())
        if status.latched_faults:
            self._fail(first_fault(status.latched_faults))
        if status.mode == Mode.disarmed:
            self._fail_ended("disarmed")
        if status.mode == Mode.idle and status.queued_segments == 0:
            self._command(messages.Rest())  # refused if somebody has stopped the robot
            self._done = self._accepted
        self._check()

    def _check(self) -> None:
        if self._fault is not None:
            self._fail(self._fault)
        if self._booted:
            raise LinkLost(f"the robot at {self._client.name} has restarted: the drive is lost")
        if self._aborted:
            self._fail_ended("stopped")

    def _command(self, message: Request[Message]) -> None:
        try:
            self._client.request(message)
        except RobotRefused as refused:
            if refused.code == ErrorCode.faulted:
                self._fail(Fault(refused.detail))
            if refused.code == ErrorCode.not_armed:
                paused = self._client.request(messages.GetStatus()).mode == Mode.paused
                self._fail_ended("paused" if paused else "stopped")
            raise

    def _fail(self, fault: Fault) -> NoReturn:
        raise DriveFault("the robot stopped by itself", fault)

    def _fail_ended(self, done_to_robot: str) -> NoReturn:
        """The reason may arrive after the end: after a fault the robot reports the aborted segment first."""
        self._client.learns_of_stop(self._client.request(messages.GetStatus()))  # the error below reports the stop
        report = self._client.request(messages.GetFaults())
        if report.latched:
            self._fail(report.first if report.first != Fault.none else first_fault(report.latched))
        raise DriveEnded(f"the drive ended early: another program {done_to_robot} the robot")

    def _wait_until_power_off(self) -> None:
        deadline = time.monotonic() + _LONGEST_RAMP_S
        while self._client.request(messages.GetStatus()).mode in POWERED_MODES:
            if time.monotonic() >= deadline:
                self._client.request(messages.Disarm())
                raise DriveEnded("the robot did not come to rest and was disarmed: its motors are off, but it may roll on")
            self._client.pump(_POLL_S)

    def _rest_and_disarm(self) -> None:
        """A robot that does not come to rest by its ramp is disarmed anyway, which opens its bridges."""
        try:
            self._client.request(messages.Stop())
            self._wait_until_power_off()
        except LinkLost:
            raise  # it cannot be disarmed either
        except BaseException:
            self._disarm()
            raise
        self._disarm()

    def _disarm(self) -> None:
        """A Ctrl-C before the reply is raised after a second request."""
        try:
            self._client.request(messages.Disarm())
        except Exception:
            raise
        except BaseException:
            self._client.request(messages.Disarm())
            self._disarmed = True
            raise
        self._disarmed = True
