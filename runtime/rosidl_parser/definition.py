"""Types of message fields, by the names of ROS 2's rosidl_parser."""

from __future__ import annotations

from collections.abc import Sequence


class AbstractType:
    """Base of all types; two are equal if their classes and attributes are."""

    __slots__ = ()
    __hash__ = None  # type: ignore[assignment] -- not hashable, as upstream

    def _parts(self) -> tuple[object, ...]:
        names = (name for cls in reversed(type(self).__mro__) for name in getattr(cls, "__slots__", ()))
        return tuple(getattr(self, name) for name in names)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, AbstractType) and type(self) is type(other) and self._parts() == other._parts()

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(repr, self._parts()))})"


class AbstractNestableType(AbstractType):
    """Base of the types that arrays and sequences can have as elements."""

    __slots__ = ()


class BasicType(AbstractNestableType):
    """A number, a boolean or an octet."""

    __slots__ = ("typename",)

    def __init__(self, typename: str) -> None:
        self.typename = typename


class NamedType(AbstractNestableType):
    """A type that is known by a name, not yet resolved."""

    __slots__ = ("name",)

    def __init__(self, name: str) -> None:
        self.name = name


class NamespacedType(AbstractNestableType):
    """A message type: namespaces such as `["std_msgs", "msg"]`, and its name."""

    __slots__ = ("name", "namespaces")

    def __init__(self, namespaces: Sequence[str], name: str) -> None:
        self.namespaces = namespaces
        self.name = name

    def namespaced_name(self) -> tuple[str, ...]:
        """Return the namespaces and the name in one tuple."""
        return (*self.namespaces, self.name)


class AbstractGenericString(AbstractNestableType):
    """Base of all strings."""

    __slots__ = ()

    def has_maximum_size(self) -> bool:
        """Whether the length is limited."""
        return hasattr(self, "maximum_size")


class AbstractString(AbstractGenericString):
    """A string of 8-bit characters."""

    __slots__ = ()


class AbstractWString(AbstractGenericString):
    """A string of 16-bit characters."""

    __slots__ = ()


class BoundedString(AbstractString):
    """A string of at most `maximum_size` characters."""

    __slots__ = ("maximum_size",)

    def __init__(self, maximum_size: int) -> None:
        self.maximum_size = maximum_size


class UnboundedString(AbstractString):
    """A string of any length."""

    __slots__ = ()


class BoundedWString(AbstractWString):
    """A wide string of at most `maximum_size` characters."""

    __slots__ = ("maximum_size",)

    def __init__(self, maximum_size: int) -> None:
        self.maximum_size = maximum_size


class UnboundedWString(AbstractWString):
    """A wide string of any length."""

    __slots__ = ()


class AbstractNestedType(AbstractType):
    """An array or a sequence of `value_type`."""

    __slots__ = ("value_type",)

    def __init__(self, value_type: AbstractNestableType) -> None:
        self.value_type = value_type

    def has_maximum_size(self) -> bool:
        """Whether the number of elements is limited."""
        return hasattr(self, "size") or hasattr(self, "maximum_size")


class Array(AbstractNestedType):
    """An array of exactly `size` elements."""

    __slots__ = ("size",)

    def __init__(self, value_type: AbstractNestableType, size: int) -> None:
        super().__init__(value_type)
        self.size = size


class AbstractSequence(AbstractNestedType):
    """Base of all sequences."""

    __slots__ = ()


class BoundedSequence(AbstractSequence):
    """A sequence of at most `maximum_size` elements."""

    __slots__ = ("maximum_size",)

    def __init__(self, value_type: AbstractNestableType, maximum_size: int) -> None:
        super().__init__(value_type)
        self.maximum_size = maximum_size


class UnboundedSequence(AbstractSequence):
    """A sequence of any length."""

    __slots__ = ()
