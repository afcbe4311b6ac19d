"""The interface of a node that its parts share, and that the modules below `rclpy.node` need."""

# ruff: noqa: D102 -- the methods are documented where they are implemented

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from rclpy.impl.entity import EntityExecutor

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bot_console.runtime.rmw.arguments import Arguments
    from bot_console.runtime.rmw.bus import Bus
    from bot_console.runtime.rmw.endpoints import NodeId
    from bot_console.runtime.rmw.remapping import RemapRule
    from rcl_interfaces.msg import ParameterDescriptor
    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.context import Context
    from rclpy.impl.entity import Entity
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from rclpy.parameter import Parameter


class NodeExecutor(EntityExecutor, Protocol):
    """What nodes need of their executor."""

    def add_node(self, node: NodeBase) -> bool:
        """Add a node; returns whether it was new."""
        ...

    def remove_node(self, node: NodeBase) -> None:
        """Remove a node."""

    def wake(self) -> None:
        """Wake a waiting `spin_once`."""


class NodeBase:
    """The state of a node that its parts and entities read, and the methods of `Node` that they call."""

    _ros_bus: Bus
    _ros_id: NodeId
    _ros_sink: EntityExecutor | None
    _ros_order: int
    _ros_entities: dict[Entity, None]
    _ros_arguments: Sequence[Arguments]
    _ros_remap_rules: Sequence[RemapRule]
    _ros_destroyed: bool
    _parameters: dict[str, Parameter]
    _descriptors: dict[str, ParameterDescriptor]
    _allow_undeclared_parameters: bool

    if TYPE_CHECKING:

        @property
        def context(self) -> Context: ...

        @property
        def default_callback_group(self) -> CallbackGroup: ...

        @property
        def executor(self) -> NodeExecutor | None: ...

        @executor.setter
        def executor(self, new: NodeExecutor | None) -> None: ...

        def _ros_use(self) -> None: ...

        def _ros_attach(self, executor: EntityExecutor, order: int) -> None: ...

        def _ros_detach(self) -> None: ...

        def _ros_leave_graph(self) -> None: ...

        def get_name(self) -> str: ...

        def get_namespace(self) -> str: ...

        def get_fully_qualified_name(self) -> str: ...

        def declare_parameter(
            self, name: str, value: object = None, descriptor: ParameterDescriptor | None = None
        ) -> Parameter: ...

        def get_parameter(self, name: str) -> Parameter: ...

        def get_clock(self) -> Clock: ...

        def get_logger(self) -> RcutilsLogger: ...
