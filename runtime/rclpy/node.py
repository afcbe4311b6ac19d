"""Nodes."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import weakref
from collections.abc import Sequence
from types import FunctionType, TracebackType
from typing import TYPE_CHECKING

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.rmw import names, remapping
from rcl_interfaces.msg import ParameterEvent
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.clock import Clock, ROSClock
from rclpy.exceptions import InvalidNamespaceException, InvalidNodeNameException, NotInitializedException
from rclpy.impl.destroyable import Destroyable
from rclpy.impl.entity import DESTROYED
from rclpy.impl.reexports import reexporting
from rclpy.impl.unused_overrides import missed_files
from rclpy.logging import get_logger
from rclpy.node_parts.entities import NodeEntities
from rclpy.node_parts.graph import NodeGraph
from rclpy.node_parts.parameter_setting import ParameterSetting
from rclpy.node_parts.parameters import NodeParameters
from rclpy.node_parts.rosout import Rosout
from rclpy.parameter import Parameter
from rclpy.parameter_service import ParameterService
from rclpy.qos import qos_profile_parameter_events
from rclpy.time_source import TimeSource
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from bot_console.runtime.rmw.arguments import Arguments
    from rclpy.context import Context
    from rclpy.impl.entity import Entity, EntityExecutor
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from rclpy.node_parts.base import NodeExecutor
    from rclpy.publisher import Publisher
    from rclpy.timer import Rate, Timer
    from rclpy.waitable import Waitable

HIDDEN_NODE_PREFIX = "_"
LOGGER_SEPARATOR = "."


class Node(NodeParameters, NodeGraph):
    """A node of the ROS graph: it has parameters, and creates publishers, subscriptions, services, clients and timers.

    Programs inherit from it and may choose any names for their attributes, even `_name` or `_bus`; therefore internal
    names begin with `_ros_`, except those that upstream has, too.
    """

    PARAM_REL_TOL = 1e-6
    """Relative tolerance of the range checks of doubles."""

    def __init__(
        self,
        node_name: str,
        *,
        context: Context | None = None,
        cli_args: Sequence[str] | None = None,
        namespace: str | None = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        start_parameter_services: bool = True,
        parameter_overrides: Sequence[Parameter] | None = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None:
        self._ros_context = get_default_context() if context is None else context
        self._ros_entities: dict[Entity, None] = {}
        self._ros_publishers: dict[Publisher, None] = {}
        self._ros_waitables: dict[Waitable, None] = {}
        self._ros_rates: dict[Rate, Timer] = {}
        self._ros_sink: EntityExecutor | None = None
        self._ros_order = 0
        self._ros_executor: weakref.ref[NodeExecutor] | None = None
        self._ros_rosout: Rosout | None = None
        self._ros_destroyed = False
        self._default_callback_group = MutuallyExclusiveCallbackGroup()
        if not self.context.ok():
            raise NotInitializedException("cannot create node")
        self._ros_bus = self.context.bus
        arguments = self._ros_arguments = self._ros_read_arguments(cli_args, use_global_arguments)
        self._ros_choose_name(node_name, namespace or "", arguments)
        self._logger = get_logger(_logger_name(self._ros_namespace, self._ros_name))
        self._ros_id = self._ros_bus.add_node(
            self._ros_name, self._ros_namespace, self.context.arguments.enclave or "/"
        )
        self.context.track_node(self)
        if enable_rosout and self.context.arguments.rosout_enabled:
            self._ros_rosout = Rosout(self)
        self._ros_make_parameters(
            arguments, parameter_overrides, allow_undeclared_parameters, automatically_declare_parameters_from_overrides
        )
        if start_parameter_services:
            self._parameter_service = ParameterService(self)
        if enable_logger_service:
            from rclpy.logging_service import LoggingService

            self._logger_service = LoggingService(self)
        from rclpy.type_description_service import TypeDescriptionService

        self._type_description_service = TypeDescriptionService(self)

    def _ros_read_arguments(self, cli_args: Sequence[str] | None, use_global: bool) -> list[Arguments]:
        """Return the parsed command lines that concern this node, starting with the context's."""
        found = [self.context.arguments] if use_global else []
        if cli_args is not None:
            from rclpy.impl.command_line import parse_local

            found.append(parse_local(cli_args))
        return found

    def _ros_choose_name(self, name: str, namespace: str, arguments: list[Arguments]) -> None:
        """Check and remap name and namespace; rules of the node's own command line take precedence."""
        if name is None:  # pyright: ignore[reportUnnecessaryComparison] -- a user's argument
            raise RCLError("error creating node: name argument is null")
        if not isinstance(name, str):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
            raise TypeError(f"node name must be a string, not {type(name).__name__}")
        problem = names.validate_node_name(name)
        if problem:
            raise InvalidNodeNameException(name, *problem)
        if not isinstance(namespace, str):  # pyright: ignore[reportUnnecessaryIsInstance] -- as above
            raise TypeError(f"namespace must be a string, not {type(namespace).__name__}")
        namespace = namespace if namespace.startswith("/") else f"/{namespace}"
        problem = names.validate_namespace(namespace)
        if problem:
            raise InvalidNamespaceException(namespace, *problem)
        self._ros_remap_rules = tuple(rule for each in reversed(arguments) for rule in each.remap_rules)
        self._ros_name = remapping.remap_node_name(self._ros_remap_rules, name) or name
        problem = names.validate_node_name(self._ros_name)
        if problem:
            raise RCLError(f"error creating node: invalid node name: {problem[0]}")
        self._ros_namespace = remapping.remap_namespace(self._ros_remap_rules, name) or namespace
        problem = names.validate_namespace(self._ros_namespace)
        if problem:
            raise RCLError(
                f"error creating node: invalid node namespace: {names.namespace_problem_of_new_node(problem[0])}"
            )

    def _ros_make_parameters(
        self, arguments: list[Arguments], overrides: Sequence[Parameter] | None, undeclared: bool, automatic: bool
    ) -> None:
        self._parameter_event_publisher = self.create_publisher(
            ParameterEvent, "/parameter_events", qos_profile_parameter_events
        )
        self._clock = ROSClock()
        self._ros_init_parameters(arguments, overrides, undeclared, automatic)
        self._ros_report_missed_files(arguments)
        self._time_source = TimeSource(node=self)
        self._time_source.attach_clock(self._clock)

    def _ros_report_missed_files(self, arguments: list[Arguments]) -> None:
        if remapping.remap_node_name(self._ros_remap_rules, self._ros_name):
            return  # the program that remapped its name, such as launch, knew it and has its own report
        own = self.get_fully_qualified_name()
        others = [each.get_fully_qualified_name() for each in self.context.tracked_nodes() if each is not self]
        for each in arguments:
            for line in missed_files(each.parameters, own, others):
                notify(current(), line)

    @property
    def executor(self) -> NodeExecutor | None:
        """The executor that the node was added to last, or None."""
        return self._ros_executor() if self._ros_executor is not None else None

    @executor.setter
    def executor(self, new: NodeExecutor | None) -> None:
        before = self.executor
        if before is new:
            return
        if before is not None:
            before.remove_node(self)
        if new is None:
            self._ros_executor = None
        else:
            self._ros_executor = weakref.ref(new)
            new.add_node(self)

    @property
    def context(self) -> Context:
        """The context that the node belongs to."""
        return self._ros_context

    @property
    def default_callback_group(self) -> MutuallyExclusiveCallbackGroup:
        """The callback group of entities created without one; mutually exclusive."""
        return self._default_callback_group

    @property
    def handle(self) -> Destroyable:
        """The node's handle, as upstream has one."""
        return Destroyable(self, self._ros_use)

    @handle.setter
    def handle(self, value: object) -> None:
        raise AttributeError("handle cannot be modified after node creation")

    def _ros_use(self) -> None:
        if self._ros_destroyed:
            raise InvalidHandle(DESTROYED)

    def get_name(self) -> str:
        """Return the node's name after remapping."""
        self._ros_use()
        return self._ros_name

    def get_namespace(self) -> str:
        """Return the node's namespace after remapping."""
        self._ros_use()
        return self._ros_namespace

    def get_fully_qualified_name(self) -> str:
        """Return namespace and name."""
        self._ros_use()
        return names.full_name(self._ros_namespace, self._ros_name)

    def get_clock(self) -> Clock:
        """Return the node's clock, which shows ROS time."""
        return self._clock

    def get_logger(self) -> RcutilsLogger:
        """Return the node's logger."""
        return self._logger

    def destroy_node(self) -> None:
        """Destroy the node's entities and remove it from the graph; a second call does nothing."""
        if self._ros_destroyed:
            return
        executor = self.executor
        self._type_description_service.outlive_destroy()
        for rate in list(self._ros_rates):
            self.destroy_rate(rate)
        for publisher in list(self._ros_publishers):
            self.destroy_publisher(publisher)
        for entity in list(self._ros_entities):
            self._ros_destroy(entity, object)
        self._ros_leave_graph()
        self.context.untrack_node(self)
        self._ros_destroyed = True
        if executor is not None:
            executor.wake()

    def _ros_leave_graph(self) -> None:
        """Remove the node from the graph and silence it, even if its code still runs."""
        if self._ros_rosout is not None:
            self._ros_rosout.close()
        self._ros_bus.remove_node(self._ros_id)

    def __enter__(self) -> Node:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.destroy_node()


# `Node` inherits most methods from mixins that users do not see, and Python's error for a call with wrong arguments
# contains `__qualname__`: this makes it `Node.create_publisher()`, as in rclpy, not `NodeEntities.create_publisher()`.
for _part in (NodeEntities, ParameterSetting, NodeParameters, NodeGraph):
    for _name, _method in vars(_part).items():
        if isinstance(_method, FunctionType):
            _method.__qualname__ = f"Node.{_name}"


def _logger_name(namespace: str, name: str) -> str:
    return names.full_name(namespace, name).lstrip("/").replace("/", LOGGER_SEPARATOR)


__getattr__ = reexporting(
    __name__,
    "Callable CallbackGroup Client Context Dict Executor FloatingPointRange GuardCondition IntegerRange "
    "InvalidParameterTypeException InvalidParameterValueException InvalidTopicNameException Iterator List "
    "ListParameters ListParametersResult LoggingService MsgType NodeNameNonExistentError Optional "
    "PARAMETER_SEPARATOR_STRING ParameterAlreadyDeclaredException ParameterDescriptor ParameterEvent "
    "ParameterImmutableException ParameterMsg ParameterNotDeclaredException ParameterType "
    "ParameterUninitializedException ParameterValue Publisher PublisherEventCallbacks QoSOverridingOptions "
    "QoSProfile Rate ReentrantCallbackGroup S_TO_NS Service SetParametersResult SrvType SrvTypeRequest "
    "SrvTypeResponse Subscription SubscriptionEventCallbacks Timer TopicEndpointInfo Tuple Type "
    "TypeDescriptionService TypeVar Union Waitable check_is_valid_msg_type check_is_valid_srv_type "
    "expand_topic_name qos_profile_services_default validate_full_topic_name validate_namespace "
    "validate_node_name validate_parameter_name validate_topic_name",
)
