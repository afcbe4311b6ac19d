"""An element of a launch file in XML or YAML."""

from __future__ import annotations

from typing import Any, get_args


class Entity:
    """An element: its kind, its attributes, and its nested elements."""

    @property
    def type_name(self) -> str:
        """The element's kind, such as `node`."""
        raise NotImplementedError

    @property
    def line(self) -> int:
        """The line where the element begins; 0 if unknown."""
        return 0

    @property
    def parent(self) -> Entity | None:
        """The enclosing element."""
        raise NotImplementedError

    @property
    def children(self) -> list[Entity]:
        """The nested elements."""
        raise NotImplementedError

    def assert_entity_completely_parsed(self) -> None:
        """Raise `ValueError` if an attribute or child was not read."""
        raise NotImplementedError

    def get_attr(self, name: str, *, data_type: object = str, optional: bool = False, can_be_str: bool = True) -> Any:
        """Return an attribute as the given type, or elements of a kind; raises `AttributeError` and `TypeError`."""
        raise NotImplementedError


def wants_entities(data_type: object) -> bool:
    """Whether a type stands for elements: `list`, or a list of `Entity`."""
    arguments = get_args(data_type)
    return data_type is list or bool(arguments and isinstance(arguments[0], type) and issubclass(arguments[0], Entity))
