"""An element of a launch file in XML."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any
from xml.etree.ElementTree import Element

from launch.frontend import Entity as BaseEntity
from launch.frontend.entity import wants_entities
from launch.utilities.type_utils import get_typed_value


class Entity(BaseEntity):
    """An element that tracks which of its attributes and children were read."""

    def __init__(
        self, element: Element, *, parent: Entity | None = None, lines: Mapping[Element, int] | None = None
    ) -> None:
        self.__element = element
        self.__lines: Mapping[Element, int] = {} if lines is None else lines
        self.__parent = parent
        self.__read_attributes: set[str] = set()
        self.__read_children: set[str] = set()

    @property
    def type_name(self) -> str:
        """The element's tag."""
        return self.__element.tag

    @property
    def line(self) -> int:
        """The line on which the element begins; 0 if unknown."""
        return self.__lines.get(self.__element, 0)

    @property
    def parent(self) -> Entity | None:
        """The enclosing element."""
        return self.__parent

    @property
    def children(self) -> list[BaseEntity]:
        """The nested elements."""
        self.__read_children = {each.tag for each in self.__element}
        return [Entity(each, parent=self, lines=self.__lines) for each in self.__element]

    def assert_entity_completely_parsed(self) -> None:
        """Raise `ValueError` for attributes and elements that were not read."""
        attributes = set(self.__element.attrib) - self.__read_attributes
        if attributes:
            raise ValueError(f"Unexpected attribute(s) found in `{self.type_name}`: {attributes}")
        children = {each.tag for each in self.__element} - self.__read_children
        if children:
            raise ValueError(f"Unexpected nested tag(s) found in `{self.type_name}`: {children}")

    def get_attr(self, name: str, *, data_type: object = str, optional: bool = False, can_be_str: bool = True) -> Any:
        """Return an attribute as the given type, or the elements of a tag; raises `AttributeError` and `TypeError`."""
        if wants_entities(data_type):
            found = [Entity(each, parent=self, lines=self.__lines) for each in self.__element if each.tag == name]
            self.__read_children.add(name)
            return found or self.__missing(name, "List[Entity]", optional)
        if name not in self.__element.attrib:
            return self.__missing(name, data_type, optional)
        self.__read_attributes.add(name)
        text: Any = self.__element.attrib[name]
        separator = f"{name}-sep"
        if separator in self.__element.attrib:
            self.__read_attributes.add(separator)
            text = text.split(self.__element.attrib[separator])
        return self.__typed(name, text, data_type, can_be_str)

    def __missing(self, name: str, data_type: object, optional: bool) -> None:
        if not optional:
            raise AttributeError(f"Attribute '{name}' of type '{data_type}' not found in Entity '{self.type_name}'")

    def __typed(self, name: str, text: object, data_type: object, can_be_str: bool) -> Any:
        try:
            return get_typed_value(text, data_type, can_be_str=can_be_str)
        except ValueError as error:
            raise TypeError(
                f"Attribute '{name}' of Entity '{self.type_name}' expected to be of type '{data_type}'."
                f"'{text}' can not be converted to one of those types"
            ) from error
