"""Actions that repeat entities for each of several values."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

import launch.logging
from launch.action import Action
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("for_each")
class ForEach(Action):
    """Visits the entities that a function returns for each iteration; values are YAML maps separated by `;`."""

    SEPARATOR = ";"

    def __init__(
        self,
        input_values: SomeSubstitutionsType,
        *,
        function: Callable[..., Iterable[LaunchDescriptionEntity] | None],
        **kwargs: Condition | None,
    ) -> None:
        super().__init__(**kwargs)
        self._input_values = normalize_to_list_of_substitutions(input_values)
        self._function = function

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["input_values"] = parser.parse_substitution(entity.get_attr("values"))
        iteration = _children_function(entity, parser)

        def function(**values: object) -> list[LaunchDescriptionEntity]:
            return iteration(values)

        kwargs["function"] = function
        return cls, kwargs

    @property
    def input_values(self) -> list[Substitution]:
        """The values as a text."""
        return self._input_values

    @property
    def function(self) -> Callable[..., Iterable[LaunchDescriptionEntity] | None]:
        """The function that is called with the values of each iteration."""
        return self._function

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Call the function for each iteration; raises `SyntaxError` for values that are not a YAML map."""
        import yaml

        texts = [
            each for each in perform_substitutions(context, self._input_values).strip().split(self.SEPARATOR) if each
        ]
        if not texts:
            launch.logging.get_logger("launch.actions.for_loop").warning("no input values: will not iterate")
        found: list[LaunchDescriptionEntity] = []
        for text in texts:
            values = yaml.safe_load(text.strip())
            if values is None:
                continue
            if not isinstance(values, dict):
                raise SyntaxError(f"Unable to parse iteration values: {text!r} is not a YAML map")
            found += self._function(**values) or ()
        return found


@expose_action("for")
class ForLoop(Action):
    """Visits the entities that a function of `i` returns, for each number from 0 up to a length (exclusive)."""

    def __init__(
        self,
        length: SomeSubstitutionsType,
        *,
        function: Callable[..., Iterable[LaunchDescriptionEntity] | None],
        name: str | None = None,
        **kwargs: Condition | None,
    ) -> None:
        super().__init__(**kwargs)
        self._length = normalize_to_list_of_substitutions(length)
        self._function = function
        self._name = name

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["length"] = parser.parse_substitution(entity.get_attr("len"))
        name = entity.get_attr("name")
        kwargs["name"] = name
        iteration = _children_function(entity, parser)

        def function(i: object) -> list[LaunchDescriptionEntity]:
            return iteration({name: i})

        kwargs["function"] = function
        return cls, kwargs

    @property
    def length(self) -> list[Substitution]:
        """The number of iterations as a text."""
        return self._length

    @property
    def function(self) -> Callable[..., Iterable[LaunchDescriptionEntity] | None]:
        """The function that is called with each number."""
        return self._function

    @property
    def name(self) -> str | None:
        """The name by which `$(index name)` finds the number."""
        return self._name

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Call the function for each number; raises `ValueError` for a length that is not an integer."""
        length = int(perform_substitutions(context, self._length))
        found: list[LaunchDescriptionEntity] = []
        for number in range(length):
            found += self._function(i=number) or ()
        return found


class _WithLocals(Action):
    """Sets locals for the entities visited next, or removes them."""

    def __init__(self, values: dict[str, object] | None) -> None:
        super().__init__()
        self._values = values

    def execute(self, context: LaunchContext) -> None:
        if self._values is None:
            context._pop_locals()  # pyright: ignore[reportPrivateUsage] -- a scope for each round, as upstream
        else:
            context._push_locals()  # pyright: ignore[reportPrivateUsage] -- a scope for each round, as upstream
            context.extend_locals(self._values)


def _children_function(entity: Entity, parser: Parser) -> Callable[[dict[str, object]], list[LaunchDescriptionEntity]]:
    children = entity.children

    def iteration(values: dict[str, object]) -> list[LaunchDescriptionEntity]:
        return [_WithLocals(values), *(parser.parse_action(each) for each in children), _WithLocals(None)]

    for each in children:
        parser.parse_action(each)
    return iteration
