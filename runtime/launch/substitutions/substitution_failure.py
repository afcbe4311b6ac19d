"""A substitution cannot be evaluated."""


class SubstitutionFailure(RuntimeError):
    """A substitution cannot be evaluated."""
