"""The common part of substitutions that evaluate other substitutions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


def describe_all(subs: Iterable[Substitution]) -> str:
    """Return the descriptions of substitutions, joined by plus signs."""
    return " + ".join(each.describe() for each in subs)


def evaluate_bool(context: LaunchContext, subs: Iterable[Substitution]) -> bool:
    """Return the boolean value of a text by YAML's rules; raises `SubstitutionFailure` if the text is not a boolean."""
    from launch.substitutions.substitution_failure import SubstitutionFailure
    from launch.utilities.type_utils import perform_typed_substitution

    try:
        return perform_typed_substitution(context, list(subs), bool)
    except (TypeError, ValueError) as error:
        raise SubstitutionFailure(error) from error


def bool_text(value: bool) -> str:
    """Return `true` or `false`."""
    return "true" if value else "false"


class BinarySubstitution(Substitution):
    """Base of substitutions with two operands."""

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__()
        self.__left = normalize_to_list_of_substitutions(left)
        self.__right = normalize_to_list_of_substitutions(right)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[BinarySubstitution], dict[str, object]]:
        """Parse two arguments, as in `$(and left right)`."""
        if len(data) != 2:
            raise TypeError("and substitution expects 2 arguments")  # any type is accepted, as upstream
        return cls, {"left": data[0], "right": data[1]}

    @property
    def left(self) -> list[Substitution]:
        """The first operand."""
        return self.__left

    @property
    def right(self) -> list[Substitution]:
        """The second operand."""
        return self.__right

    def describe(self) -> str:
        """Return a description such as `AndSubstitution('true' 'false')`."""
        return f"{type(self).__name__}({describe_all(self.__left)} {describe_all(self.__right)})"
