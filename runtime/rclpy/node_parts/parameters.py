"""The parameters of a node: declaration, reading, descriptors."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

from bot_console.runtime.process.reported_facts import anybody_listens, report_fact
from bot_console.runtime.process.stack_frames import line_outside
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterDescriptor, ParameterValue
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from rclpy.impl.explanations import DECLARED, GIVEN_BY
from rclpy.node_parts.parameter_setting import NOT_SET, ParameterSetting, refusal
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, Parameter
from rclpy.validate_parameter_name import validate_parameter_name

if TYPE_CHECKING:
    from bot_console.runtime.rmw.arguments import Arguments
    from rcl_interfaces.msg import ListParametersResult


class NodeParameters(ParameterSetting):
    """Methods of `Node` that declare and read parameters."""

    def _ros_init_parameters(
        self,
        arguments: Sequence[Arguments],
        parameter_overrides: Sequence[Parameter] | None,
        allow_undeclared: bool,
        automatic: bool,
    ) -> None:
        """Collect this node's overrides: from the command lines, starting with the context's, then from the code."""
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
        value: object = None,
        descriptor: ParameterDescriptor | None = None,
        ignore_override: bool = False,
    ) -> Parameter:
        """Declare a parameter with a default value or a `Parameter.Type`; an override takes precedence.

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

        Nothing is declared if a tuple is invalid or a name is taken; if a value is refused, the parameters before it
        stay declared. Raises what `declare_parameter` raises.
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
        """Return a parameter; raises `ParameterNotDeclaredException` and `ParameterUninitializedException`.

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
        """Return several parameters; raises what `get_parameter` raises, and `TypeError` if a name is not a string."""
        _check_names(names)
        return [self.get_parameter(name) for name in names]

    def get_parameter_or(self, name: str, alternative_value: object = None) -> Any:
        """Return a parameter; if it has no value, the alternative itself, or a NOT_SET parameter without one."""
        parameter = self._parameters.get(name)
        if parameter is not None and parameter._type_ is not NOT_SET:
            return parameter
        return Parameter(name, NOT_SET) if alternative_value is None else alternative_value

    def get_parameter_type(self, name: str) -> Any:
        """Return the code of a parameter's type, 0 while it has no value; raises `ParameterNotDeclaredException`.

        If undeclared parameters are allowed, it is, as upstream, `Parameter.Type.NOT_SET` for an undeclared one.
        """
        if name in self._parameters:
            return self._parameters[name].type_.value
        if self._allow_undeclared_parameters:
            return NOT_SET
        raise self._ros_undeclared(name)

    def get_parameter_types(self, names: Sequence[str]) -> list[Any]:
        """Return the types of several parameters; raises what `get_parameter_type` raises, and `TypeError`."""
        _check_names(names)
        return [self.get_parameter_type(name) for name in names]

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter]:
        """Return the parameters below a prefix, by the rest of their names; all parameters for an empty prefix."""
        start = prefix + PARAMETER_SEPARATOR_STRING if prefix else prefix
        length = len(start)
        return {name[length:]: parameter for name, parameter in self._parameters.items() if name.startswith(start)}

    def list_parameters(self, prefixes: list[str], depth: int) -> ListParametersResult:
        """Return the names below prefixes, at most `depth` levels deep (0 for any depth), and the prefixes that occur
        in them.

        Raises `TypeError` and `ValueError`.
        """
        from rcl_interfaces.msg import ListParametersResult

        names = list_names(self._parameters, prefixes, depth)
        found = dict.fromkeys(name.rpartition(PARAMETER_SEPARATOR_STRING)[0] for name in names if "." in name)
        return ListParametersResult(names=names, prefixes=list(found))

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """Return the descriptor of a parameter: the same object with which it was declared.

        Raises `ParameterNotDeclaredException`; if undeclared ones are allowed, it returns a default descriptor instead.
        """
        if name in self._descriptors:
            return self._descriptors[name]
        if self._allow_undeclared_parameters:
            return ParameterDescriptor()
        raise self._ros_undeclared(name)

    def describe_parameters(self, names: Sequence[str]) -> list[ParameterDescriptor]:
        """Return the descriptors of several parameters; raises what `describe_parameter` raises."""
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
    return Parameter.from_parameter_msg(ParameterMsg(name=name, value=value))


ANY_DEPTH = 0


def list_names(names: Iterable[str], prefixes: object, depth: object) -> list[str]:
    """Return the names that `list_parameters` returns, in its order; raises `TypeError` and `ValueError`."""
    if not isinstance(prefixes, list):
        raise TypeError("The prefixes argument must be a list")
    wanted = cast("list[Any]", prefixes)
    if not all(isinstance(prefix, str) for prefix in wanted):
        raise TypeError("All prefixes must be instances of type str")
    if not isinstance(depth, int):
        raise TypeError("The depth must be instance of type int")
    if depth < 0:
        raise ValueError("The depth must be greater than or equal to zero")
    if not prefixes:
        return [name for name in names if _shallow(name, depth)]
    return [name for name in names if any(_below(name, prefix, depth) for prefix in wanted)]


def _shallow(name: str, depth: int) -> bool:
    return depth == ANY_DEPTH or name.count(PARAMETER_SEPARATOR_STRING) < depth


def _below(name: str, prefix: str, depth: int) -> bool:
    start = prefix + PARAMETER_SEPARATOR_STRING
    return name == prefix or (name.startswith(start) and _shallow(name[len(start) :], depth))


IN_CODE = "parameter_overrides of its program"


def report_declared(
    node: str, declared: Iterable[tuple[str, Sequence[object]]], values: Iterable[object], sources: Mapping[str, str]
) -> None:
    """Report a node's declarations (full name, tuple) and the resulting values, if anybody listens.

    `sources` are the sources of overrides. A default that is not a plain value, such as a type, is reported as None.
    """
    if not anybody_listens():
        return
    place = line_outside(sys._getframe(1))  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
    report_fact(
        "declared",
        node=node,
        parameters=[
            [name, _plain(words[1] if len(words) > 1 else None), place, sources.get(name, ""), _plain(value)]
            for (name, words), value in zip(declared, values, strict=True)
        ],
    )


def _plain(value: Any) -> Any:
    """Convert a scalar or a list of scalars for JSON; bytes, which JSON lacks, to `{"byte": 0 .. 255}`; else None."""
    if isinstance(value, (bool, int, float, str)) or value is None:
        return value
    if isinstance(value, Parameter.Type):
        return None
    plain = getattr(value, "tolist", None)
    try:
        items = plain() if plain is not None else list(value)
    except TypeError:
        return None
    items = [{"byte": each[0]} if isinstance(each, bytes) and each else each for each in items]
    return items if all(isinstance(each, (bool, int, float, str, dict)) for each in items) else None


NAME_ONLY = """when declaring parameter named '{}', declaring a parameter only providing its name is deprecated. \
You have to either:
\t- Pass a name and a default value different to "PARAMETER NOT SET" (and optionally a descriptor).
\t- Pass a name and a parameter type.
\t- Pass a name and a descriptor with `dynamic_typing=True"""
STATIC_NOT_SET = "Cannot declare a statically typed parameter with default value of type PARAMETER_NOT_SET"
TYPE_AND_DYNAMIC = (
    "When declaring parameter {{{}}} passing a descriptor with`dynamic_typing=True` "
    "is not allowed when the parameter type is provided"
)


def read_declaration(
    index: int, declaration: Sequence[Any], namespace: str, overrides: Mapping[str, Parameter]
) -> tuple[Parameter, ParameterDescriptor]:
    """Return the parameter that a tuple declares, with the value of its override if there is one, and its descriptor.

    The declared type is written into the descriptor. Raises `TypeError`, `ValueError` and
    `InvalidParameterException`.
    """
    if not 1 <= len(declaration) <= 3:
        raise TypeError(
            f"Invalid parameter tuple length at index {index} in parameters list: {declaration}; "
            "expecting length between 1 and 3"
        )
    name = _full_name(index, declaration[0], namespace)
    descriptor = _descriptor(index, declaration)
    if len(declaration) == 1:
        warnings.warn(NAME_ONLY.format(name), stacklevel=4)
        descriptor.dynamic_typing = True
    default = declaration[1] if len(declaration) > 1 else None
    if isinstance(default, Parameter.Type):
        _set_type(name, default, descriptor)
        value = None
    else:
        _infer_type(default, descriptor)
        value = default
    if name in overrides:
        value = overrides[name].value
    return Parameter(name, value=value), descriptor


def _full_name(index: int, name: object, namespace: str) -> str:
    if not isinstance(name, str):
        raise TypeError(f"First element {name} at index {index} in parameters list is not a str.")
    name = f"{namespace}.{name}" if namespace else name
    validate_parameter_name(name)
    return name


def _descriptor(index: int, declaration: Sequence[Any]) -> ParameterDescriptor:
    if len(declaration) < 3:
        return ParameterDescriptor()
    descriptor = declaration[2]
    if not isinstance(descriptor, ParameterDescriptor):
        raise TypeError(f"Third element {descriptor} at index {index} in parameters list is not a ParameterDescriptor.")
    return descriptor


def _set_type(name: str, wanted: Parameter.Type, descriptor: ParameterDescriptor) -> None:
    """Set the descriptor's type to the declared type; raises `ValueError`."""
    if wanted == Parameter.Type.NOT_SET:
        raise ValueError(f"Cannot declare parameter {{{name}}} as statically typed of type NOT_SET")
    if descriptor.dynamic_typing is True:
        raise ValueError(TYPE_AND_DYNAMIC.format(name))
    descriptor.type = wanted.value


def _infer_type(default: Any, descriptor: ParameterDescriptor) -> None:
    """Set the descriptor's type to that of a default value, except with dynamic typing; raises `ValueError`."""
    if descriptor.dynamic_typing:
        return
    if isinstance(default, ParameterValue):
        descriptor.type = default.type
    else:
        descriptor.type = Parameter.Type.from_parameter_value(default).value
    if descriptor.type == Parameter.Type.NOT_SET.value:
        raise ValueError(STATIC_NOT_SET)
