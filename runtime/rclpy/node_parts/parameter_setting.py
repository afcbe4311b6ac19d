"""How a node sets its parameters: callbacks, checks and the event, in the order of Jazzy."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import gc
import math
import warnings
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.rmw.parameter_scalars import INT64_MAX, INT64_MIN
from bot_console.runtime.rmw.parameter_types import DOUBLE, INTEGER
from builtin_interfaces.msg import Time
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterDescriptor, ParameterEvent, ParameterValue, SetParametersResult
from rclpy.constants import S_TO_NS
from rclpy.exceptions import ParameterNotDeclaredException
from rclpy.impl.explanations import DECLARED, invalid_result
from rclpy.impl.parameter_values import FIELDS
from rclpy.node_parts.entities import NodeEntities
from rclpy.parameter import Parameter

if TYPE_CHECKING:
    from rclpy.clock import Clock
    from rclpy.publisher import Publisher

EMPTIED = (
    "parameter list cannot be empty, this might be due to pre_set_parameters_callback "
    "modifying the original parameters list."
)
NOT_SET = Parameter.Type.NOT_SET
MAX_PARAMETERS_WITH_GC = 100
"""Above this number the garbage collector is paused: it would examine the growing event again and again."""

Setter = Callable[[Any], Any]
"""A callback; it gets the list of parameters, or the sequence that the caller has passed."""


def _refuse_invalid_result(callback: Setter, result: object) -> SetParametersResult:
    """Return the refusal for a callback that did not return a `SetParametersResult`, after logging a warning."""
    warnings.warn("Callback returned an invalid type, it should return SetParameterResult.", stacklevel=1)
    hint = invalid_result(callback, result)
    if hint:
        notify(current(), hint)
    return _refusal_result("Callback returned an invalid type")


def _check_callable(callback: object) -> None:
    if not callable(callback):
        raise TypeError("Callback must be callable, got {}", type(callback))  # logged unformatted, as upstream


def _refusal_result(reason: str) -> SetParametersResult:
    return SetParametersResult(successful=False, reason=reason)


class ParameterSetting(NodeEntities):
    """Methods of `Node` that change values. The callback added last is called first."""

    PARAM_REL_TOL: float
    _pre_set_parameters_callbacks: list[Setter]
    _on_set_parameters_callbacks: list[Setter]
    _post_set_parameters_callbacks: list[Setter]
    _parameter_event_publisher: Publisher
    _clock: Clock
    _ros_event_node_name: str

    def set_parameters(self, parameter_list: Sequence[Parameter]) -> list[SetParametersResult]:
        """Set parameters one after the other; returns one result for each.

        Raises `ParameterNotDeclaredException` at the first undeclared one; those before it stay set.
        """
        return [self._set_parameters_atomically([parameter]) for parameter in parameter_list]

    def set_parameters_atomically(self, parameter_list: Sequence[Parameter]) -> SetParametersResult:
        """Set all parameters or none; raises `ParameterNotDeclaredException` if one is undeclared."""
        return self._set_parameters_atomically(parameter_list)

    def _set_parameters_atomically(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        if self._pre_set_parameters_callbacks:
            parameters = [each for callback in self._pre_set_parameters_callbacks for each in callback(parameters)]
            if not parameters:
                return _refusal_result(EMPTIED)
        self._ros_check_declared(parameters)
        return self._ros_commit(parameters)

    def _ros_check_declared(self, parameters: Sequence[Parameter]) -> None:
        for parameter in parameters:
            if not isinstance(parameter, Parameter):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
                raise TypeError(f"parameter must be instance of type '{Parameter!r}'")
        if self._allow_undeclared_parameters:
            return
        known = self._parameters
        undeclared = (parameter._name for parameter in parameters if parameter._name not in known)
        # As upstream, `any` consumes the names up to the first non-empty one, and the message lists the rest.
        if any(undeclared):
            error = ParameterNotDeclaredException(list(undeclared))
            setattr(error, DECLARED, known)
            raise error

    def _ros_commit(
        self,
        parameters: Sequence[Parameter],
        descriptors: dict[str, ParameterDescriptor] | None = None,
        *,
        keep_not_set: bool = False,
    ) -> SetParametersResult:
        """Check the values, run the callbacks, store and publish; `descriptors` are those of a new declaration.

        A NOT_SET parameter is deleted unless `keep_not_set` is set.
        """
        reason = self._ros_refusal(parameters, descriptors)
        if reason is not None:
            return _refusal_result(reason)
        for callback in self._on_set_parameters_callbacks:
            result = callback(parameters)
            if not isinstance(result, SetParametersResult):
                return _refuse_invalid_result(callback, result)
            if not result.successful:
                return result
        self._ros_use()  # the event needs the node's name; a destroyed node refuses it here, before anything is stored
        publisher = self._parameter_event_publisher
        if publisher._is_wanted():
            publisher._publish_own(self._ros_store_and_notify(parameters, descriptors, keep_not_set))
        else:
            self._ros_store(parameters, descriptors, keep_not_set, check_carried)
            publisher._skip()
        for callback in self._post_set_parameters_callbacks:
            callback(parameters)
        return SetParametersResult(successful=True, check_fields=False)

    def _ros_refusal(
        self, parameters: Sequence[Parameter], descriptors: dict[str, ParameterDescriptor] | None
    ) -> str | None:
        known = self._descriptors if descriptors is None else descriptors
        for parameter in parameters:
            name = parameter._name
            if name in known:
                reason = refusal(
                    parameter,
                    known[name],
                    check_read_only=descriptors is None,
                    declared=name in self._parameters,
                    tolerance=self.PARAM_REL_TOL,
                )
                if reason is not None:
                    return reason
        return None

    def _ros_store_and_notify(
        self, parameters: Sequence[Parameter], descriptors: dict[str, ParameterDescriptor] | None, keep_not_set: bool
    ) -> ParameterEvent:
        """Store the values; returns the event for all of them."""
        pause = len(parameters) > MAX_PARAMETERS_WITH_GC and gc.isenabled()
        if pause:
            gc.disable()
        try:
            return self._ros_store(parameters, descriptors, keep_not_set, event_parameter)
        finally:
            if pause:
                gc.enable()

    def _ros_store(
        self,
        parameters: Sequence[Parameter],
        descriptors: dict[str, ParameterDescriptor] | None,
        keep_not_set: bool,
        convert: Callable[[Parameter], Any],
    ) -> ParameterEvent:
        """Store the values; returns the event that consists of `convert(parameter)` for each."""
        stored = self._parameters
        new: list[ParameterMsg] = []
        changed: list[ParameterMsg] = []
        deleted: list[ParameterMsg] = []
        for parameter in parameters:
            name = parameter._name
            if parameter._type_ is NOT_SET and not keep_not_set:
                stored.pop(name, None)
                self._descriptors.pop(name, None)
                deleted.append(convert(parameter))
                continue
            if descriptors is not None:
                self._descriptors[name] = descriptors[name]
            elif name not in self._descriptors:
                self._descriptors[name] = ParameterDescriptor(dynamic_typing=True)
            before = stored.get(name)
            (new if before is None or before._type_ is NOT_SET else changed).append(convert(parameter))
            stored[name] = parameter
        return parameter_event(self._ros_event_node_name, self._clock._now_ns(), new, changed, deleted)

    def add_pre_set_parameters_callback(self, callback: Callable[[list[Parameter]], list[Parameter]]) -> None:
        """Add a callback that gets the parameters before any check, and returns those to be set instead."""
        self._pre_set_parameters_callbacks.insert(0, callback)

    def add_on_set_parameters_callback(self, callback: Callable[[list[Parameter]], SetParametersResult]) -> None:
        """Add a callback that decides whether parameters may be set; it still sees the old values."""
        _check_callable(callback)
        self._on_set_parameters_callbacks.insert(0, callback)

    def add_post_set_parameters_callback(self, callback: Callable[[list[Parameter]], None]) -> None:
        """Add a callback that gets the parameters that have been set."""
        _check_callable(callback)
        self._post_set_parameters_callbacks.insert(0, callback)

    def remove_pre_set_parameters_callback(self, callback: Callable[[list[Parameter]], list[Parameter]]) -> None:
        """Remove a callback; raises `ValueError` if it was not added."""
        self._pre_set_parameters_callbacks.remove(callback)

    def remove_on_set_parameters_callback(self, callback: Callable[[list[Parameter]], SetParametersResult]) -> None:
        """Remove a callback; raises `ValueError` if it was not added."""
        self._on_set_parameters_callbacks.remove(callback)

    def remove_post_set_parameters_callback(self, callback: Callable[[list[Parameter]], None]) -> None:
        """Remove a callback; raises `ValueError` if it was not added."""
        self._post_set_parameters_callbacks.remove(callback)


CARRIED_AS_THEY_ARE = frozenset((bool, float, str))
"""Classes of which all values are transmitted unchanged."""


def parameter_event(
    node: str, now: int, new: list[ParameterMsg], changed: list[ParameterMsg], deleted: list[ParameterMsg]
) -> ParameterEvent:
    """Return the parameter event of a node (full name) at a time (ns)."""
    seconds, nanoseconds = divmod(now, S_TO_NS)
    return ParameterEvent(
        stamp=Time(sec=seconds, nanosec=nanoseconds, check_fields=False),
        node=node,
        new_parameters=new,
        changed_parameters=changed,
        deleted_parameters=deleted,
        check_fields=False,
    )


def check_carried(parameter: Parameter) -> None:
    """Raise what `event_parameter` would raise, without creating a message for values that need no check.

    A message is seven objects for the garbage collector: ten thousand of them that nobody receives would take two
    thirds of the time for setting those parameters.
    """
    value = parameter._value
    kind = value.__class__
    _check_text(parameter)
    if kind not in CARRIED_AS_THEY_ARE and not (kind is int and INT64_MIN <= value <= INT64_MAX):
        event_parameter(parameter)


def _check_text(parameter: Parameter) -> None:
    """Raise `UnicodeEncodeError` for a name or value with an incomplete character, as a file name may have."""
    value: Any = parameter._value
    texts: Any = value if value.__class__ is list or value.__class__ is tuple else (value,)
    for text in (parameter._name, *texts):
        if text.__class__ is str and not text.isascii():
            text.encode()


def event_parameter(parameter: Parameter) -> ParameterMsg:
    """Return a parameter as a well-formed message for an event.

    Raises `FieldTypeError` or, for text that is not Unicode, `UnicodeEncodeError` if it cannot be serialized.
    """
    _check_text(parameter)
    code = parameter._type_._value_
    value = ParameterValue(type=code, check_fields=False)
    message = ParameterMsg(name=parameter._name, value=value, check_fields=False)
    if not code:
        return message
    given = parameter._value
    setattr(value, FIELDS[code], given)
    return message if given.__class__ in CARRIED_AS_THEY_ARE else message._copy_()


def refusal(parameter: Any, descriptor: Any, *, check_read_only: bool, declared: bool, tolerance: float) -> str | None:
    """Return why a descriptor forbids a parameter, or None; sets its name and, with dynamic typing, its type.

    `declared` says whether the parameter exists already; `tolerance` is the relative tolerance of ranges of doubles.
    """
    name, code = parameter._name, parameter._type_._value_
    descriptor.name = name
    if check_read_only and descriptor.read_only:
        return f"Trying to set a read-only parameter: {name}."
    if descriptor.dynamic_typing:
        descriptor.type = code
    elif code == NOT_SET.value:
        if declared:
            return "Static parameter cannot be undeclared"
    elif code != descriptor.type:
        expected = type(parameter._type_)(descriptor.type)
        return f"Wrong parameter type, expected '{expected}' got '{parameter._type_}'"
    if code == DOUBLE.code and descriptor.floating_point_range:
        return _outside_doubles(name, parameter._value, descriptor.floating_point_range[0], tolerance)
    if code == INTEGER.code and descriptor.integer_range:
        return _outside_integers(name, parameter._value, descriptor.integer_range[0])
    return None


def _outside_integers(name: str, value: int, allowed: Any) -> str | None:
    """Return why an integer is out of range, or None. Both ends are always allowed; steps count from the lower end."""
    low, high = sorted((allowed.from_value, allowed.to_value))
    if value in (low, high):
        return None
    if not low < value < high:
        return f"Parameter {name} out of range. Min: {low}, Max: {high}, value: {value}"
    if allowed.step and (value - low) % allowed.step:
        return (
            f"The parameter value for {name} is not a valid step. "
            f"Min: {low}, max: {high}, value: {value}, step: {allowed.step}"
        )
    return None


def _outside_doubles(name: str, value: float, allowed: Any, tolerance: float) -> str | None:
    """Return the same for a double, with a relative tolerance at both ends and at each step."""
    ends = (allowed.from_value, allowed.to_value)
    low, high = min(ends), max(ends)  # as upstream, NaN as the first end makes both ends NaN
    if math.isclose(value, low, rel_tol=tolerance) or math.isclose(value, high, rel_tol=tolerance):
        return None
    if not low < value < high:
        return f"Parameter {name} out of range Min: {low}, Max: {high}, value: {value}"
    step = allowed.step
    if step and not math.isclose(low + round((value - low) / step) * step, value, rel_tol=tolerance):
        return (
            f"The parameter value for {name} is not close enough to a valid step. "
            f"Min: {low}, max: {high}, value: {value}, step: {step}"
        )
    return None
