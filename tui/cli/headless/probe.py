"""The node of a headless run that only lists parameters."""

from __future__ import annotations

from typing import Any

from bot_console.tui.cli.headless.observer import Observer
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient


class ParameterProbe(Observer):
    """Reports the parameters of all nodes, by node and name, in place of the simulator's figures."""

    def _ask(self) -> None:
        node = self._node
        if self._asked or node is None or node.executor is None:
            return
        self._asked = True
        self._end.cancel()
        node.executor.create_task(self._describe(node))

    async def _describe(self, node: Node) -> None:
        for full in node.get_fully_qualified_node_names():
            client = AsyncParameterClient(node, full)
            if not client.services_are_ready():
                continue
            listed = await client.list_parameters()
            names = list(listed.result.names) if listed else []
            described = await client.describe_parameters(names)
            values = await client.get_parameters(names)
            if described and values:
                found = zip(described.descriptors, map(parameter_value_to_python, values.values), strict=False)
                self._figures[full] = {each.name: _plain(each, value) for each, value in found}
        self.complete = True
        self.done.set()


def _plain(descriptor: ParameterDescriptor, value: Any) -> dict[str, Any]:
    """A parameter as JSON data; arrays are omitted, since they are not tuned."""
    spans = (*descriptor.floating_point_range, *descriptor.integer_range)
    return {
        "value": value if isinstance(value, (bool, int, float, str)) else None,
        "range": [spans[0].from_value, spans[0].to_value, spans[0].step] if spans else None,
        "description": descriptor.description,
        "read_only": descriptor.read_only,
    }
