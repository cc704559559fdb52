# Written by the program python_messages from the C++ schema; the README of this room says how.
"""The messages of the robot's protocol: what is on the wire, in integers with a declared scale."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import ClassVar

from astrolabe.codec import Field, Group, Layout, Message, Record, Request

PROTOCOL_VERSION = 5


class Mode(IntEnum):
    """What the robot is doing. In disarmed, fault and boot its bridges are open."""

    disarmed = 0
    idle = 1
    velocity = 2
    segment = 3
    stopping = 4
    fault = 5
    boot = 6
    wheels = 7
    paused = 8


class SegmentKind(IntEnum):
    """The shape of a segment."""

    line = 0
    spin = 1
    arc = 2
    stop = 3


class SegmentOutcome(IntEnum):
    """How a segment ended."""

    completed = 0
    aborted = 1


class ParameterKind(IntEnum):
    """How a parameter's raw number becomes a value."""

    binary_scaled = 0
    decimal_scaled = 1
    integer = 2
    flag = 3
    text = 4


class ResetCause(IntEnum):
    """Why the processor last started."""

    power_on = 0
    software = 1
    watchdog = 2
    fault = 3
    pin = 4
    unknown = 5


class ErrorCode(IntEnum):
    """Why a request was refused; ERROR_MEANINGS says it in words."""

    unknown_message = 0
    malformed = 1
    wrong_version = 2
    not_armed = 3
    faulted = 4
    queue_full = 5
    invalid_parameter = 6
    unknown_parameter = 7
    moving = 8
    flash_failed = 9
    out_of_range = 10
    unsupported = 11
    busy = 12
    staging_lost = 13


class Fault(IntEnum):
    """A named, latched stop; FAULT_HELP says what to check."""

    none = 0
    command_timeout = 1
    link_lost = 2
    driver = 3
    under_voltage = 4
    over_voltage = 5
    over_speed = 6
    stall = 7
    encoder = 8
    tick_overrun = 9
    parameters = 10
    flash = 11
    emergency_stop = 12
    runaway = 13
    watchdog = 14
    stop_timeout = 15
    gyro_slip = 16


class GyroState(IntEnum):
    """Whether the gyro counts, or why it does not."""

    off = 0
    absent = 1
    starting = 2
    learning = 3
    running = 4
    silent = 5
    frozen = 6
    saturated = 7
    failed = 8


class FarewellReason(IntEnum):
    """Why the program that holds the port ended a connection."""

    line_lost = 0
    reads_too_slowly = 1
    too_many = 2
    holder_ended = 3


ERROR_MEANINGS: dict[ErrorCode, str] = {
    ErrorCode.unknown_message: "no request of this protocol version has this id",
    ErrorCode.malformed: "the fields do not decode: wrong length, or a value outside its enumeration",
    ErrorCode.wrong_version: "the host's Hello named another protocol version; detail: the robot's version",
    ErrorCode.not_armed: "the sender does not drive the robot: it must arm it, or somebody has stopped or paused the robot since",
    ErrorCode.faulted: "a fault is latched; detail: the first fault",
    ErrorCode.queue_full: "the segment queue has no room: send it again after a SegmentDone",
    ErrorCode.invalid_parameter: "the value or the staged set is not valid; detail: id of the offending parameter",
    ErrorCode.unknown_parameter: "no parameter has this id or index",
    ErrorCode.moving: "the robot must be at rest for this",
    ErrorCode.flash_failed: "flash did not read back what was written; the last committed set stays in force",
    ErrorCode.out_of_range: "a value of the request lies outside what the robot can do",
    ErrorCode.unsupported: "this board cannot do it",
    ErrorCode.busy: "the robot is still starting, or an earlier request is still under way",
    ErrorCode.staging_lost: "another program has begun to change parameters meanwhile; nothing was changed",
}

FAULT_HELP: dict[Fault, str] = {
    Fault.none: "",
    Fault.command_timeout: "no velocity came for longer than the parameter command_timeout: its sender ended or hung",
    Fault.link_lost: "the host fell silent during a drive: its program ended or the cable came off",
    Fault.driver: "the motor driver reports too much current or heat: let it cool, look for a blocked wheel or a short",
    Fault.under_voltage: "the supply fell below battery_low: charge the battery",
    Fault.over_voltage: "the supply rose above battery_high: check battery and regulator",
    Fault.over_speed: "a wheel turned faster than over_speed: check encoder_polarity and motor_polarity",
    Fault.stall: "voltage on a motor and no motion: look for a blocked wheel or a loose motor or encoder lead",
    Fault.encoder: "counts that no motor can produce: check the encoder's leads",
    Fault.tick_overrun: "the control tick came late while driving: report it, the firmware should never do that",
    Fault.parameters: "the parameters that were saved last cannot be read, and older ones or the defaults are in force: load yours again, or commit these",
    Fault.flash: "the flash did not keep what was written: the last set stays in force, the part may be worn",
    Fault.emergency_stop: "an emergency stop was requested",
    Fault.runaway: "a wheel turned against its voltage: a motor or an encoder has the wrong polarity",
    Fault.watchdog: "the firmware hung or ran wild and was restarted: report it, it should never do that",
    Fault.stop_timeout: "the wheels still turned a second after their set point became zero: look for a slope or a load that the motors do not hold, a wrong polarity or gear ratio, or weak gains",
    Fault.gyro_slip: "the gyro saw a turn that the wheels did not make, and the parameter gyro_slip_stops is 1: somebody pushed the robot, it slipped, or gyro_axis names the wrong axis or sign",
}

FAREWELL_FACTS: dict[FarewellReason, str] = {
    FarewellReason.line_lost: "it was unplugged, switched off or ended",
    FarewellReason.reads_too_slowly: "this program did not read what the robot sent, so the program that holds the port has disconnected it",
    FarewellReason.too_many: "too many programs use it at once: end some of them",
    FarewellReason.holder_ended: "the program that held the port has ended",
}

POWERED_MODES = frozenset({Mode.velocity, Mode.segment, Mode.stopping, Mode.wheels})


@dataclass(frozen=True)
class PoseGroup(Record):
    """A group of Telemetry.

    Fields:
        x: 2^-40 m; base in the odom frame
        y: 2^-40 m; base in the odom frame
        theta: 2^-64 turn; heading
        turns: turns; whole turns; with theta they are the heading without wraps
    """

    LAYOUT: ClassVar[Layout] = (
        Field("x", "q"),
        Field("y", "q"),
        Field("theta", "Q"),
        Field("turns", "i"),
    )
    x: int = 0
    y: int = 0
    theta: int = 0
    turns: int = 0


@dataclass(frozen=True)
class CountsGroup(Record):
    """A group of Telemetry.

    Fields:
        left: counts; forward positive, wraps at 2^32
        right: counts; forward positive, wraps at 2^32
    """

    LAYOUT: ClassVar[Layout] = (
        Field("left", "i"),
        Field("right", "i"),
    )
    left: int = 0
    right: int = 0


@dataclass(frozen=True)
class TwistGroup(Record):
    """A group of Telemetry.

    Fields:
        v_umps: 1e-6 m/s; observed, of the robot centre
        omega_uradps: 1e-6 rad/s; observed, counter-clockwise positive
    """

    LAYOUT: ClassVar[Layout] = (
        Field("v_umps", "i"),
        Field("omega_uradps", "i"),
    )
    v_umps: int = 0
    omega_uradps: int = 0


@dataclass(frozen=True)
class WheelGroup(Record):
    """A group of Telemetry.

    Fields:
        left_umps: 1e-6 m/s; at the left wheel's rim, forward positive
        right_umps: 1e-6 m/s; at the right wheel's rim, forward positive
    """

    LAYOUT: ClassVar[Layout] = (
        Field("left_umps", "i"),
        Field("right_umps", "i"),
    )
    left_umps: int = 0
    right_umps: int = 0


@dataclass(frozen=True)
class DutyGroup(Record):
    """A group of Telemetry.

    Fields:
        left: 2^-15; fraction of the bus voltage, forward positive
        right: 2^-15; fraction of the bus voltage, forward positive
    """

    LAYOUT: ClassVar[Layout] = (
        Field("left", "h"),
        Field("right", "h"),
    )
    left: int = 0
    right: int = 0


@dataclass(frozen=True)
class BatteryGroup(Record):
    """A group of Telemetry.

    Fields:
        mv: mV; motor supply, filtered
    """

    LAYOUT: ClassVar[Layout] = (
        Field("mv", "i"),
    )
    mv: int = 0


@dataclass(frozen=True)
class StateGroup(Record):
    """A group of Telemetry.

    Fields:
        mode: what the robot is doing
        tag: of the running segment, 0 if none runs
        latched_faults: bit mask; bit n is Fault n
    """

    LAYOUT: ClassVar[Layout] = (
        Field("mode", "B", Mode),
        Field("tag", "H"),
        Field("latched_faults", "I"),
    )
    mode: Mode = Mode(0)
    tag: int = 0
    latched_faults: int = 0


@dataclass(frozen=True)
class PathGroup(Record):
    """A group of Telemetry.

    Fields:
        tag: of the running segment, 0 if none runs
        progress: 2^-15; part of the segment that has been driven
        queued: segments that wait
        cross_track_um: 1e-6 m; distance of the path to the robot's left
        heading_error_urad: 1e-6 rad; the path's heading minus the robot's
    """

    LAYOUT: ClassVar[Layout] = (
        Field("tag", "H"),
        Field("progress", "H"),
        Field("queued", "H"),
        Field("cross_track_um", "i"),
        Field("heading_error_urad", "i"),
    )
    tag: int = 0
    progress: int = 0
    queued: int = 0
    cross_track_um: int = 0
    heading_error_urad: int = 0


@dataclass(frozen=True)
class FusedGroup(Record):
    """A group of Telemetry.

    Fields:
        time_us: us; device time of this pose, at most 10 ms ago
        x: 2^-40 m; base in the odom frame, by wheels and gyro
        y: 2^-40 m; base in the odom frame, by wheels and gyro
        theta: 2^-64 turn; heading by wheels and gyro
        turns: turns; whole turns; with theta they are the heading without wraps
        rate_uradps: 1e-6 rad/s; mean yaw rate by the gyro over 10 ms, without its bias
        bias_uradps: 1e-6 rad/s; the gyro's bias
        temperature_cC: 0.01 degC; of the gyro; -32768: it does not say
        gyro: whether the gyro counts, or why it does not
        slips: turns that no wheel saw, since start; wraps
    """

    LAYOUT: ClassVar[Layout] = (
        Field("time_us", "Q"),
        Field("x", "q"),
        Field("y", "q"),
        Field("theta", "Q"),
        Field("turns", "i"),
        Field("rate_uradps", "i"),
        Field("bias_uradps", "i"),
        Field("temperature_cC", "h"),
        Field("gyro", "B", GyroState),
        Field("slips", "H"),
    )
    time_us: int = 0
    x: int = 0
    y: int = 0
    theta: int = 0
    turns: int = 0
    rate_uradps: int = 0
    bias_uradps: int = 0
    temperature_cC: int = -32768
    gyro: GyroState = GyroState(0)
    slips: int = 0


@dataclass(frozen=True)
class Ack(Message):
    """The request was carried out, or is under way."""

    ID: ClassVar[int] = 126
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class ErrorReply(Message):
    """The request was refused and has changed nothing. Layout frozen.

    Fields:
        code: why
        detail: as the code's meaning says, otherwise 0
    """

    ID: ClassVar[int] = 127
    LAYOUT: ClassVar[Layout] = (
        Field("code", "B", ErrorCode),
        Field("detail", "H"),
    )
    code: ErrorCode = ErrorCode(0)
    detail: int = 0


@dataclass(frozen=True)
class HelloReply(Message):
    """Identifies the robot. Layout frozen.

    Fields:
        protocol_version: the robot's version
        fw_major: firmware version
        fw_minor: firmware version
        fw_patch: firmware version
        unique_id: differs from every other robot's; the same at every start
        board: name of the board that the firmware was built for
        robot_name: the parameter robot_name
        parameter_count: the indices of GetParameterInfo are less than this
        tick_hz: Hz; rate of the control tick
    """

    ID: ClassVar[int] = 129
    LAYOUT: ClassVar[Layout] = (
        Field("protocol_version", "H"),
        Field("fw_major", "B"),
        Field("fw_minor", "B"),
        Field("fw_patch", "B"),
        Field("unique_id", "16s"),
        Field("board", "24t"),
        Field("robot_name", "24t"),
        Field("parameter_count", "H"),
        Field("tick_hz", "H"),
    )
    protocol_version: int = 5
    fw_major: int = 0
    fw_minor: int = 0
    fw_patch: int = 0
    unique_id: bytes = bytes(16)
    board: str = ""
    robot_name: str = ""
    parameter_count: int = 0
    tick_hz: int = 0


@dataclass(frozen=True)
class Pong(Message):
    """The robot's clock when it answered.

    Fields:
        device_time_us: us; since power-on
    """

    ID: ClassVar[int] = 130
    LAYOUT: ClassVar[Layout] = (
        Field("device_time_us", "Q"),
    )
    device_time_us: int = 0


@dataclass(frozen=True)
class Status(Message):
    """The robot's state.

    Fields:
        device_time_us: us; since power-on
        mode: what it is doing
        latched_faults: bit mask; bit n is Fault n
        queued_segments: segments that wait, without the running one
        running_tag: tag of the running segment, 0 if none runs
        battery_mv: mV; motor supply, filtered
        tick_count: ticks; control ticks since start, wraps
        tick_overruns: ticks; ticks that did not come on time
        tick_longest_us: us; longest time between two ticks since start
        rx_bad_frames: frames; damaged frames at all ports
        reset_cause: why the processor last started
        stops_by_others: Stop, Disarm and EmergencyStop of hosts at other ports, without those of a driver that ends its own drive; wraps
    """

    ID: ClassVar[int] = 131
    LAYOUT: ClassVar[Layout] = (
        Field("device_time_us", "Q"),
        Field("mode", "B", Mode),
        Field("latched_faults", "I"),
        Field("queued_segments", "H"),
        Field("running_tag", "H"),
        Field("battery_mv", "i"),
        Field("tick_count", "I"),
        Field("tick_overruns", "I"),
        Field("tick_longest_us", "I"),
        Field("rx_bad_frames", "I"),
        Field("reset_cause", "B", ResetCause),
        Field("stops_by_others", "H"),
    )
    device_time_us: int = 0
    mode: Mode = Mode(0)
    latched_faults: int = 0
    queued_segments: int = 0
    running_tag: int = 0
    battery_mv: int = 0
    tick_count: int = 0
    tick_overruns: int = 0
    tick_longest_us: int = 0
    rx_bad_frames: int = 0
    reset_cause: ResetCause = ResetCause(0)
    stops_by_others: int = 0


@dataclass(frozen=True)
class ParameterInfo(Message):
    """Everything that a host must know to show and set a parameter it has never seen.

    Fields:
        id: the parameter's name on the wire, the same in all firmware versions
        name: the parameter's name for people
        unit: of the scaled value
        kind: how a raw number becomes a value
        scale_exponent: value = raw * 2^exponent or raw * 10^exponent
        minimum: raw; least allowed
        maximum: raw; greatest allowed
        default_value: raw; factory default
        doc: one sentence
    """

    ID: ClassVar[int] = 139
    LAYOUT: ClassVar[Layout] = (
        Field("id", "H"),
        Field("name", "24t"),
        Field("unit", "8t"),
        Field("kind", "B", ParameterKind),
        Field("scale_exponent", "b"),
        Field("minimum", "i"),
        Field("maximum", "i"),
        Field("default_value", "i"),
        Field("doc", "120t"),
    )
    id: int = 0
    name: str = ""
    unit: str = ""
    kind: ParameterKind = ParameterKind(0)
    scale_exponent: int = 0
    minimum: int = 0
    maximum: int = 0
    default_value: int = 0
    doc: str = ""


@dataclass(frozen=True)
class ParameterValue(Message):
    """A parameter's value: the one in force and the one that this session has staged.

    Fields:
        id: as in ParameterInfo
        active: raw; in force; 0 for a text
        staged: raw; staged by this session, otherwise as active; 0 for a text
        active_text: in force; empty unless kind is text
        staged_text: staged by this session, otherwise as active; empty unless kind is text
    """

    ID: ClassVar[int] = 140
    LAYOUT: ClassVar[Layout] = (
        Field("id", "H"),
        Field("active", "i"),
        Field("staged", "i"),
        Field("active_text", "24t"),
        Field("staged_text", "24t"),
    )
    id: int = 0
    active: int = 0
    staged: int = 0
    active_text: str = ""
    staged_text: str = ""


@dataclass(frozen=True)
class FaultReport(Message):
    """The latched faults and the first one.

    Fields:
        latched: bit mask; bit n is Fault n
        first: the first one since faults were last cleared
        first_time_us: us; device time of the first one
        raised_count: faults raised since start
    """

    ID: ClassVar[int] = 146
    LAYOUT: ClassVar[Layout] = (
        Field("latched", "I"),
        Field("first", "B", Fault),
        Field("first_time_us", "Q"),
        Field("raised_count", "I"),
    )
    latched: int = 0
    first: Fault = Fault(0)
    first_time_us: int = 0
    raised_count: int = 0


@dataclass(frozen=True)
class FaultLogEntry(Message):
    """A fault of this start or an earlier one, and what the robot was doing.

    Fields:
        number: one more than the previous entry's, across all starts; wraps
        start: counts the starts that logged a fault, from 1 on; wraps
        device_time_us: us; when, since that start
        fault: number of a Fault, perhaps one of newer firmware
        mode: number of the Mode it came in, perhaps one of newer firmware
        battery_mv: mV; motor supply, filtered
        left_umps: 1e-6 m/s; observed, left wheel's rim
        right_umps: 1e-6 m/s; observed, right wheel's rim
        missed: faults before this one that were not logged because too many came at once
    """

    ID: ClassVar[int] = 153
    LAYOUT: ClassVar[Layout] = (
        Field("number", "I"),
        Field("start", "I"),
        Field("device_time_us", "Q"),
        Field("fault", "B"),
        Field("mode", "B"),
        Field("battery_mv", "i"),
        Field("left_umps", "i"),
        Field("right_umps", "i"),
        Field("missed", "H"),
    )
    number: int = 0
    start: int = 0
    device_time_us: int = 0
    fault: int = 0
    mode: int = 0
    battery_mv: int = 0
    left_umps: int = 0
    right_umps: int = 0
    missed: int = 0


@dataclass(frozen=True)
class PortUsers(Message):
    """Who drives through this port, and who ended the drive of the program that asks.

    Fields:
        driver_pid: whose motion requests are taken
        driver_command: its command line
        stopper_pid: who stopped the drive of the program that asks
        stopper_command: its command line
    """

    ID: ClassVar[int] = 65
    LAYOUT: ClassVar[Layout] = (
        Field("driver_pid", "I"),
        Field("driver_command", "96t"),
        Field("stopper_pid", "I"),
        Field("stopper_command", "96t"),
    )
    driver_pid: int = 0
    driver_command: str = ""
    stopper_pid: int = 0
    stopper_command: str = ""


@dataclass(frozen=True)
class Hello(Request[HelloReply]):
    """Asks the robot to identify itself; answered whatever the version. Layout frozen.

    Fields:
        protocol_version: the host's version
    """

    ID: ClassVar[int] = 1
    REPLY: ClassVar[type[Message]] = HelloReply
    LAYOUT: ClassVar[Layout] = (
        Field("protocol_version", "H"),
    )
    protocol_version: int = 5


@dataclass(frozen=True)
class Ping(Request[Pong]):
    """Reads the clock and keeps a drive alive."""

    ID: ClassVar[int] = 2
    REPLY: ClassVar[type[Message]] = Pong
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class GetStatus(Request[Status]):
    """Asks for the robot's state."""

    ID: ClassVar[int] = 3
    REPLY: ClassVar[type[Message]] = Status
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class Arm(Request[Ack]):
    """Lets the sender drive the robot; refused while a fault is latched or another host drives."""

    ID: ClassVar[int] = 4
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class Disarm(Request[Ack]):
    """Opens the bridges at once and empties the queue."""

    ID: ClassVar[int] = 5
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class Stop(Request[Ack]):
    """Ramps to rest and empties the queue. The robot stays armed, but moves for nobody until an Arm."""

    ID: ClassVar[int] = 6
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class EmergencyStop(Request[Ack]):
    """Latches the fault emergency_stop: zero duty at once."""

    ID: ClassVar[int] = 7
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class Velocity(Request[Ack]):
    """Drives at this velocity until the next motion request or the command timeout.

    Fields:
        v_umps: 1e-6 m/s; of the robot centre, forward positive
        omega_uradps: 1e-6 rad/s; counter-clockwise positive
    """

    ID: ClassVar[int] = 8
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = (
        Field("v_umps", "i"),
        Field("omega_uradps", "i"),
    )
    v_umps: int = 0
    omega_uradps: int = 0


@dataclass(frozen=True)
class AddSegment(Request[Ack]):
    """Appends a motion from rest to rest to the queue; SegmentDone reports its end under the same tag.

    Fields:
        kind: shape
        tag: the host's own number for it
        length_nm: 1e-9 m; signed path length of the robot centre; 0 for a spin or a stop
        angle: 2^-32 turn; signed change of heading; 0 for a line or a stop
        speed_umps: 1e-6 m/s; greatest speed; 0: the robot's limit
        yaw_rate_uradps: 1e-6 rad/s; greatest yaw rate; 0: the robot's limit
        dwell_ms: ms; time to wait, for a stop; 0 for all others
    """

    ID: ClassVar[int] = 9
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = (
        Field("kind", "B", SegmentKind),
        Field("tag", "H"),
        Field("length_nm", "q"),
        Field("angle", "q"),
        Field("speed_umps", "i"),
        Field("yaw_rate_uradps", "i"),
        Field("dwell_ms", "I"),
    )
    kind: SegmentKind = SegmentKind(0)
    tag: int = 0
    length_nm: int = 0
    angle: int = 0
    speed_umps: int = 0
    yaw_rate_uradps: int = 0
    dwell_ms: int = 0


@dataclass(frozen=True)
class SetPose(Request[Ack]):
    """The odometry continues from this pose of the base in the odom frame.

    Fields:
        x: 2^-40 m
        y: 2^-40 m
        theta: 2^-64 turn; heading; the count of whole turns becomes 0
    """

    ID: ClassVar[int] = 10
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = (
        Field("x", "q"),
        Field("y", "q"),
        Field("theta", "Q"),
    )
    x: int = 0
    y: int = 0
    theta: int = 0


@dataclass(frozen=True)
class GetParameterInfo(Request[ParameterInfo]):
    """Asks for one row of the parameter table.

    Fields:
        index: 0 to HelloReply.parameter_count - 1
    """

    ID: ClassVar[int] = 11
    REPLY: ClassVar[type[Message]] = ParameterInfo
    LAYOUT: ClassVar[Layout] = (
        Field("index", "H"),
    )
    index: int = 0


@dataclass(frozen=True)
class GetParameter(Request[ParameterValue]):
    """Asks for a parameter's value.

    Fields:
        id: as in ParameterInfo
    """

    ID: ClassVar[int] = 12
    REPLY: ClassVar[type[Message]] = ParameterValue
    LAYOUT: ClassVar[Layout] = (
        Field("id", "H"),
    )
    id: int = 0


@dataclass(frozen=True)
class StageParameter(Request[Ack]):
    """Stages a value in the area that this session has opened; nothing changes before CommitParameters.

    Fields:
        id: as in ParameterInfo
        value: raw; 0 for a text
        text: empty unless kind is text
    """

    ID: ClassVar[int] = 13
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = (
        Field("id", "H"),
        Field("value", "i"),
        Field("text", "24t"),
    )
    id: int = 0
    value: int = 0
    text: str = ""


@dataclass(frozen=True)
class CommitParameters(Request[Ack]):
    """Validates the staged set as a whole and puts it in force. Writes the values that were staged in this area to flash: all of them or none."""

    ID: ClassVar[int] = 14
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class RevertParameters(Request[Ack]):
    """Opens the staging area for this session, with the values in force."""

    ID: ClassVar[int] = 15
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class DefaultParameters(Request[Ack]):
    """Opens the staging area for this session, with the factory defaults."""

    ID: ClassVar[int] = 16
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class SetTelemetry(Request[Ack]):
    """Chooses the groups of Telemetry for this port and how often it comes.

    Fields:
        period_ms: ms; 0: off
        fields: bit mask; as in Telemetry
    """

    ID: ClassVar[int] = 17
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = (
        Field("period_ms", "H"),
        Field("fields", "I"),
    )
    period_ms: int = 0
    fields: int = 0


@dataclass(frozen=True)
class GetFaults(Request[FaultReport]):
    """Asks for the latched faults."""

    ID: ClassVar[int] = 18
    REPLY: ClassVar[type[Message]] = FaultReport
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class ClearFaults(Request[Ack]):
    """Releases all latched faults; the robot stays disarmed."""

    ID: ClassVar[int] = 19
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class Reboot(Request[Ack]):
    """Opens the bridges, acknowledges, and restarts."""

    ID: ClassVar[int] = 20
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class EnterBootloader(Request[Ack]):
    """Opens the bridges, acknowledges, and waits for new firmware."""

    ID: ClassVar[int] = 21
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class WheelVoltage(Request[Ack]):
    """Puts voltages on the motors in open loop, until the next motion request or the command timeout.

    Fields:
        left_mv: mV; left motor, forward positive; limited by the supply
        right_mv: mV; right motor, forward positive; limited by the supply
    """

    ID: ClassVar[int] = 22
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = (
        Field("left_mv", "i"),
        Field("right_mv", "i"),
    )
    left_mv: int = 0
    right_mv: int = 0


@dataclass(frozen=True)
class Pause(Request[Ack]):
    """Ramps to rest: on a path, where its rest waits for Resume. Until then no velocity moves the robot."""

    ID: ClassVar[int] = 23
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class Resume(Request[Ack]):
    """Ends a Pause and continues the path; refused to the driver if somebody else has paused."""

    ID: ClassVar[int] = 24
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class GetFaultLog(Request[FaultLogEntry]):
    """Asks for one entry of the fault log; out_of_range if there is none. A fault is logged once the robot has stopped.

    Fields:
        index: 0 is the newest
    """

    ID: ClassVar[int] = 25
    REPLY: ClassVar[type[Message]] = FaultLogEntry
    LAYOUT: ClassVar[Layout] = (
        Field("index", "H"),
    )
    index: int = 0


@dataclass(frozen=True)
class ApplyParameters(Request[Ack]):
    """Puts the staged set in force until the next restart, without making it part of the next commit. While the robot drives only gains may differ."""

    ID: ClassVar[int] = 26
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class Rest(Request[Ack]):
    """Ramps to rest and empties the queue; the sender, who must be driving, may go on without an Arm."""

    ID: ClassVar[int] = 27
    REPLY: ClassVar[type[Message]] = Ack
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class GetPortUsers(Request[PortUsers]):
    """Asks the program that holds the port who else is there."""

    ID: ClassVar[int] = 64
    REPLY: ClassVar[type[Message]] = PortUsers
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class Telemetry(Message):
    """One sample. Groups whose bit is not set in `fields` are not on the wire.

    Fields:
        device_time_us: us; time of the tick that all groups belong to
        fields: bit mask; which groups follow
        pose: odometry
        counts: encoder counts since start
        twist: velocity of the base
        wheel_speed: observed wheel speeds
        setpoint: commanded wheel speeds
        duty: commanded duty
        battery: supply
        state: mode, segment and faults
        path: how the path is followed
        fused: the pose by wheels and gyro; the odometry's without a gyro
    """

    ID: ClassVar[int] = 192
    LAYOUT: ClassVar[Layout] = (
        Field("device_time_us", "Q"),
        Field("fields", "I"),
        Group("pose", 0, PoseGroup),
        Group("counts", 1, CountsGroup),
        Group("twist", 2, TwistGroup),
        Group("wheel_speed", 3, WheelGroup),
        Group("setpoint", 4, WheelGroup),
        Group("duty", 5, DutyGroup),
        Group("battery", 6, BatteryGroup),
        Group("state", 7, StateGroup),
        Group("path", 8, PathGroup),
        Group("fused", 9, FusedGroup),
    )
    device_time_us: int = 0
    fields: int = 0
    pose: PoseGroup = PoseGroup()
    counts: CountsGroup = CountsGroup()
    twist: TwistGroup = TwistGroup()
    wheel_speed: WheelGroup = WheelGroup()
    setpoint: WheelGroup = WheelGroup()
    duty: DutyGroup = DutyGroup()
    battery: BatteryGroup = BatteryGroup()
    state: StateGroup = StateGroup()
    path: PathGroup = PathGroup()
    fused: FusedGroup = FusedGroup()


@dataclass(frozen=True)
class SegmentDone(Message):
    """A segment has left the queue.

    Fields:
        tag: as in AddSegment
        outcome: how it ended
        device_time_us: us; when
    """

    ID: ClassVar[int] = 193
    LAYOUT: ClassVar[Layout] = (
        Field("tag", "H"),
        Field("outcome", "B", SegmentOutcome),
        Field("device_time_us", "Q"),
    )
    tag: int = 0
    outcome: SegmentOutcome = SegmentOutcome(0)
    device_time_us: int = 0


@dataclass(frozen=True)
class FaultRaised(Message):
    """A fault was latched.

    Fields:
        fault: which
        device_time_us: us; when
    """

    ID: ClassVar[int] = 194
    LAYOUT: ClassVar[Layout] = (
        Field("fault", "B", Fault),
        Field("device_time_us", "Q"),
    )
    fault: Fault = Fault(0)
    device_time_us: int = 0


@dataclass(frozen=True)
class Booted(Message):
    """The firmware has started; earlier requests are forgotten.

    Fields:
        reset_cause: why
    """

    ID: ClassVar[int] = 195
    LAYOUT: ClassVar[Layout] = (
        Field("reset_cause", "B", ResetCause),
    )
    reset_cause: ResetCause = ResetCause(0)


@dataclass(frozen=True)
class SegmentStarted(Message):
    """A segment has begun, or continues after a Pause.

    Fields:
        tag: as in AddSegment
        device_time_us: us; when
    """

    ID: ClassVar[int] = 196
    LAYOUT: ClassVar[Layout] = (
        Field("tag", "H"),
        Field("device_time_us", "Q"),
    )
    tag: int = 0
    device_time_us: int = 0


@dataclass(frozen=True)
class EventsMissed(Message):
    """Events before the next one were dropped because this port did not take them in time.

    Fields:
        count: how many since the last EventsMissed; 65535: that many or more
    """

    ID: ClassVar[int] = 197
    LAYOUT: ClassVar[Layout] = (
        Field("count", "H"),
    )
    count: int = 0


@dataclass(frozen=True)
class SlipFound(Message):
    """The gyro has noticed that the robot turned without its wheels: a kick, or a wheel that slipped.

    Fields:
        device_time_us: us; when
        turn_100urad: 1e-4 rad; how far until then, counter-clockwise positive; it may go on
    """

    ID: ClassVar[int] = 198
    LAYOUT: ClassVar[Layout] = (
        Field("device_time_us", "Q"),
        Field("turn_100urad", "h"),
    )
    device_time_us: int = 0
    turn_100urad: int = 0


@dataclass(frozen=True)
class Welcome(Message):
    """The program that holds the port serves this connection."""

    ID: ClassVar[int] = 66
    LAYOUT: ClassVar[Layout] = ()


@dataclass(frozen=True)
class Farewell(Message):
    """The connection ends here.

    Fields:
        reason: why
    """

    ID: ClassVar[int] = 67
    LAYOUT: ClassVar[Layout] = (
        Field("reason", "B", FarewellReason),
    )
    reason: FarewellReason = FarewellReason(0)


MESSAGES: tuple[type[Message], ...] = (
    Ack,
    ErrorReply,
    HelloReply,
    Pong,
    Status,
    ParameterInfo,
    ParameterValue,
    FaultReport,
    FaultLogEntry,
    PortUsers,
    Hello,
    Ping,
    GetStatus,
    Arm,
    Disarm,
    Stop,
    EmergencyStop,
    Velocity,
    AddSegment,
    SetPose,
    GetParameterInfo,
    GetParameter,
    StageParameter,
    CommitParameters,
    RevertParameters,
    DefaultParameters,
    SetTelemetry,
    GetFaults,
    ClearFaults,
    Reboot,
    EnterBootloader,
    WheelVoltage,
    Pause,
    Resume,
    GetFaultLog,
    ApplyParameters,
    Rest,
    GetPortUsers,
    Telemetry,
    SegmentDone,
    FaultRaised,
    Booted,
    SegmentStarted,
    EventsMissed,
    SlipFound,
    Welcome,
    Farewell,
)
