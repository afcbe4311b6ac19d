"""Whether two values differ."""

from __future__ import annotations

from typing import Any

from launch.frontend import expose_substitution
from launch.substitutions.equals_substitution import EqualsSubstitution
from launch.substitutions.joined import word


@expose_substitution("not-equals")
class NotEqualsSubstitution(EqualsSubstitution):
    """Whether two values differ."""

    _name = "not-equals"

    def perform(self, context: Any) -> str:
        """`true` or `false`."""
        return word(not self.equal(context))
