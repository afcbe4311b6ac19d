"""Points in time of one clock."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeGuard

from builtin_interfaces.msg import Time as TimeMessage
from rclpy.clock_type import ClockType, TimeClockType
from rclpy.constants import S_TO_NS
from rclpy.duration import Duration
from rclpy.impl.reexports import reexporting

if TYPE_CHECKING:
    from builtin_interfaces.msg import Time as TimeMsg

MAX_NS = 2**63


class Time:
    """A point in time, in ns since the clock's zero.

    Raises `ValueError` for negative parts, `OverflowError` beyond 64 bits, `TypeError` when clocks are mixed.
    """

    __slots__ = ("_clock_type", "_nanoseconds")
    __hash__ = None  # type: ignore[assignment] -- not hashable, as upstream

    def __init__(
        self, *, seconds: float = 0, nanoseconds: int = 0, clock_type: ClockType | TimeClockType = ClockType.SYSTEM_TIME
    ) -> None:
        if isinstance(clock_type, TimeClockType):
            clock_type = ClockType(clock_type)
        if not isinstance(clock_type, ClockType):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
            raise TypeError("Clock type must be a ClockType enum")
        if seconds < 0:
            raise ValueError("Seconds value must not be negative")
        if nanoseconds < 0:
            raise ValueError("Nanoseconds value must not be negative")
        total = int(seconds * S_TO_NS) + int(nanoseconds)
        if total >= MAX_NS:
            raise OverflowError("Total nanoseconds value is too large to store in C time point.")
        self._nanoseconds = total
        self._clock_type = clock_type

    @classmethod
    def _of(cls, nanoseconds: int, clock_type: ClockType) -> Time:
        """Return a time made of parts that are known to be valid."""
        made = cls.__new__(cls)
        made._nanoseconds = nanoseconds
        made._clock_type = clock_type
        return made

    @property
    def nanoseconds(self) -> int:
        """Time since the clock's zero in ns."""
        return self._nanoseconds

    @property
    def clock_type(self) -> TimeClockType:
        """The type of the clock; equal to the member of `ClockType`."""
        return TimeClockType(self._clock_type)

    def seconds_nanoseconds(self) -> tuple[int, int]:
        """Return the whole seconds, and the ns beyond them."""
        return self._nanoseconds // S_TO_NS, self._nanoseconds % S_TO_NS

    def __repr__(self) -> str:
        return f"Time(nanoseconds={self._nanoseconds}, clock_type={self._clock_type.name})"

    def __add__(self, other: object) -> Time:
        if isinstance(other, Duration):
            total = self._nanoseconds + other.nanoseconds
            if total < 0:
                raise ValueError("Nanoseconds value must not be negative")
            if total >= MAX_NS:
                raise OverflowError("Addition leads to overflow in C storage.")
            return Time._of(total, self._clock_type)
        return NotImplemented

    def __radd__(self, other: object) -> Time:
        return self.__add__(other)

    def __sub__(self, other: object) -> Any:
        if isinstance(other, Time):
            if self._clock_type != other._clock_type:
                raise TypeError("Can't subtract times with different clock types")
            return Duration(nanoseconds=self._nanoseconds - other._nanoseconds)
        if isinstance(other, Duration):
            total = self._nanoseconds - other.nanoseconds
            if total < 0:
                raise ValueError("Subtraction leads to negative time.")
            if total >= MAX_NS:
                raise OverflowError("Total nanoseconds value is too large to store in C time point.")
            return Time._of(total, self._clock_type)
        return NotImplemented

    def __eq__(self, other: object) -> bool:
        return self._comparable(other) and self._nanoseconds == other._nanoseconds  # type: ignore[attr-defined] -- what is no such thing fails, as upstream

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __lt__(self, other: object) -> bool:
        return self._nanoseconds < other._nanoseconds if self._comparable(other) else NotImplemented

    def __le__(self, other: object) -> bool:
        return self._nanoseconds <= other._nanoseconds if self._comparable(other) else NotImplemented

    def __gt__(self, other: object) -> bool:
        return self._nanoseconds > other._nanoseconds if self._comparable(other) else NotImplemented

    def __ge__(self, other: object) -> bool:
        return self._nanoseconds >= other._nanoseconds if self._comparable(other) else NotImplemented

    def _comparable(self, other: object) -> TypeGuard[Time]:
        if not isinstance(other, Time):
            return False
        if self._clock_type != other._clock_type:
            raise TypeError("Can't compare times with different clock types")
        return True

    def to_msg(self) -> TimeMsg:
        """Return a `builtin_interfaces/Time`."""
        seconds, nanoseconds = self.seconds_nanoseconds()
        return TimeMessage(sec=seconds, nanosec=nanoseconds)

    @classmethod
    def from_msg(cls, msg: object, clock_type: ClockType | TimeClockType = ClockType.ROS_TIME) -> Time:
        """Return the time in a `builtin_interfaces/Time`; raises `TypeError` for anything else."""
        if not isinstance(msg, TimeMessage):
            raise TypeError("Must pass a builtin_interfaces.msg.Time object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec, clock_type=clock_type)


__getattr__ = reexporting(__name__, "")
