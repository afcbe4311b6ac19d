"""Durations in nanoseconds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bot_console.runtime.distribution import distribution
from rclpy.constants import S_TO_NS

if TYPE_CHECKING:
    from builtin_interfaces.msg import Duration as DurationMsg

MAX_NS = 2**63


class Duration:
    """A length of time, negative or not, kept in ns; raises `OverflowError` beyond 64 bits."""

    __slots__ = ("_nanoseconds",)
    __hash__ = None  # type: ignore[assignment] -- not hashable, as upstream

    def __init__(self, *, seconds: float = 0, nanoseconds: int = 0) -> None:
        total = int(seconds * S_TO_NS) + int(nanoseconds)
        if not -MAX_NS <= total < MAX_NS:
            raise OverflowError("Total nanoseconds value is too large to store in C duration.")
        self._nanoseconds = total

    @property
    def nanoseconds(self) -> int:
        """The length in ns."""
        return self._nanoseconds

    def __repr__(self) -> str:
        return f"Duration(nanoseconds={self._nanoseconds})"

    def __str__(self) -> str:
        return "Infinite" if self._nanoseconds == INFINITE_NS else f"{self._nanoseconds} nanoseconds"

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Duration):
            return self._nanoseconds == other._nanoseconds
        return NotImplemented

    def __lt__(self, other: object) -> bool:
        if isinstance(other, Duration):
            return self._nanoseconds < other._nanoseconds
        return NotImplemented

    def __le__(self, other: object) -> bool:
        if isinstance(other, Duration):
            return self._nanoseconds <= other._nanoseconds
        return NotImplemented

    def __gt__(self, other: object) -> bool:
        if isinstance(other, Duration):
            return self._nanoseconds > other._nanoseconds
        return NotImplemented

    def __ge__(self, other: object) -> bool:
        if isinstance(other, Duration):
            return self._nanoseconds >= other._nanoseconds
        return NotImplemented

    def __add__(self, other: object) -> Duration:
        if isinstance(other, Duration) and distribution().durations_add_up:
            return Duration(nanoseconds=self._nanoseconds + other._nanoseconds)
        return NotImplemented

    def __sub__(self, other: object) -> Duration:
        if isinstance(other, Duration) and distribution().durations_add_up:
            return Duration(nanoseconds=self._nanoseconds - other._nanoseconds)
        return NotImplemented

    def __mul__(self, other: object) -> Duration:
        if isinstance(other, (int, float)) and distribution().durations_add_up:
            return Duration(nanoseconds=int(self._nanoseconds * other))
        return NotImplemented

    def to_msg(self) -> DurationMsg:
        """Return a `builtin_interfaces/Duration`; its nanoseconds are never negative."""
        from builtin_interfaces.msg import Duration as DurationMessage

        seconds, nanoseconds = divmod(self._nanoseconds, S_TO_NS)
        return DurationMessage(sec=seconds, nanosec=nanoseconds)

    @classmethod
    def from_msg(cls, msg: object) -> Duration:
        """Return the duration in a `builtin_interfaces/Duration`; raises `TypeError` for anything else."""
        from builtin_interfaces.msg import Duration as DurationMessage

        if not isinstance(msg, DurationMessage):
            raise TypeError("Must pass a builtin_interfaces.msg.Duration object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec)

    def get_c_duration(self) -> int:
        """Return the length in ns, in place of the C object that upstream returns."""
        return self._nanoseconds


INFINITE_NS = 9223372036854775807
Infinite = Duration(nanoseconds=INFINITE_NS)
