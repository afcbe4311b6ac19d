"""A condition that is neither true nor false."""


class InvalidConditionExpressionError(ValueError):
    """A condition that is neither true nor false."""
