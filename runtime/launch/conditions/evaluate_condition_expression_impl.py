"""Evaluate a condition expression."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.conditions.invalid_condition_expression_error import InvalidConditionExpressionError
from launch.utilities import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.substitution import Substitution

VALID_TRUE_EXPRESSIONS = ["true", "1"]
VALID_FALSE_EXPRESSIONS = ["false", "0"]


def evaluate_condition_expression(context: LaunchContext, expression: list[Substitution]) -> bool:
    """Return the value of an expression; raises `InvalidConditionExpressionError` unless it is true, 1, false or 0."""
    expanded = perform_substitutions(context, expression).strip().lower()
    if expanded in VALID_TRUE_EXPRESSIONS:
        return True
    if expanded in VALID_FALSE_EXPRESSIONS:
        return False
    valid = ", ".join(VALID_TRUE_EXPRESSIONS + VALID_FALSE_EXPRESSIONS)
    origin = " + ".join(str(each) for each in expression)
    raise InvalidConditionExpressionError(
        f"invalid condition expression, expected one of [{valid}] but got '{expanded}', expanded from '{origin}'"
    )
