"""The robot's own parameter table: values in their units, and changes that are whole or not at all."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Iterator, Mapping, Union

from astrolabe import messages
from astrolabe.client import Client
from astrolabe.errors import AstrolabeError, InvalidValue, RobotRefused
from astrolabe.messages import POWERED_MODES, ErrorCode, ParameterKind

Value = Union[float, str]
_MOST_PARAMETERS = 512  # many times the present number
_TEXT_BYTES = 24


@dataclass(frozen=True)
class Parameter:
    """One row of the table.

    Attributes:
        name, unit, doc: as the robot says them
        value: in force, in `unit` or as text; exactly what the robot calculates with
        minimum, maximum, default: in `unit`; None of a text
    """

    info: messages.ParameterInfo
    held: messages.ParameterValue

    @property
    def name(self) -> str:
        return self.info.name

    @property
    def unit(self) -> str:
        return self.info.unit

    @property
    def doc(self) -> str:
        return self.info.doc

    @property
    def is_text(self) -> bool:
        return self.info.kind == ParameterKind.text

    @property
    def value(self) -> Value:
        return self.held.active_text if self.is_text else self._real(self.held.active)

    @property
    def minimum(self) -> float | None:
        return None if self.is_text else self._real(self.info.minimum)

    @property
    def maximum(self) -> float | None:
        return None if self.is_text else self._real(self.info.maximum)

    @property
    def default(self) -> float | None:
        return None if self.is_text else self._real(self.info.default_value)

    def __str__(self) -> str:
        if self.is_text:
            return f"{self.name} = '{self.value}'"
        return f"{self.name} = {self._shortest(self.held.active)} {self.unit}".rstrip()

    def stage(self, value: Value) -> messages.StageParameter:
        """The request that stages this value. Raises InvalidValue with the limits."""
        if self.is_text:
            return messages.StageParameter(id=self.info.id, text=self._text(value))
        if isinstance(value, str):
            raise InvalidValue(f"{self.name} takes a number, not the text '{value}'")
        return messages.StageParameter(id=self.info.id, value=self._raw(value))

    def _text(self, value: Value) -> str:
        if not isinstance(value, str):
            raise InvalidValue(f"{self.name} takes a text, not the number {value}")
        size = len(value.encode())
        if not self.info.minimum <= size <= min(self.info.maximum, _TEXT_BYTES):
            raise InvalidValue(
                f"{self.name} = '{value}' has {size} bytes; possible are {self.info.minimum} to {self.info.maximum}"
            )
        if not value.isprintable():
            raise InvalidValue(f"{self.name} takes plain text without control characters")
        return value

    def _raw(self, value: float) -> int:
        whole = self.info.kind in (ParameterKind.integer, ParameterKind.flag)
        if not math.isfinite(value):
            raise InvalidValue(f"{self.name} = {value} is not a number")
        if whole and value != int(value):
            raise InvalidValue(f"{self.name} = {value} is not possible: it takes whole numbers")
        steps = self._steps(value)
        if not self.info.minimum <= steps <= self.info.maximum:
            limits = f"{self._shortest(self.info.minimum)} to {self._shortest(self.info.maximum)} {self.unit}"
            raise InvalidValue(f"{self.name} = {value} is out of range: {limits.rstrip()}")
        return steps

    def _steps(self, value: float) -> int:
        exponent = self.info.scale_exponent
        if self.info.kind == ParameterKind.binary_scaled:
            steps = math.ldexp(value, -exponent)
        elif self.info.kind == ParameterKind.decimal_scaled:
            steps = value * 10.0**-exponent if exponent < 0 else value / 10.0**exponent
        else:
            steps = value
        return math.floor(steps + 0.5) if steps >= 0 else math.ceil(steps - 0.5)

    def _real(self, raw: int) -> float:
        exponent = self.info.scale_exponent
        if self.info.kind == ParameterKind.binary_scaled:
            return math.ldexp(raw, exponent)
        if self.info.kind == ParameterKind.decimal_scaled:
            return raw / 10.0**-exponent if exponent < 0 else raw * 10.0**exponent
        return float(raw)

    def _shortest(self, raw: int) -> str:
        """The fewest digits that the robot stores as this raw value."""
        exact = self._real(raw)
        for digits in range(1, 17):
            text = f"{exact:.{digits}g}"
            if self._steps(float(text)) == raw:
                return f"{float(text):g}" if float(f"{float(text):g}") == float(text) else text
        return repr(exact)


class Parameters(Mapping[str, Parameter]):
    """The table of one robot, by name; read when it is made and after each change."""

    def __init__(self, client: Client) -> None:
        self._client = client
        count = client.robot.parameter_count
        if count > _MOST_PARAMETERS:
            raise AstrolabeError(
                f"the robot at {client.name} says that it has {count} parameters, more than {_MOST_PARAMETERS}: "
                "its firmware is damaged or not Astrolabe's"
            )
        infos = [client.request(messages.GetParameterInfo(index)) for index in range(count)]
        self._rows = {info.name: self._read(info) for info in infos}

    def __getitem__(self, name: str) -> Parameter:
        return self._rows[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def set(self, values: Mapping[str, Value], *, until_restart: bool = False) -> None:
        """Puts new values in force as one set, all of them or none, and reads them back.

        The set is written to flash, for which the robot must be at rest. With `until_restart` it is in force until then only;
        while the robot drives it may then hold gains alone.

        Raises:
            InvalidValue: a name that the robot does not have, or a value that its table does not allow; nothing was sent.
            RobotRefused: the robot keeps the old set; the sentence names the parameter.
            LinkLost: it holds the old set or the new one, whole.
        """
        for name in values:
            if name not in self._rows:
                raise InvalidValue(f"the robot has no parameter '{name}'")
        wanted = {name: self._rows[name].stage(value) for name, value in values.items()}
        if not until_restart and self._client.request(messages.GetStatus()).mode in POWERED_MODES:
            raise RobotRefused("CommitParameters", ErrorCode.moving, 0)
        self._client.request(messages.RevertParameters())  # opens the staging area for this session
        for staged in wanted.values():
            self._request_in_set(staged)
        self._request_in_set(messages.ApplyParameters() if until_restart else messages.CommitParameters())
        for name, request in wanted.items():
            row = self._rows[name] = self._read(self._rows[name].info)
            if (row.held.active, row.held.active_text) != (request.value, request.text):
                raise AstrolabeError(f"{row} was read back, and another value was sent: another program may have changed it")

    def refresh(self) -> None:
        """Reads all values again."""
        self._rows = {name: self._read(row.info) for name, row in self._rows.items()}

    def _request_in_set(
        self, request: messages.StageParameter | messages.CommitParameters | messages.ApplyParameters
    ) -> None:
        try:
            self._client.request(request)
        except RobotRefused as refused:
            if refused.code == ErrorCode.staging_lost:
                raise
            self._client.request(messages.RevertParameters())  # nothing stays staged
            bad = next((name for name, row in self._rows.items() if row.info.id == refused.detail), None)
            if refused.code != ErrorCode.invalid_parameter or bad is None:
                raise
            raise RobotRefused(
                "the new set", refused.code, refused.detail, f"the value of {bad} is not possible beside the others"
            ) from None

    def _read(self, info: messages.ParameterInfo) -> Parameter:
        return Parameter(info, self._client.request(messages.GetParameter(info.id)))
