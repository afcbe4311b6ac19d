"""Parameters for all subsequent nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from launch.action import Action
from launch.frontend import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.parameter_warnings import warn_of_argument
from launch_ros.utilities import evaluate_parameter_dict, normalize_parameter_dict

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution
    from launch_ros.utilities.normalize_parameters import Key

KEY = "global_params"


@expose_action("set_parameter")
class SetParameter(Action):
    """Sets a parameter of all subsequent nodes."""

    def __init__(self, name: SomeSubstitutionsType, value: Any, **kwargs: Condition | None) -> None:
        super().__init__(**kwargs)
        self.__param_dict = normalize_parameter_dict({_key(name): value})

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[SetParameter], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        kwargs["value"] = parser.parse_substitution(entity.get_attr("value"))
        return cls, kwargs

    @property
    def name(self) -> Key:
        """The parameter's name."""
        return next(iter(self.__param_dict))

    @property
    def value(self) -> Any:
        """The parameter's value."""
        return next(iter(self.__param_dict.values()))

    def execute(self, context: LaunchContext) -> None:
        """Set the parameter."""
        evaluated = evaluate_parameter_dict(context, self.__param_dict)
        for name, value in evaluated.items():
            warn_of_argument(name, value, self.origin)
        context.launch_configurations.setdefault(KEY, [])
        context.launch_configurations[KEY].extend(evaluated.items())


@expose_action("set_parameters_from_file")
class SetParametersFromFile(Action):
    """Passes a parameter file to all subsequent nodes."""

    def __init__(self, filename: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(**kwargs)
        self.__file = normalize_to_list_of_substitutions(filename)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[SetParametersFromFile], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["filename"] = parser.parse_substitution(entity.get_attr("filename"))
        return cls, kwargs

    @property
    def filename(self) -> list[Substitution]:
        """The path of the file."""
        return self.__file

    def execute(self, context: LaunchContext) -> None:
        """Add the file."""
        context.launch_configurations.setdefault(KEY, [])
        context.launch_configurations[KEY].append(perform_substitutions(context, self.__file))


def _key(name: object) -> Any:
    if not isinstance(name, list):
        return name
    pieces = cast("list[Any]", name)
    return tuple(pieces)
