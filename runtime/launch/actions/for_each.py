"""Actions for each of some values."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

from launch.action import Action
from launch.frontend import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions


@expose_action("for_each")
class ForEach(Action):
    """Visits what a function gives for each iteration; the values are YAML maps with `;` between them."""

    def __init__(self, input_values: Any, *, function: Callable[..., Any], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._input_values = normalize_to_list_of_substitutions(input_values)
        self._function = function

    @classmethod
    def parse(cls, entity: Any, parser: Any) -> tuple[type[Action], dict[str, Any]]:
        """From XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["input_values"] = parser.parse_substitution(entity.get_attr("values"))
        kwargs["function"] = _children_function(entity, parser)
        return cls, kwargs

    @property
    def input_values(self) -> list[Any]:
        """The values as a text."""
        return self._input_values

    def execute(self, context: Any) -> list[Any]:
        """Call the function for each iteration."""
        import yaml

        found: list[Any] = []
        for text in perform_substitutions(context, self._input_values).split(";"):
            values = yaml.safe_load(text) if text.strip() else None
            if values is None:
                continue
            if not isinstance(values, dict):
                raise SyntaxError(f"Unable to parse iteration values: {text!r} is no YAML map")
            found += self._iteration(values)
        return found

    def _iteration(self, values: dict[str, Any]) -> list[Any]:
        if getattr(self._function, "takes_locals", False):
            return list(self._function(values))
        wanted = inspect.signature(self._function).parameters
        for name, parameter in wanted.items():
            if name not in values and parameter.default is inspect.Parameter.empty:
                raise ValueError(f"No value is provided for the argument {name!r} of the function of ForEach")
        return list(self._function(**{name: values[name] for name in wanted if name in values}) or ())


@expose_action("for")
class ForLoop(Action):
    """Visits what a function gives for each number below a length."""

    def __init__(self, length: Any, *, function: Callable[..., Any], name: str | None = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._length = normalize_to_list_of_substitutions(str(length) if isinstance(length, int) else length)
        self._function = function
        self._name = name

    @classmethod
    def parse(cls, entity: Any, parser: Any) -> tuple[type[Action], dict[str, Any]]:
        """From XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["length"] = parser.parse_substitution(entity.get_attr("len"))
        kwargs["name"] = entity.get_attr("name")
        kwargs["function"] = _children_function(entity, parser)
        return cls, kwargs

    def execute(self, context: Any) -> list[Any]:
        """Call the function for each number."""
        found: list[Any] = []
        for number in range(int(perform_substitutions(context, self._length))):
            if getattr(self._function, "takes_locals", False):
                found += self._function({self._name or "i": number})
            else:
                found += self._function(number) or ()
        return found


class _WithLocals(Action):
    """Sets locals for the entities that are visited next."""

    def __init__(self, values: dict[str, Any] | None) -> None:
        super().__init__()
        self._values = values

    def execute(self, context: Any) -> None:
        if self._values is None:
            context._pop_locals()
        else:
            context._push_locals()
            context.extend_locals(self._values)


def _children_function(entity: Any, parser: Any) -> Callable[[dict[str, Any]], list[Any]]:
    children = entity.children

    def iteration(values: dict[str, Any]) -> list[Any]:
        return [_WithLocals(values), *(parser.parse_action(each) for each in children), _WithLocals(None)]

    iteration.takes_locals = True  # type: ignore[attr-defined]
    for each in children:
        parser.parse_action(each)
    return iteration
