"""Boolean substitutions: not, and, or, any, all."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.joined import BinarySubstitution, bool_text, describe_all, evaluate_bool
from launch.utilities import normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("not")
class NotSubstitution(Substitution):
    """The negation of a truth value."""

    def __init__(self, value: SomeSubstitutionsType) -> None:
        super().__init__()
        self.__value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[NotSubstitution], dict[str, object]]:
        """Parse `$(not value)`."""
        if len(data) != 1:
            raise TypeError("not substitution expects 1 argument")
        return cls, {"value": data[0]}

    @property
    def value(self) -> list[Substitution]:
        """The value to negate."""
        return self.__value

    def describe(self) -> str:
        """Return a description such as `NotSubstitution('true')`."""
        return f"NotSubstitution({describe_all(self.__value)})"

    def perform(self, context: LaunchContext) -> str:
        """Evaluate to `true` or `false`."""
        return bool_text(not evaluate_bool(context, self.__value))


def _values(context: LaunchContext, *operands: list[Substitution]) -> list[bool]:
    """Evaluate all operands, even if the first ones already decide."""
    return [evaluate_bool(context, each) for each in operands]


@expose_substitution("and")
class AndSubstitution(BinarySubstitution):
    """Whether both operands are true."""

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__(left, right)  # error messages name this class

    def perform(self, context: LaunchContext) -> str:
        """Evaluate to `true` or `false`."""
        return bool_text(all(_values(context, self.left, self.right)))


@expose_substitution("or")
class OrSubstitution(BinarySubstitution):
    """Whether at least one operand is true."""

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__(left, right)  # error messages name this class

    def perform(self, context: LaunchContext) -> str:
        """Evaluate to `true` or `false`."""
        return bool_text(any(_values(context, self.left, self.right)))


class _VariadicSubstitution(Substitution):
    """Base of substitutions with any number of operands."""

    def __init__(self, *args: SomeSubstitutionsType) -> None:
        super().__init__()
        self.__args = [normalize_to_list_of_substitutions(each) for each in args]

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[Any, dict[str, object]]:
        """Parse any number of arguments."""

        def made(args: Any) -> Any:
            return cls(*args)

        return made, {"args": list(data)}

    @property
    def args(self) -> list[list[Substitution]]:
        """The operands."""
        return self.__args

    def describe(self) -> str:
        """Return a description such as `AnySubstitution('true' 'false')`."""
        return f"{type(self).__name__}({' '.join(describe_all(each) for each in self.__args)})"


@expose_substitution("any")
class AnySubstitution(_VariadicSubstitution):
    """Whether at least one of several operands is true."""

    def perform(self, context: LaunchContext) -> str:
        """Evaluate to `true` or `false`."""
        return bool_text(any(_values(context, *self.args)))


@expose_substitution("all")
class AllSubstitution(_VariadicSubstitution):
    """Whether all of several operands are true."""

    def perform(self, context: LaunchContext) -> str:
        """Evaluate to `true` or `false`."""
        return bool_text(all(_values(context, *self.args)))
