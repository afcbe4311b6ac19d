"""An element of a launch file in YAML."""

from __future__ import annotations

from typing import Any

from launch.frontend import Entity as BaseEntity
from launch.frontend.entity import wants_entities
from launch.utilities.type_utils import is_instance_of


class Entity(BaseEntity):
    """A map or list with the name of its kind; it tracks which of its keys were read."""

    def __init__(self, element: object, type_name: str | None = None, *, parent: Entity | None = None) -> None:
        self.__element: Any = element
        self.__type_name = type_name or ""
        self.__parent = parent
        self.__read_keys: set[str] = set()
        self.__children_read = False

    @property
    def type_name(self) -> str:
        """The kind of the element."""
        return self.__type_name

    @property
    def line(self) -> int:
        """The line on which the element begins; 0 if unknown."""
        return getattr(self.__element, "line", 0) or getattr(self.__parent, "line", 0)

    @property
    def parent(self) -> Entity | None:
        """The enclosing element."""
        return self.__parent

    @property
    def children(self) -> list[BaseEntity]:
        """The nested elements; raises `ValueError` if it cannot have any."""
        if not (_is_map(self.__element) or _is_list(self.__element)):
            raise TypeError(f"Expected list or dict, got {type(self.__element)} in Entity '{self.type_name}'")
        children = self.__element
        if _is_map(self.__element):
            if "children" not in children:
                raise ValueError(
                    f"Expected entity `{self.type_name}` to have children entities."
                    "That can be a list of subentities or a dictionary with a `children` list element"
                )
            self.__read_keys.add("children")
            children = children["children"]
        self.__children_read = True
        return [self.__child(each) for each in children]

    def __child(self, child: Any) -> Entity:
        if len(child) != 1:
            raise RuntimeError("Subentities must be a dictionary with only one key, which is the entity type")
        type_name = next(iter(child))
        return Entity(child[type_name], type_name, parent=self)

    def assert_entity_completely_parsed(self) -> None:
        """Raise `ValueError` for keys that were not read."""
        if _is_list(self.__element):
            if not self.__children_read:
                raise ValueError(f"Unexpected nested entity(ies) found in `{self.type_name}`: {self.__element}")
            return
        unread = set(self.__element or ()) - self.__read_keys
        if unread:
            raise ValueError(f"Unexpected key(s) found in `{self.type_name}`: {unread}")

    def get_attr(self, name: str, *, data_type: object = str, optional: bool = False, can_be_str: bool = True) -> Any:
        """Return a value as the given type, or the elements of a key; raises `AttributeError` and `TypeError`."""
        element = self.__element
        if not _is_map(self.__element) or name not in element:
            if optional:
                return None
            raise AttributeError(f"Can not find attribute '{name}' in Entity '{self.type_name}'")
        self.__read_keys.add(name)
        data = element[name]
        if wants_entities(data_type):
            if _is_list(data) and data and isinstance(data[0], dict):
                return [Entity(each, name, parent=self) for each in data]
            raise TypeError(f"Attribute '{name}' of Entity '{self.type_name}' expected to be a list of dictionaries.")
        if not is_instance_of(data, data_type, can_be_str=can_be_str):
            raise TypeError(
                f"Attribute '{name}' of Entity '{self.type_name}' expected to be of type '{data_type}', "
                f"got '{type(data)}'"
            )
        return data


def _is_map(value: object) -> bool:
    return isinstance(value, dict)


def _is_list(value: object) -> bool:
    return isinstance(value, list)
