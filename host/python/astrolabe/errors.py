"""What can go wrong with a robot. Each error is one sentence that says what happened and what helps."""

from __future__ import annotations

from astrolabe.messages import ERROR_MEANINGS, FAULT_HELP, ErrorCode, Fault


class AstrolabeError(Exception):
    """All errors of this package that its caller may want to catch."""


class PortError(AstrolabeError):
    """The port cannot be opened, or no robot answers there."""


class LinkLost(AstrolabeError):
    """The robot has gone, is silent or has restarted. The request under way may or may not have been carried out."""


class RobotRefused(AstrolabeError):
    """The robot answered a request with an ErrorReply: nothing has changed.

    Attributes:
        code: why
        detail: as the code's meaning says: a parameter's id, a fault, a version; otherwise 0
    """

    def __init__(self, what: str, code: ErrorCode, detail: int, why: str = "") -> None:
        super().__init__(f"the robot refused {what}: {why or ERROR_MEANINGS[code]}")
        self.code = code
        self.detail = detail


class DriveFault(AstrolabeError):
    """The robot stopped because of a fault, or cannot be armed because one is latched.

    Attributes:
        fault: the first one
    """

    def __init__(self, what: str, fault: Fault) -> None:
        super().__init__(f"{what}: {fault.name}; {FAULT_HELP[fault]}")
        self.fault = fault


class DriveEnded(AstrolabeError):
    """Another program has stopped, paused or taken the robot, or keeps it armed."""


class NotStopped(AstrolabeError):
    """The robot did not confirm that it is at rest and disarmed: it may still be moving."""


class InvalidValue(AstrolabeError, ValueError):
    """A number, name or text that is not possible; nothing was sent."""


class DataError(AstrolabeError):
    """What the libraries say against drives, recordings and calibrations.

    Attributes:
        values: the names and values in the sentence
    """

    def __init__(self, sentence: str, values: list[str] | None = None) -> None:
        super().__init__(sentence)
        self.values = values or []
