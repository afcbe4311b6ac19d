"""Whether two values are equal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, cast

from launch.frontend.expose import expose_substitution
from launch.substitutions.joined import BinarySubstitution, bool_text
from launch.utilities import perform_substitutions
from launch.utilities.type_utils import is_substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

TRUTH = {"true": True, "1": True, "false": False, "0": False}


def _operand(value: object) -> SomeSubstitutionsType:
    """Return a value without substitutions as text: a boolean as launch files write it, None as an empty text."""
    if is_substitution(value):
        return cast("SomeSubstitutionsType", value)
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value)


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
class EqualsSubstitution(BinarySubstitution):
    """Whether two values are equal as booleans, otherwise as numbers, otherwise as texts."""

    def __init__(self, left: object, right: object) -> None:
        super().__init__(_operand(left), _operand(right))

    def equal(self, context: LaunchContext) -> bool:
        """Whether the values are equal now."""
        return _equal(perform_substitutions(context, self.left), perform_substitutions(context, self.right))

    def perform(self, context: LaunchContext) -> str:
        """Evaluate to `true` or `false`."""
        return bool_text(self.equal(context))
