"""The common part of substitutions that evaluate other substitutions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.substitution import Substitution


def described(subs: Iterable[Substitution]) -> str:
    """Return the descriptions of substitutions, joined by plus signs."""
    return " + ".join(each.describe() for each in subs)


def bool_of(context: LaunchContext, subs: Iterable[Substitution]) -> bool:
    """Return the boolean value of a text by YAML's rules; raises `SubstitutionFailure` if it has none."""
    from launch.substitutions.substitution_failure import SubstitutionFailure
    from launch.utilities.type_utils import perform_typed_substitution

    try:
        return perform_typed_substitution(context, list(subs), bool)
    except (TypeError, ValueError) as error:
        raise SubstitutionFailure(error) from error


def word(value: bool) -> str:
    """Return `true` or `false`."""
    return "true" if value else "false"
