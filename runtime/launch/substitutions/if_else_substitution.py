"""One of two values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.joined import describe_all, evaluate_bool
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("if")
class IfElseSubstitution(Substitution):
    """One of two values, chosen by a condition; raises `RuntimeError` if both are empty."""

    def __init__(
        self,
        condition: SomeSubstitutionsType,
        if_value: SomeSubstitutionsType = "",
        else_value: SomeSubstitutionsType = "",
    ) -> None:
        super().__init__()
        if if_value == else_value == "":
            raise RuntimeError("One of if_value and else_value must be specified")
        self._condition = normalize_to_list_of_substitutions(condition)
        self._if_value = normalize_to_list_of_substitutions(if_value)
        self._else_value = normalize_to_list_of_substitutions(else_value)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[IfElseSubstitution], dict[str, object]]:
        """Parse `$(if condition value other)`."""
        if not 2 <= len(data) <= 3:
            raise TypeError("if substitution expects from 2 or 3 arguments")
        return cls, dict(zip(("condition", "if_value", "else_value"), data, strict=False))

    @property
    def condition(self) -> list[Substitution]:
        """The condition."""
        return self._condition

    @property
    def if_value(self) -> list[Substitution]:
        """The value if the condition holds."""
        return self._if_value

    @property
    def else_value(self) -> list[Substitution]:
        """The value if the condition does not hold."""
        return self._else_value

    def describe(self) -> str:
        """Return a description such as `IfElseSubstitution('true', 'a', 'b')`."""
        parts = (self._condition, self._if_value, self._else_value)
        return f"IfElseSubstitution({', '.join(describe_all(each) for each in parts)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value."""
        chosen = self._if_value if evaluate_bool(context, self._condition) else self._else_value
        return perform_substitutions(context, chosen)
