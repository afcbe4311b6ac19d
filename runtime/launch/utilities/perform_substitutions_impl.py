"""Evaluate a list of substitutions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


def perform_substitutions(context: LaunchContext, subs: Iterable[Any]) -> str:
    """Return the concatenated texts of all substitutions."""
    return "".join(context.perform_substitution(each) for each in subs)
