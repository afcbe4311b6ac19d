"""The value of a Python expression."""

from __future__ import annotations

import importlib
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.joined import describe_all
from launch.utilities import ensure_argument_type, normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("eval")
class PythonExpression(Substitution):
    """The value of a Python expression as text; names of the modules can be used with and without the module's name."""

    def __init__(self, expression: SomeSubstitutionsType, python_modules: object = ("math",)) -> None:
        super().__init__()
        kinds = str, Substitution, Iterable
        ensure_argument_type(expression, kinds, "expression", "PythonExpression")
        ensure_argument_type(python_modules, kinds, "python_modules", "PythonExpression")
        self.__expression = normalize_to_list_of_substitutions(expression)
        self.__modules = [normalize_to_list_of_substitutions(each) for each in _each(python_modules)]

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[PythonExpression], dict[str, object]]:
        """Parse `$(eval 'expression' 'module, module')`."""
        if not 1 <= len(data) <= 2:
            raise TypeError("eval substitution expects 1 or 2 arguments")
        kwargs: dict[str, Any] = {"expression": data[0]}
        if len(data) > 1:
            names = "".join(each.text for each in data[1])
            kwargs["python_modules"] = [name.strip() for name in names.split(",") if name.strip()]
        return cls, kwargs

    @property
    def expression(self) -> list[Substitution]:
        """The expression."""
        return self.__expression

    @property
    def python_modules(self) -> list[list[Substitution]]:
        """Names of the modules."""
        return self.__modules

    def describe(self) -> str:
        """Return a description such as `PythonExpr('1 + 1', ['math'])`."""
        modules = ", ".join(describe_all(each) for each in self.__modules)
        return f"PythonExpr({describe_all(self.__expression)}, [{modules}])"

    def perform(self, context: LaunchContext) -> str:
        """Return the value as text; raises what the expression raises."""
        modules = [importlib.import_module(perform_substitutions(context, each)) for each in self.__modules]
        names: dict[str, Any] = {}
        for module in modules:
            names.update(vars(module)) if module.__name__ == "math" else None
        names.update({module.__name__: module for module in modules})
        return str(eval(perform_substitutions(context, self.__expression), {}, names))


def _each(modules: Any) -> Iterable[Any]:
    return (modules,) if isinstance(modules, (str, Substitution)) else modules
