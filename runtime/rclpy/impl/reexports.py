"""Names that programs import from modules of rclpy that merely import them, as upstream's modules happen to do.

`from rclpy.node import Node, Parameter` works upstream, and much public code relies on such names. Here a module
imports only the names it needs; the others are looked up on first use, which costs nothing at start.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any

_SOURCES = {
    "rcl_interfaces.msg": "FloatingPointRange IntegerRange ListParametersResult ParameterDescriptor ParameterEvent "
    "ParameterType ParameterValue SetParametersResult",
    "rcl_interfaces.srv": "DescribeParameters GetParameters GetParameterTypes ListParameters SetParameters "
    "SetParametersAtomically",
    "rclpy.callback_groups": "CallbackGroup MutuallyExclusiveCallbackGroup ReentrantCallbackGroup",
    "rclpy.client": "Client",
    "rclpy.clock": "Clock ROSClock",
    "rclpy.clock_type": "ClockType",
    "rclpy.constants": "S_TO_NS",
    "rclpy.context": "Context",
    "rclpy.duration": "Duration",
    "rclpy.event_handler": "EventHandler PublisherEventCallbacks SubscriptionEventCallbacks",
    "rclpy.exceptions": "InvalidHandle InvalidParameterTypeException InvalidParameterValueException "
    "InvalidTopicNameException NoTypeSupportImportedException NotInitializedException "
    "ParameterAlreadyDeclaredException ParameterImmutableException ParameterNotDeclaredException "
    "ParameterUninitializedException ROSInterruptException",
    "rclpy.executors": "Executor await_or_execute",
    "rclpy.expand_topic_name": "expand_topic_name",
    "rclpy.guard_condition": "GuardCondition",
    "rclpy.impl.rcutils_logger": "RcutilsLogger",
    "rclpy.impl.type_variables": "MsgType SrvType SrvTypeRequest SrvTypeResponse",
    "rclpy.lifecycle.transition_callback_return": "TransitionCallbackReturnType",
    "rclpy.logging": "get_logger",
    "rclpy.logging_service": "LoggingService",
    "rclpy.node": "Node",
    "rclpy.parameter": "PARAMETER_SEPARATOR_STRING Parameter",
    "rclpy.parameter_service": "ParameterService",
    "rclpy.publisher": "Publisher",
    "rclpy.qos": "QoSProfile qos_profile_services_default qos_policy_name_from_kind",
    "rclpy.qos_overriding_options": "QoSOverridingOptions",
    "rclpy.service": "Service",
    "rclpy.service_introspection": "ServiceIntrospectionState",
    "rclpy.subscription": "Subscription",
    "rclpy.task": "Future Task",
    "rclpy.timer": "Rate Timer",
    "rclpy.topic_endpoint_info": "TopicEndpointInfo",
    "rclpy.type_description_service": "TypeDescriptionService",
    "rclpy.type_support": "check_for_type_support check_is_valid_msg_type check_is_valid_srv_type",
    "rclpy.utilities": "get_default_context timeout_sec_to_nsec",
    "rclpy.validate_full_topic_name": "validate_full_topic_name",
    "rclpy.validate_namespace": "validate_namespace",
    "rclpy.validate_node_name": "validate_node_name",
    "rclpy.validate_parameter_name": "validate_parameter_name",
    "rclpy.validate_topic_name": "validate_topic_name",
    "rclpy.waitable": "NumberOfEntities Waitable",
    "typing": "Any Callable Dict Iterator List Optional Sequence Tuple Type TypeVar Union",
}
_HOME = {name: module for module, names in _SOURCES.items() for name in names.split()}
_RENAMED = {
    "ParameterMsg": ("rcl_interfaces.msg", "Parameter"),
    "NodeNameNonExistentError": ("rclpy._rclpy_pybind11", "NodeNameNonExistentError"),
}
_C_EXTENSION = "_rclpy"

_WITH_RCLPY = ("callback_groups", "constants", "exceptions", "guard_condition")
"""Modules that `import rclpy` loads upstream."""
_WITH_NODE = [
    "client",
    "clock",
    "clock_type",
    "duration",
    "event_handler",
    "executors",
    "expand_topic_name",
    "logging",
    "logging_service",
    "parameter_service",
    "publisher",
    "qos",
    "qos_overriding_options",
    "service",
    "service_introspection",
    "subscription",
    "time",
    "time_source",
    "timer",
    "topic_endpoint_info",
    "type_description_service",
    "type_hash",
    "type_support",
    "validate_full_topic_name",
    "validate_namespace",
    "validate_node_name",
    "validate_parameter_name",
    "validate_topic_name",
    "waitable",
]
"""Modules that `import rclpy.node` loads upstream."""


def reexporting(module: str, names: str) -> Callable[[str], Any]:
    """Return a module-level `__getattr__` that re-exports these names, and the C extension as `_rclpy`."""
    known = frozenset(names.split())

    def find(name: str) -> Any:
        if name == _C_EXTENSION:
            return import_module("rclpy._rclpy_pybind11")
        if name in known:
            home, original = _RENAMED.get(name) or (_HOME[name], name)
            return getattr(import_module(home), original)
        raise AttributeError(f"module {module!r} has no attribute {name!r}")

    return find


def submodule(name: str) -> Any:
    """Return the module `rclpy.<name>` if upstream would have loaded it by now, without an import by the program."""
    if name in _WITH_RCLPY or (name in _WITH_NODE and "rclpy.node" in sys.modules):
        return import_module(f"rclpy.{name}")
    raise AttributeError(f"module 'rclpy' has no attribute {name!r}")
