"""QoS policies of a publisher or subscription that parameters may override."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.duration import Duration
from rclpy.exceptions import ParameterAlreadyDeclaredException
from rclpy.publisher import Publisher
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSPolicyKind,
    QoSProfile,
    ReliabilityPolicy,
)
from rclpy.subscription import Subscription

if TYPE_CHECKING:
    from rclpy.node_parts.base import NodeBase

QosCallbackType = Callable[[QoSProfile], Any]
"""Returns a `QosCallbackResult` that says whether a profile with its overrides is valid."""

_ENUMS: dict[QoSPolicyKind, Any] = {
    QoSPolicyKind.LIVELINESS: LivelinessPolicy,
    QoSPolicyKind.RELIABILITY: ReliabilityPolicy,
    QoSPolicyKind.HISTORY: HistoryPolicy,
    QoSPolicyKind.DURABILITY: DurabilityPolicy,
}
_DURATIONS = (QoSPolicyKind.LIFESPAN, QoSPolicyKind.DEADLINE, QoSPolicyKind.LIVELINESS_LEASE_DURATION)


class InvalidQosOverridesError(Exception):
    """The callback of the options rejects the overridden profile."""


class QoSOverridingOptions:
    """Which policies may be overridden; `entity_id` distinguishes the entities of one topic."""

    def __init__(
        self,
        policy_kinds: Iterable[QoSPolicyKind],
        *,
        callback: QosCallbackType | None = None,
        entity_id: str | None = None,
    ) -> None:
        self._policy_kinds = policy_kinds
        self._callback = callback
        self._entity_id = entity_id

    @property
    def policy_kinds(self) -> Iterable[QoSPolicyKind]:
        """The policies for which a parameter is declared."""
        return self._policy_kinds

    @property
    def callback(self) -> QosCallbackType | None:
        """The function that decides whether the overridden profile is valid."""
        return self._callback

    @property
    def entity_id(self) -> str | None:
        """The suffix that follows the kind of entity in the parameters' names."""
        return self._entity_id

    @classmethod
    def with_default_policies(
        cls, *, callback: QosCallbackType | None = None, entity_id: str | None = None
    ) -> QoSOverridingOptions:
        """Return options for history, depth and reliability."""
        kinds = (QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY)
        return cls(kinds, callback=callback, entity_id=entity_id)


def _declare_qos_parameters(  # pyright: ignore[reportUnusedFunction] -- node_parts.entities calls it
    entity_type: type[Publisher] | type[Subscription],
    node: NodeBase,
    topic_name: str,
    qos: QoSProfile,
    options: QoSOverridingOptions,
) -> None:
    """Declare a read-only parameter for each policy of the options, and set the values in the profile.

    Raises `RuntimeError` for a value that is not a policy, `InvalidQosOverridesError`, and what declaring raises.
    """
    if not issubclass(entity_type, (Publisher, Subscription)):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
        raise TypeError("Argument `entity_type` should be a subclass of Publisher or Subscription")
    kind = "publisher" if issubclass(entity_type, Publisher) else "subscription"
    suffix = "" if options.entity_id is None else f"_{options.entity_id}"
    about = f"for {kind} `{topic_name}` with id `{options.entity_id}`"
    for policy in options.policy_kinds:
        if policy == QoSPolicyKind.LIFESPAN and kind == "subscription":
            continue
        word = policy.name.lower()
        name = f"qos_overrides.{topic_name}.{kind}{suffix}.{word}"
        descriptor = ParameterDescriptor(description=f"{word} {about}", read_only=True)
        try:
            parameter = node.declare_parameter(name, _parameter_value(qos, policy), descriptor)
        except ParameterAlreadyDeclaredException:
            parameter = node.get_parameter(name)
        setattr(qos, word, _policy_value(policy, parameter.value))
    if options.callback is not None:
        _refuse_where_requested(options.callback(qos), about)


def _refuse_where_requested(answer: bool | SetParametersResult, about: str) -> None:
    """Raise an error if a callback has returned a failure: a `QosCallbackResult`, or a bool as in older releases."""
    if isinstance(answer, bool):
        if not answer:
            raise InvalidQosOverridesError(f"Provided QoS overrides {about}, are not valid")
    elif not answer.successful:
        raise InvalidQosOverridesError(f"Provided QoS overrides {about}, are not valid: {answer.reason}")


def _parameter_value(qos: QoSProfile, policy: QoSPolicyKind) -> object:
    """Return a policy as a parameter value: a lower-case name, nanoseconds, or a plain value."""
    value = getattr(qos, policy.name.lower())
    if policy in _ENUMS:
        if value.name == "UNKNOWN":
            raise ValueError("User provided QoS profile is invalid")
        return value.name.lower()
    return value.nanoseconds if policy in _DURATIONS else value


def _policy_value(policy: QoSPolicyKind, value: Any) -> object:
    if policy in _DURATIONS:
        return Duration(nanoseconds=value)
    if policy not in _ENUMS:
        return value
    try:
        return _ENUMS[policy][value.upper()]
    except KeyError:
        raise RuntimeError(f"Unexpected QoS override for policy `{policy.name.lower()}`: `{value}`") from None


def __getattr__(name: str) -> Any:
    """Load `QosCallbackResult`, which is a message, on first access."""
    if name == "QosCallbackResult":
        return SetParametersResult
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
