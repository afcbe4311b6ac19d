"""The parameters of a node: declaration, reading, descriptors."""

# pyright: reportPrivateUsage=false
# The modules of rclpy are one library: what its users are not to touch has an underscore, as upstream.

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import ParameterDescriptor
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from rclpy.impl.explanations import DECLARED, GIVEN_BY
from rclpy.node_parts.parameter_declarations import read_declaration
from rclpy.node_parts.parameter_descriptors import refusal
from rclpy.node_parts.parameter_names import listed
from rclpy.node_parts.parameter_provenance import IN_CODE, report_declared
from rclpy.node_parts.parameter_setting import NOT_SET, ParameterSetting
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, Parameter

if TYPE_CHECKING:
    from rcl_interfaces.msg import ListParametersResult, ParameterValue


class NodeParameters(ParameterSetting):
    """Methods of `Node` that declare and read parameters."""

    if TYPE_CHECKING:

        def get_fully_qualified_name(self) -> str:
            """Namespace and name, implemented by `Node`."""
            ...

    def _ros_init_parameters(
        self,
        arguments: Sequence[Any],
        parameter_overrides: Sequence[Parameter] | None,
        allow_undeclared: bool,
        automatic: bool,
    ) -> None:
        """Collect this node's overrides: from the command lines, the context's first, then from the code."""
        self._parameters = {}
        self._descriptors = {}
        self._allow_undeclared_parameters = allow_undeclared
        self._pre_set_parameters_callbacks = []
        self._on_set_parameters_callbacks = []
        self._post_set_parameters_callbacks = []
        self._ros_event_node_name = name = self.get_fully_qualified_name()
        self._parameter_overrides: dict[str, Parameter] = {}
        self._ros_override_sources: dict[str, str] = {}
        for each in arguments:
            for key, value in each.parameters.for_node(name).items():
                self._parameter_overrides[key] = Parameter(key, value=value)
            self._ros_override_sources.update(each.parameters.sources_for_node(name))
        for parameter in parameter_overrides or ():
            self._parameter_overrides[parameter.name] = parameter
            self._ros_override_sources[parameter.name] = IN_CODE
        if automatic:
            given = [(each.name, each.value, ParameterDescriptor()) for each in self._parameter_overrides.values()]
            self.declare_parameters("", given, ignore_override=True)

    def declare_parameter(
        self,
        name: str,
        value: Any = None,
        descriptor: ParameterDescriptor | None = None,
        ignore_override: bool = False,
    ) -> Parameter:
        """Declare a parameter by a default value or a `Parameter.Type`; an override takes precedence.

        Raises `ParameterAlreadyDeclaredException`, `InvalidParameterException`, `InvalidParameterTypeException`,
        `InvalidParameterValueException`, `TypeError` and `ValueError`.
        """
        if value is None and descriptor is None:
            declaration: tuple[Any, ...] = (name,)
        else:
            declaration = (name, value, ParameterDescriptor() if descriptor is None else descriptor)
        return self.declare_parameters("", [declaration], ignore_override)[0]

    def declare_parameters(
        self, namespace: str, parameters: Sequence[Sequence[Any]], ignore_override: bool = False
    ) -> list[Parameter]:
        """Declare tuples (name[, value or type[, descriptor]]); each name is prefixed with the namespace and a dot.

        Nothing is declared if a tuple is invalid or a name is taken; a refused value leaves those before it
        declared. Raises what `declare_parameter` raises.
        """
        overrides = {} if ignore_override else self._parameter_overrides
        found: list[Parameter] = []
        descriptors: dict[str, ParameterDescriptor] = {}
        for index, declaration in enumerate(parameters):
            parameter, descriptor = read_declaration(index, declaration, namespace, overrides)
            found.append(parameter)
            descriptors[parameter.name] = descriptor
        taken = [each.name for each in found if each.name in self._parameters]
        if taken:
            raise ParameterAlreadyDeclaredException(taken)
        for parameter in found:
            self._ros_declare(parameter, descriptors)
        words = zip((each.name for each in found), parameters, strict=True)
        declared = [self._parameters[each.name] for each in found]
        sources = {} if ignore_override else self._ros_override_sources
        report_declared(self._ros_event_node_name, words, (each.value for each in declared), sources)
        return declared

    def _ros_declare(self, parameter: Parameter, descriptors: dict[str, ParameterDescriptor]) -> None:
        result = self._ros_commit([parameter], descriptors, keep_not_set=True)
        if result.successful:
            return
        name = parameter.name
        error: InvalidParameterTypeException | InvalidParameterValueException
        if result.reason.startswith("Wrong parameter type"):
            error = InvalidParameterTypeException(parameter, Parameter.Type(descriptors[name].type).name)
        else:
            error = InvalidParameterValueException(name, parameter.value, result.reason)
        setattr(error, GIVEN_BY, (self._ros_override_sources.get(name, ""), self._ros_event_node_name, name))
        raise error

    def _ros_undeclared(self, name: str) -> ParameterNotDeclaredException:
        error = ParameterNotDeclaredException(name)
        setattr(error, DECLARED, self._parameters)
        return error

    def undeclare_parameter(self, name: str) -> None:
        """Remove a parameter, without event or callback.

        Raises `ParameterNotDeclaredException`, and `ParameterImmutableException` for a read-only one.
        """
        if name not in self._parameters:
            raise self._ros_undeclared(name)
        if self._descriptors[name].read_only:
            raise ParameterImmutableException(name)
        del self._parameters[name]
        del self._descriptors[name]

    def has_parameter(self, name: str) -> bool:
        """Whether a parameter is declared."""
        return name in self._parameters

    def get_parameter(self, name: str) -> Parameter:
        """A parameter; raises `ParameterNotDeclaredException` and `ParameterUninitializedException`.

        If undeclared parameters are allowed, an undeclared one is returned as NOT_SET.
        """
        parameter = self._parameters.get(name)
        if parameter is None:
            if self._allow_undeclared_parameters:
                return Parameter(name, NOT_SET, None)
            raise self._ros_undeclared(name)
        if parameter._type_ is NOT_SET and not self._descriptors[name].dynamic_typing:
            raise ParameterUninitializedException(name)
        return parameter

    def get_parameters(self, names: Sequence[str]) -> list[Parameter]:
        """Several parameters; raises what `get_parameter` raises, and `TypeError` for a name that is not a string."""
        _check_names(names)
        return [self.get_parameter(name) for name in names]

    def get_parameter_or(self, name: str, alternative_value: Any = None) -> Any:
        """A parameter; if it has no value, the alternative itself, or a NOT_SET parameter without one."""
        parameter = self._parameters.get(name)
        if parameter is not None and parameter._type_ is not NOT_SET:
            return parameter
        return Parameter(name, NOT_SET) if alternative_value is None else alternative_value

    def get_parameter_type(self, name: str) -> Any:
        """The code of a parameter's type, 0 while it has no value; raises `ParameterNotDeclaredException`.

        If undeclared parameters are allowed, it is `Parameter.Type.NOT_SET` for an undeclared one, as upstream.
        """
        if name in self._parameters:
            return self._parameters[name].type_.value
        if self._allow_undeclared_parameters:
            return NOT_SET
        raise self._ros_undeclared(name)

    def get_parameter_types(self, names: Sequence[str]) -> list[Any]:
        """The types of several parameters; raises what `get_parameter_type` raises, and `TypeError`."""
        _check_names(names)
        return [self.get_parameter_type(name) for name in names]

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter]:
        """The parameters below a prefix, by the rest of their names; all parameters for an empty prefix."""
        start = prefix + PARAMETER_SEPARATOR_STRING if prefix else prefix
        length = len(start)
        return {name[length:]: parameter for name, parameter in self._parameters.items() if name.startswith(start)}

    def list_parameters(self, prefixes: list[str], depth: int) -> ListParametersResult:
        """The names below prefixes, at most `depth` levels deep (0 for any), with the prefixes that they have.

        Raises `TypeError` and `ValueError`.
        """
        from rcl_interfaces.msg import ListParametersResult

        names = listed(self._parameters, prefixes, depth)
        found = dict.fromkeys(name.rpartition(PARAMETER_SEPARATOR_STRING)[0] for name in names if "." in name)
        return ListParametersResult(names=names, prefixes=list(found))

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """The descriptor of a parameter, the very object that it was declared with.

        Raises `ParameterNotDeclaredException`; if undeclared ones are allowed, returns a default descriptor instead.
        """
        if name in self._descriptors:
            return self._descriptors[name]
        if self._allow_undeclared_parameters:
            return ParameterDescriptor()
        raise self._ros_undeclared(name)

    def describe_parameters(self, names: Sequence[str]) -> list[ParameterDescriptor]:
        """The descriptors of several parameters; raises what `describe_parameter` raises."""
        return [self.describe_parameter(name) for name in names]

    def set_descriptor(
        self, name: str, descriptor: ParameterDescriptor, alternative_value: ParameterValue | None = None
    ) -> ParameterValue:
        """Replace a parameter's descriptor; the alternative becomes its value if the old value does not fit.

        Raises `ParameterNotDeclaredException`, `ParameterImmutableException` and `InvalidParameterValueException`.
        """
        if name not in self._parameters:
            return self.get_parameter(name).get_parameter_value()
        if self._descriptors[name].read_only:
            raise ParameterImmutableException(name)
        kept = self.get_parameter(name)
        if self._ros_misfit(kept, descriptor) is not None:
            if alternative_value is not None:
                kept = _from_value(name, alternative_value)
            reason = self._ros_misfit(kept, descriptor)
            if reason is not None:
                raise InvalidParameterValueException(name, kept.value, reason)
        self._parameters[name] = kept
        self._descriptors[name] = descriptor
        return self.get_parameter(name).get_parameter_value()

    def _ros_misfit(self, parameter: Parameter, descriptor: ParameterDescriptor) -> str | None:
        return refusal(parameter, descriptor, check_read_only=False, declared=True, tolerance=self.PARAM_REL_TOL)


def _check_names(names: Sequence[Any]) -> None:
    if not all(isinstance(name, str) for name in names):
        raise TypeError("All names must be instances of type str")


def _from_value(name: str, value: ParameterValue) -> Parameter:
    from rcl_interfaces.msg import Parameter as ParameterMsg

    return Parameter.from_parameter_msg(ParameterMsg(name=name, value=value))
