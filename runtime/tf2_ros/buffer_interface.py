"""Transforms data of every type for which a function is registered."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.time import Time
from std_msgs.msg import Header

Transforms = Callable[[Any, TransformStamped], Any]
NOW = Duration()
"""Do not wait."""


class Stamped:
    """Something with a time and a frame."""

    def __init__(self, obj: Any, stamp: Any, frame_id: str) -> None:
        self.header = Header(frame_id=frame_id, stamp=stamp)
        self.obj = obj


class TypeException(Exception):
    """No transformation or conversion is registered for this type."""

    def __init__(self, errstr: str) -> None:
        self.errstr = errstr
        super().__init__(errstr)


class NotImplementedException(Exception):
    """A buffer of this kind cannot do this."""

    def __init__(self) -> None:
        super().__init__("CanTransform or LookupTransform not implemented")


class TransformRegistration:
    """Functions that transform data, by type; packages such as `tf2_geometry_msgs` add theirs on import."""

    __type_map: ClassVar[dict[type, Transforms]] = {}

    def add(self, key: type, callback: Transforms) -> None:
        """Register `callback(data, transform)` for transforming data of a type."""
        self.__type_map[key] = callback

    def print_me(self) -> None:
        """Print the registered functions."""
        print(self.__type_map)

    def get(self, key: type) -> Transforms:
        """Return the function for a type; raises `TypeException`."""
        if key not in self.__type_map:
            raise TypeException(f"Type {key} if not loaded or supported")
        return self.__type_map[key]


class ConvertRegistration:
    """Functions that convert types: to a message, from a message, and directly."""

    __to_msg_map: ClassVar[dict[type, Callable[[Any], Any]]] = {}
    __from_msg_map: ClassVar[dict[type, Callable[[Any], Any]]] = {}
    __convert_map: ClassVar[dict[tuple[type, type], Callable[[Any], Any]]] = {}

    def add_from_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register the function that creates a type from its message."""
        self.__from_msg_map[key] = callback

    def add_to_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register the function that creates the message of a type."""
        self.__to_msg_map[key] = callback

    def add_convert(self, key: tuple[type, type], callback: Callable[[Any], Any]) -> None:
        """Register a direct conversion from one type to another."""
        self.__convert_map[key] = callback

    def get_from_msg(self, key: type) -> Callable[[Any], Any]:
        """Return the function that creates a type from its message; raises `TypeException`."""
        return _find_registered(self.__from_msg_map, key)

    def get_to_msg(self, key: type) -> Callable[[Any], Any]:
        """Return the function that creates the message of a type; raises `TypeException`."""
        return _find_registered(self.__to_msg_map, key)

    def get_convert(self, key: tuple[type, type]) -> Callable[[Any], Any]:
        """Return the direct conversion from one type to another; raises `TypeException`."""
        return _find_registered(self.__convert_map, key)


def _find_registered(known: Any, key: Any) -> Any:
    if key not in known:
        raise TypeException(f"Type {key} if not loaded or supported")
    return known[key]


def convert(a: object, b_type: type) -> Any:
    """Convert data to another type, directly or through its message; raises `TypeException`."""
    conversions = ConvertRegistration()
    try:
        return conversions.get_convert((type(a), b_type))(a)
    except TypeException:
        if type(a) is b_type:
            return a
        return conversions.get_from_msg(b_type)(conversions.get_to_msg(type(a))(a))


class BufferInterface:
    """The interface of all transform buffers: `Buffer`, and `BufferClient`, which queries another process."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Duration = NOW, new_type: type | None = None
    ) -> Any:
        """Return data in another frame at the data's own time; waits for the transform up to `timeout`."""
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        stamp = Time.from_msg(header.stamp)
        result = do_transform(object_stamped, self.lookup_transform(target_frame, header.frame_id, stamp, timeout))
        return result if new_type is None else convert(result, new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time,
        fixed_frame: str,
        timeout: Duration = NOW,
        new_type: type | None = None,
    ) -> Any:
        """Return data in another frame at another time, via a fixed frame."""
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transform = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, Time.from_msg(header.stamp), fixed_frame, timeout
        )
        result = do_transform(object_stamped, transform)
        return result if new_type is None else convert(result, new_type)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time, timeout: Duration = NOW
    ) -> TransformStamped:
        """Return the transform that maps points from one frame to another."""
        raise NotImplementedException

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = NOW,
    ) -> TransformStamped:
        """Return the transform between two frames at two times."""
        raise NotImplementedException

    def can_transform(
        self, target_frame: str, source_frame: str, time: Time, timeout: Duration = NOW
    ) -> int | tuple[int, str]:
        """Return whether `lookup_transform` would succeed."""
        raise NotImplementedException

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = NOW,
    ) -> int | tuple[int, str]:
        """Return whether `lookup_transform_full` would succeed."""
        raise NotImplementedException
