"""Running a node."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import launch.logging
from launch.actions import ExecuteProcess
from launch.child import PythonProgram
from launch.descriptions.executable import warn_of_text
from launch.frontend import expose_action
from launch.substitutions import LocalSubstitution, TextSubstitution
from launch.utilities import ensure_argument_type, normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.missing_executables import may_start
from launch_ros.node_program import is_this_python, os_command, program_of
from launch_ros.parameter_arguments import ParameterArgument, global_parameter_arguments, own_parameter_arguments
from launch_ros.parameter_sources import report_given
from launch_ros.parameter_warnings import warn_of_files, warn_of_values
from launch_ros.substitutions import ExecutableInPackage
from launch_ros.utilities import (
    add_node_name,
    evaluate_parameters,
    get_node_name_count,
    make_namespace_absolute,
    normalize_parameters,
    normalize_remap_rules,
    prefix_namespace,
    warn_of_same_name,
)
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch_ros.parameters_type import SomeParameters
    from launch_ros.remap_rule_type import SomeRemapRules

LOCALS = "ros_specific_arguments"


@expose_action("node")
class Node(ExecuteProcess):
    """Runs an executable as a node, with names, parameters and remap rules on its command line."""

    UNSPECIFIED_NODE_NAME = "<node_name_unspecified>"
    UNSPECIFIED_NODE_NAMESPACE = "<node_namespace_unspecified>"

    def __init__(
        self,
        *,
        executable: SomeSubstitutionsType,
        package: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        exec_name: SomeSubstitutionsType | None = None,
        parameters: SomeParameters | None = None,
        remappings: SomeRemapRules | None = None,
        ros_arguments: Iterable[SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
        **kwargs: Any,
    ) -> None:
        cmd: list[SomeSubstitutionsType] = [
            executable if package is None else ExecutableInPackage(package=package, executable=executable)
        ]
        warn_of_text("arguments", arguments)
        cmd += [] if arguments is None else arguments
        if ros_arguments is not None:
            given: Any = ros_arguments
            cmd += ["--ros-args"] + given  # noqa: RUF005 -- fails as upstream does for what is no list
        cmd += ["--ros-args"]
        if name is not None:
            cmd += ["-r", LocalSubstitution(f"{LOCALS}['name']", description="node name")]
        if parameters is not None:
            ensure_argument_type(parameters, (list,), "parameters", "Node")
            parameters = normalize_parameters(parameters)
        if remappings is not None:
            remappings = list(normalize_remap_rules(remappings))
        super().__init__(cmd=cmd, name=exec_name, **kwargs)
        self.__package = package
        self.__executable = executable
        self.__name = name
        self.__namespace = namespace
        self.__parameters: list[Any] = [] if parameters is None else parameters
        self.__remappings: list[tuple[Any, Any]] = [] if remappings is None else remappings
        self.__arguments = arguments
        self.__ros_arguments = ros_arguments
        self.__expanded_name = self.UNSPECIFIED_NODE_NAME
        self.__expanded_namespace = self.UNSPECIFIED_NODE_NAMESPACE
        self.__expanded_parameters: list[ParameterArgument] | None = None
        self.__expanded_remappings: list[tuple[str, str]] | None = None
        self.__final_name: str | None = None
        self.__package_text: str | None = None
        self.__substitutions_performed = False
        self.__logger = launch.logging.get_logger(__name__)

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: Iterable[str] | None = None
    ) -> tuple[Any, dict[str, object]]:
        """Parse the element in XML or YAML."""
        from launch_ros.actions.parse_node import parse_node

        _, kwargs = super().parse(entity, parser, ignore=("cmd", "name", *(ignore or ())))
        return cls, parse_node(entity, parser, kwargs)

    @staticmethod
    def parse_nested_parameters(params: list[Entity], parser: Parser) -> list[Any]:
        """Parse `param` elements as a node's `parameters`; for third-party subclasses that need it."""
        from launch_ros.actions.parse_parameters import parse_nested_parameters

        return parse_nested_parameters(params, parser)

    @property
    def node_package(self) -> SomeSubstitutionsType | None:
        """The package of the executable."""
        return self.__package

    @property
    def node_executable(self) -> SomeSubstitutionsType:
        """The executable's name."""
        return self.__executable

    @property
    def node_name(self) -> str:
        """The node's full name; raises `RuntimeError` before the node was visited."""
        if self.__final_name is None:
            raise RuntimeError("cannot access 'node_name' before executing action")
        return self.__final_name

    @property
    def expanded_node_name(self) -> str:
        """The node's name without its namespace."""
        return self.__expanded_name

    @property
    def expanded_node_namespace(self) -> str:
        """The node's namespace."""
        return self.__expanded_namespace

    @property
    def expanded_parameter_arguments(self) -> list[ParameterArgument] | None:
        """The parameter arguments, each with whether it is a file."""
        return self.__expanded_parameters

    @property
    def expanded_remapping_rules(self) -> list[tuple[str, str]] | None:
        """The remap rules."""
        return self.__expanded_remappings

    @property
    def parameters(self) -> list[Any]:
        """The given parameters, normalized."""
        return self.__parameters

    def is_node_name_fully_specified(self) -> bool:
        """Whether name and namespace are both known."""
        return (
            self.UNSPECIFIED_NODE_NAME not in self.node_name and self.UNSPECIFIED_NODE_NAMESPACE not in self.node_name
        )

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Evaluate names, parameters and rules, then start the node."""
        self._perform_substitutions(context)
        if self.__package is not None and not may_start(context, self, self.__package_text):
            return None
        words = {"name": f"__node:={self.__expanded_name}"} if self.__name is not None else {}
        context.extend_locals({LOCALS: words})
        entities = super().execute(context)
        if self.is_node_name_fully_specified():
            self._count_name(context)
        elif self.__name is not None:
            warn_of_same_name(context, self._likely_name(), self.origin)
        return entities

    def _count_name(self, context: LaunchContext) -> None:
        add_node_name(context, self.node_name)
        count = get_node_name_count(context, self.node_name)
        if count > 1:
            launch.logging.get_logger(self.process_description.final_name).warning(
                f"there are now at least {count} nodes with the name {self.node_name} "
                "created within this launch context"
            )

    def _perform_substitutions(self, context: LaunchContext) -> None:
        if self.__substitutions_performed:
            return  # a second run of the same action fails shortly afterwards, with a message of its own
        self.__substitutions_performed = True
        if self.__package is not None:
            package = normalize_to_list_of_substitutions(self.__package)
            self.__package_text = perform_substitutions(context, package)
        self._expand_names(context)
        self._expand_parameters(context)
        self._expand_remappings(context)

    def _expand_names(self, context: LaunchContext) -> None:
        try:
            if self.__name is not None:
                self.__expanded_name = _evaluate(context, self.__name)
                validate_node_name(self.__expanded_name)
            own = None if self.__namespace is None else _evaluate(context, self.__namespace)
            base = context.launch_configurations.get("ros_namespace")
            namespace = make_namespace_absolute(prefix_namespace(base, own))
            if namespace is not None:
                self.__expanded_namespace = namespace or "/"
                self._add_words("-r", f"__ns:={self.__expanded_namespace}")
                validate_namespace(self.__expanded_namespace)
        except Exception:
            described = (
                f"package={self.__package}, executable={self.__executable}, name={self.__name}, "
                f"namespace={self.__namespace}"
            )
            self.__logger.error(f"Error while expanding or validating node name or namespace for '{described}':")
            raise
        self.__final_name = prefix_namespace(self.__expanded_namespace, self.__expanded_name)

    def _expand_parameters(self, context: LaunchContext) -> None:
        given = context.launch_configurations.get("global_params")
        if given is None and not self.__parameters:
            return
        self.__expanded_parameters = [] if given is None else global_parameter_arguments(given)
        target = self.node_name if self.is_node_name_fully_specified() else None
        report_given(context, self._likely_name(), self.__parameters, self.origin)
        evaluated = evaluate_parameters(context, self.__parameters)
        for entry, found in zip(self.__parameters, evaluated, strict=True):
            if isinstance(entry, dict):
                warn_of_values(context, cast("dict[Any, Any]", entry), found, self.origin)
        self.__expanded_parameters += own_parameter_arguments(context, evaluated, target, self.__logger, self.origin)
        if self.__name is not None:
            files = [str(each) for each in evaluated if isinstance(each, Path)]
            warn_of_files(files, self._likely_name(), self.origin)
        for argument, is_file in self.__expanded_parameters:
            self._add_words("--params-file" if is_file else "-p", argument)

    def _likely_name(self) -> str:
        """Return the full name, assuming the root namespace if none is known, as few programs choose another."""
        return self.node_name.replace(self.UNSPECIFIED_NODE_NAMESPACE, "")

    def _expand_remappings(self, context: LaunchContext) -> None:
        rules: list[tuple[str, str]] = list(context.launch_configurations.get("ros_remaps") or ())
        rules += [(_evaluate(context, source), _evaluate(context, target)) for source, target in self.__remappings]
        if rules:
            self.__expanded_remappings = rules
        for source, target in rules:
            self._add_words("-r", f"{source}:={target}")

    def _add_words(self, *words: str) -> None:
        self.process_description.cmd.extend([TextSubstitution(text=each)] for each in words)

    def python_program(self, command: list[str]) -> PythonProgram | None:
        """Return the node's program if it is a Python program whose prefix is empty or only Python itself."""
        prefix = self.process_description.words_of_prefix
        if self.shell or (prefix and not is_this_python(prefix)):
            return None
        return program_of(self.__package_text, command[len(prefix)])

    def words_for(self, program: PythonProgram | None, command: list[str]) -> list[str]:
        """Return the command as its program expects it, or as the system can run it."""
        prefix = len(self.process_description.words_of_prefix)
        return os_command(self.__package_text, command, prefix) if program is None else command[prefix:]


def _evaluate(context: LaunchContext, text: SomeSubstitutionsType) -> str:
    return perform_substitutions(context, normalize_to_list_of_substitutions(text))
