"""Whether two values are equal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.joined import described, word
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

TRUTH = {"true": True, "1": True, "false": False, "0": False}


def _pieces(value: SomeSubstitutionsType | float | None) -> list[Substitution]:
    """Normalize any value to substitutions; None becomes the empty text."""
    if value is None:
        return normalize_to_list_of_substitutions("")
    if isinstance(value, (bool, int, float)):
        return normalize_to_list_of_substitutions(str(value).lower() if isinstance(value, bool) else str(value))
    return normalize_to_list_of_substitutions(value)


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _equal(left: str, right: str) -> bool:
    truths = TRUTH.get(left.lower()), TRUTH.get(right.lower())
    if None not in truths:
        return truths[0] == truths[1]
    numbers = _number(left), _number(right)
    if numbers[0] is not None and numbers[1] is not None:
        return math.isclose(numbers[0], numbers[1])
    return left == right


@expose_substitution("equals")
class EqualsSubstitution(Substitution):
    """Whether two values are equal: as booleans, else as numbers, else as texts."""

    _name = "equals"

    def __init__(self, left: SomeSubstitutionsType | float | None, right: SomeSubstitutionsType | float | None) -> None:
        super().__init__()
        self.__left = _pieces(left)
        self.__right = _pieces(right)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[EqualsSubstitution], dict[str, object]]:
        """Parse `$(equals a b)`."""
        if len(data) != 2:
            raise TypeError(f"{cls._name} substitution expects 2 arguments")
        return cls, {"left": data[0], "right": data[1]}

    @property
    def left(self) -> list[Substitution]:
        """The first value."""
        return self.__left

    @property
    def right(self) -> list[Substitution]:
        """The second value."""
        return self.__right

    def describe(self) -> str:
        """Return a description such as `EqualsSubstitution('a' 'b')`."""
        return f"{type(self).__name__}({described(self.__left)} {described(self.__right)})"

    def equal(self, context: LaunchContext) -> bool:
        """Whether the values are equal now."""
        return _equal(perform_substitutions(context, self.__left), perform_substitutions(context, self.__right))

    def perform(self, context: LaunchContext) -> str:
        """Evaluate to `true` or `false`."""
        return word(self.equal(context))
