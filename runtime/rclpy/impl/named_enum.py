"""Integer enumerations that print like upstream's C enumerations."""

from enum import IntEnum


class NamedIntEnum(IntEnum):
    """Base of enumerations whose members print as `ClockType.ROS_TIME`, not as their number."""

    def __str__(self) -> str:
        return f"{type(self).__name__}.{self.name}"

    def __format__(self, format_spec: str) -> str:
        return format(str(self), format_spec)
