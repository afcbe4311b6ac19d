"""A node that a container loads."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.utilities import normalize_to_list_of_substitutions
from launch_ros.utilities import normalize_parameters, normalize_remap_rules

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution
    from launch_ros.remap_rule_type import SomeRemapRules


class ComposableNode:
    """A node class that a running container loads."""

    def __init__(
        self,
        *,
        package: SomeSubstitutionsType,
        plugin: SomeSubstitutionsType,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        parameters: object = None,
        remappings: SomeRemapRules | None = None,
        extra_arguments: object = None,
        condition: object = None,
    ) -> None:
        self.__package = normalize_to_list_of_substitutions(package)
        self.__plugin = normalize_to_list_of_substitutions(plugin)
        self.__name = None if name is None else normalize_to_list_of_substitutions(name)
        self.__namespace = None if namespace is None else normalize_to_list_of_substitutions(namespace)
        self.__parameters = None if parameters is None else normalize_parameters(parameters)
        self.__remappings = list(normalize_remap_rules(remappings)) if remappings else None
        self.__extra_arguments = normalize_parameters(extra_arguments) if extra_arguments else None
        self.__condition = condition

    @classmethod
    def parse(cls, parser: Parser, entity: Entity) -> tuple[type[ComposableNode], dict[str, Any]]:
        """Parse the element in XML or YAML."""
        from launch_ros.actions.parse_parameters import parse_nested_parameters, parse_remappings

        kwargs: dict[str, Any] = {
            name: parser.parse_substitution(entity.get_attr(attribute))
            for name, attribute in (("package", "pkg"), ("plugin", "plugin"), ("name", "name"))
        }
        condition = parser.parse_condition(entity)
        if condition is not None:
            kwargs["condition"] = condition
        namespace = entity.get_attr("namespace", optional=True)
        if namespace is not None:
            kwargs["namespace"] = parser.parse_substitution(namespace)
        parameters = entity.get_attr("param", data_type=list, optional=True)
        if parameters is not None:
            kwargs["parameters"] = parse_nested_parameters(parameters, parser)
        remappings = parse_remappings(entity, parser)
        if remappings is not None:
            kwargs["remappings"] = remappings
        extra = entity.get_attr("extra_arg", data_type=list, optional=True)
        if extra is not None:
            kwargs["extra_arguments"] = [
                {
                    tuple(parser.parse_substitution(each.get_attr("name"))): parser.parse_substitution(
                        each.get_attr("value")
                    )
                }
                for each in extra
            ]
            for each in extra:
                each.assert_entity_completely_parsed()
        entity.assert_entity_completely_parsed()
        return cls, kwargs

    @property
    def package(self) -> list[Substitution]:
        """The package that contains the class."""
        return self.__package

    @property
    def node_plugin(self) -> list[Substitution]:
        """The class of the node."""
        return self.__plugin

    @property
    def node_name(self) -> list[Substitution] | None:
        """The node's name."""
        return self.__name

    @property
    def node_namespace(self) -> list[Substitution] | None:
        """The node's namespace."""
        return self.__namespace

    @property
    def parameters(self) -> Any:
        """The node's parameters."""
        return self.__parameters

    @property
    def remappings(self) -> list[Any] | None:
        """The node's remap rules."""
        return self.__remappings

    @property
    def extra_arguments(self) -> Any:
        """Extra arguments for the container."""
        return self.__extra_arguments

    def condition(self) -> Any:
        """Return the condition for loading it."""
        return self.__condition
