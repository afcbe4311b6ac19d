"""Normalize texts and substitutions to a list of substitutions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.some_substitutions_type import SomeSubstitutionsType


def normalize_to_list_of_substitutions(subs: SomeSubstitutionsType) -> list[Substitution]:
    """Return a list of substitutions; raises `TypeError` for anything other than texts and substitutions."""
    from launch.substitutions.text_substitution import TextSubstitution

    def one(item: object) -> Substitution:
        if isinstance(item, Substitution):
            return item
        if isinstance(item, (str, Path)):
            return TextSubstitution(text=str(item))
        raise TypeError(
            f"Failed to normalize given item of type '{type(item)}', when only 'str' or 'launch.Substitution' "
            "were expected."
        )

    if isinstance(subs, (str, Path, Substitution)):
        return [one(subs)]
    return [one(each) for each in subs]
