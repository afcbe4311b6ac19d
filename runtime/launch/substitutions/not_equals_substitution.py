"""Whether two values differ."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.frontend.expose import expose_substitution
from launch.substitutions.equals_substitution import EqualsSubstitution
from launch.substitutions.joined import bool_text

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_substitution("not-equals")
class NotEqualsSubstitution(EqualsSubstitution):
    """Whether two values differ."""

    def perform(self, context: LaunchContext) -> str:
        """Evaluate to `true` or `false`."""
        return bool_text(not self.equal(context))
