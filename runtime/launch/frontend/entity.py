"""An element of a launch file in XML or YAML."""

from __future__ import annotations

from typing import Any, get_args


class Entity:
    """An element: its kind, its attributes, and the elements in it."""

    @property
    def type_name(self) -> str:
        """Its kind, as `node`."""
        raise NotImplementedError

    @property
    def line(self) -> int:
        """The line on which it begins; 0 where that is not known."""
        return 0

    @property
    def parent(self) -> Entity | None:
        """The element that it is in."""
        raise NotImplementedError

    @property
    def children(self) -> list[Entity]:
        """The elements in it."""
        raise NotImplementedError

    def assert_entity_completely_parsed(self) -> None:
        """Raise `ValueError` where an attribute or child was not asked for."""
        raise NotImplementedError

    def get_attr(self, name: str, *, data_type: Any = str, optional: bool = False, can_be_str: bool = True) -> Any:
        """An attribute of a type, or elements of a kind; raises `AttributeError` and `TypeError`."""
        raise NotImplementedError


def wants_entities(data_type: Any) -> bool:
    """Whether a type asks for elements: `list`, or a list of `Entity`."""
    arguments = get_args(data_type)
    return data_type is list or bool(arguments and isinstance(arguments[0], type) and issubclass(arguments[0], Entity))
