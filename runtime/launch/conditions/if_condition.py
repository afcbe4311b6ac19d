"""`IfCondition`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.condition import Condition
from launch.conditions.evaluate_condition_expression_impl import evaluate_condition_expression
from launch.utilities import normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


class IfCondition(Condition):
    """True when an expression evaluates to true."""

    def __init__(self, predicate_expression: SomeSubstitutionsType) -> None:
        self.__expression = normalize_to_list_of_substitutions(predicate_expression)
        super().__init__(predicate=self._predicate_func)

    def _predicate_func(self, context: LaunchContext) -> bool:
        """Whether the expression is true now; public launch files call it by this name."""
        return evaluate_condition_expression(context, self.__expression)

    def describe(self) -> str:
        """Return a short description."""
        return f"IfCondition({' + '.join(each.describe() for each in self.__expression)})"
