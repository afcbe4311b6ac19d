"""The slow paths of copying a message, for values that do not have exactly the type of their field.

Values that could be transmitted are converted; any other value is an error that names the field.
"""

from __future__ import annotations

from typing import Any


class FieldTypeError(TypeError):
    """A field holds a value that cannot be sent; `field` is its path, such as `linear.x`."""

    def __init__(self, owner: str, field: str, wanted: str, value: object) -> None:
        self.owner = owner
        self.field = field
        self.wanted = wanted
        self.value = value
        super().__init__(owner, field, wanted, value)

    def __str__(self) -> str:
        try:
            shown = repr(self.value)
        except Exception:  # a class defined by the node, or an integer with more digits than Python prints
            shown = "which cannot be written"
        shown = shown if len(shown) <= 60 else shown[:57] + "..."
        return f"field '{self.field}' of {self.owner} must be {self.wanted}, not {type(self.value).__name__} ({shown})"


def type_name(cls: type) -> str:
    """Return the ROS name of a class, such as `geometry_msgs/msg/Twist`; a subclass has its generated class's name."""
    cls = next((each for each in cls.__mro__ if "_fields_and_field_types" in vars(each)), cls)
    package, kind = cls.__module__.split(".")[:2]
    return f"{package}/{kind}/{cls.__name__}"


def _refuse(message: object, field: str, wanted: str, value: object) -> FieldTypeError:
    return FieldTypeError(type_name(type(message)), field, wanted, value)


def _below(message: object, field: str, error: FieldTypeError) -> FieldTypeError:
    return FieldTypeError(type_name(type(message)), f"{field}.{error.field}", error.wanted, error.value)


def to_float(message: object, field: str) -> float:
    """Return a float, also for a subclass such as `numpy.float64`."""
    value = getattr(message, "_" + field)
    if isinstance(value, float):
        return float(value)
    raise _refuse(message, field, "a float", value)


def to_int(message: object, field: str, low: int, high: int) -> int:
    """Return an integer (including a bool) within the field's limits."""
    value = getattr(message, "_" + field)
    if hasattr(value, "__index__"):
        number = value.__index__()
        if low <= number <= high:
            return number
        raise _refuse(message, field, f"an integer in [{low}, {high}]", value)
    raise _refuse(message, field, "an integer", value)


def to_bool(message: object, field: str) -> bool:
    """Return a bool, also for a NumPy bool."""
    value = getattr(message, "_" + field)
    if type(value).__name__ in ("bool_", "bool"):
        return bool(value)
    raise _refuse(message, field, "a bool", value)


def to_str(message: object, field: str, limit: int = 0) -> str:
    """Return a string of at most `limit` characters (0: any length), cut at a NUL, which ends it on the wire.

    Raises `UnicodeEncodeError` for a lone surrogate, as in names of files that are not UTF-8.
    """
    value = getattr(message, "_" + field)
    if not isinstance(value, str):
        raise _refuse(message, field, "a string", value)
    if limit and len(value) > limit:
        raise _refuse(message, field, f"a string of at most {limit} characters", value)
    return str(_encodable(value).partition("\0")[0])


def _encodable(text: str) -> str:
    """Return the text; raises `UnicodeEncodeError` if it cannot be sent."""
    if not text.isascii():
        text.encode()
    return text


def to_octet(message: object, field: str) -> bytes:
    """Return one byte."""
    value = getattr(message, "_" + field)
    if isinstance(value, (bytes, bytearray)) and len(value) == 1:
        return bytes(value)
    raise _refuse(message, field, "bytes of length 1", value)


def to_message(message: Any, field: str, cls: Any) -> Any:
    """Return a nested message of the class, or of a subclass."""
    value = getattr(message, "_" + field)
    if not isinstance(value, cls):
        raise _refuse(message, field, f"a {type_name(cls)}", value)
    try:
        return cls._copy_(value)
    except FieldTypeError as error:
        raise _below(message, field, error) from None


def too_long(message: object, field: str, bound: int) -> None:
    """Raise an error for a sequence beyond its bound."""
    value = getattr(message, "_" + field)
    raise _refuse(message, field, f"a sequence of at most {bound}", value)


def _check_size(message: object, field: str, size: int, bound: int) -> Any:
    value = getattr(message, "_" + field)
    try:
        length = len(value)
    except TypeError:
        raise _refuse(message, field, "a sequence", value) from None
    if size and length != size:
        raise _refuse(message, field, f"a sequence of exactly {size}", value)
    if bound and length > bound:
        raise _refuse(message, field, f"a sequence of at most {bound}", value)
    return value


_own_arrays: dict[str, tuple[Any, Any]] = {}
"""NumPy's array class and a dtype, by the dtype's name, once an array was created: NumPy is imported only if used."""


def to_fixed(message: object, field: str, dtype: str, size: int) -> Any:
    """Return a NumPy array of the field's dtype and size."""
    value = getattr(message, "_" + field)
    kind, own = _own_arrays.get(dtype) or (None, None)
    if value.__class__ is kind and value.dtype is own and value.shape == (size,):
        return value.copy()  # nearly always true, and three times as fast as the general way
    import numpy

    _own_arrays[dtype] = numpy.ndarray, numpy.dtype(dtype)
    value = _check_size(message, field, size, 0)
    try:
        return numpy.array(value, dtype)
    except (TypeError, ValueError):
        raise _refuse(message, field, f"numbers of type {dtype}", value) from None


def to_list(message: object, field: str, kind: type, size: int, bound: int, limit: int) -> list[Any]:
    """Return a list of strings, bools or single bytes."""
    values = getattr(message, "_" + field)
    if values.__class__ is list and not values and not size:
        return []
    values = _check_size(message, field, size, bound)
    if kind is bytes and isinstance(values, (bytes, bytearray)):
        return [bytes([each]) for each in values]
    for index, value in enumerate(values):
        if not isinstance(value, kind) or (limit and len(value) > limit) or (kind is bytes and len(value) != 1):
            wanted = {"str": "a string", "bool": "a bool", "bytes": "bytes of length 1"}[kind.__name__]
            raise _refuse(message, f"{field}[{index}]", wanted, value)
    return [_encodable(each).partition("\0")[0] for each in values] if kind is str else list(values)


def to_messages(message: Any, field: str, cls: Any, size: int, bound: int) -> list[Any]:
    """Return a list of copies of nested messages."""
    values = getattr(message, "_" + field)
    if values.__class__ is list and not values and not size:
        return []
    values = _check_size(message, field, size, bound)
    copies: list[Any] = []
    for index, value in enumerate(values):
        if not isinstance(value, cls):
            raise _refuse(message, f"{field}[{index}]", f"a {type_name(cls)}", value)
        try:
            copies.append(cls._copy_(value))
        except FieldTypeError as error:
            raise _below(message, f"{field}[{index}]", error) from None
    return copies


def to_ndarray(dtype: str, value: object) -> Any:
    """Return the array that a setter stores for a fixed-size field of numbers."""
    import numpy

    return numpy.array(value, dtype)


def zeros(dtype: str, size: int) -> Any:
    """Return the default of a fixed-size field of numbers."""
    import numpy

    return numpy.zeros(size, dtype)
