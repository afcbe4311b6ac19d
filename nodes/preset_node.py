#!/usr/bin/env python3
"""Node `presets`: lists, saves, applies and deletes sets of parameters of other nodes, for any client.

Services: `~/list` (`std_srvs/srv/Trigger`; one line per preset), and `~/apply`, `~/save`, `~/delete`
(`diagnostic_msgs/srv/AddDiagnostics`, whose only field, `load_namespace`, is the name of the preset).
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bot_console_robot import preset_files
from bot_console_robot.common.parameters import plain
from bot_console_robot.common.running import run
from bot_console_robot.preset_files import PresetError
from diagnostic_msgs.srv import AddDiagnostics
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient
from rclpy.task import Future
from std_srvs.srv import Trigger

LEFT_OUT = ("use_sim_time", "start_type_description_service")
"""Parameters that every node has and no preset contains."""
NODE_POLL_S, MAX_NODE_POLLS = 0.05, 40
"""Interval (s) at which a new client checks for its services, and the number of checks, since discovery takes time on a
network.
"""


class Presets(Node):
    """Applies presets all or nothing: if a node refuses, the changes that other nodes have accepted are reverted."""

    def __init__(self) -> None:
        super().__init__("presets", enable_logger_service=True)
        self.declare_parameter("folder", str(preset_files.default_folder()), plain("Folder with one file per preset"))
        self.declare_parameter(
            "nodes",
            descriptor=ParameterDescriptor(
                description="Nodes whose parameters are saved; empty: all nodes that have parameters"
            ),
            value=[""],
        )
        self._group = ReentrantCallbackGroup()
        self._clients: dict[str, AsyncParameterClient] = {}
        self.create_service(Trigger, "~/list", self._list)
        for name, callback in (("apply", self._apply), ("save", self._save), ("delete", self._delete)):
            self.create_service(AddDiagnostics, f"~/{name}", callback, callback_group=self._group)

    @property
    def _folder(self) -> Path:
        return Path(os.path.expanduser(str(self.get_parameter("folder").value)))

    def _list(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        found = preset_files.names(self._folder)
        lines = [f"{name}: {title}" if (title := preset_files.title(self._folder, name)) else name for name in found]
        response.success, response.message = True, "\n".join(lines)
        return response

    async def _apply(
        self, request: AddDiagnostics.Request, response: AddDiagnostics.Response
    ) -> AddDiagnostics.Response:
        name = request.load_namespace
        try:
            count = await self._set_all(preset_files.read(self._folder, name))
            return self._answered(response, True, f"preset {name}: {count} values set")
        except PresetError as error:
            return self._answered(response, False, str(error))

    async def _set_all(self, wanted: preset_files.Values) -> int:
        """Set the values of all nodes, or of none; returns the number of values, raises `PresetError`."""
        before = {node: await self._values(node, list(values)) for node, values in wanted.items()}
        for node, values in wanted.items():
            if missing := [name for name in values if before[node].get(name) is None]:
                raise PresetError(f"nothing was set: {node} has no parameter {', '.join(missing)}")
        done: list[str] = []
        for node, values in wanted.items():
            reason = await self._set(
                node, {name: _converted(value, before[node][name]) for name, value in values.items()}
            )
            if reason:
                stuck = [each for each in reversed(done) if await self._set(each, before[each])]
                reported = f"; {', '.join(stuck)} could not be restored" if stuck else ""
                raise PresetError(f"nothing was set: {node} refused: {reason}{reported}")
            done.append(node)
        return sum(map(len, wanted.values()))

    async def _save(
        self, request: AddDiagnostics.Request, response: AddDiagnostics.Response
    ) -> AddDiagnostics.Response:
        try:
            values = {node: await self._all_values(node) for node in self._target_nodes()}
            path = preset_files.write(self._folder, request.load_namespace, values)
            return self._answered(response, True, f"{sum(map(len, values.values()))} values saved to {path}")
        except PresetError as error:
            return self._answered(response, False, str(error))

    def _delete(self, request: AddDiagnostics.Request, response: AddDiagnostics.Response) -> AddDiagnostics.Response:
        try:
            preset_files.delete(self._folder, request.load_namespace)
            return self._answered(response, True, f"preset {request.load_namespace} deleted")
        except PresetError as error:
            return self._answered(response, False, str(error))

    def _answered(self, response: AddDiagnostics.Response, done: bool, text: str) -> AddDiagnostics.Response:
        if done:
            self.get_logger().info(text)
        else:
            self.get_logger().warning(text)
        response.success, response.message = done, text
        return response

    def _target_nodes(self) -> list[str]:
        """Return the nodes to query: the configured ones, else all whose parameters can be set."""
        chosen = [str(each) for each in self.get_parameter("nodes").value or () if each]
        if chosen:
            return [f"/{each.lstrip('/')}" for each in chosen]
        known = self.get_fully_qualified_node_names()
        offered = {name for name, _ in self.get_service_names_and_types()}
        own = self.get_fully_qualified_name()
        return sorted({each for each in known if f"{each}/set_parameters" in offered and each != own})

    async def _client(self, node: str) -> AsyncParameterClient:
        """Return a client of a node's services once it has discovered them; raises `PresetError`."""
        if node not in self._clients:
            self._clients[node] = AsyncParameterClient(self, node, callback_group=self._group)
        client = self._clients[node]
        for _ in range(MAX_NODE_POLLS):
            if client.services_are_ready():
                return client
            if not self.count_services(f"{node}/set_parameters"):
                break
            await self._yield_to_executor()
        raise PresetError(f"{node} is not running, or has no parameter services")

    async def _yield_to_executor(self) -> None:
        """Let other callbacks run before the next check."""
        over: Future[None] = Future()

        def end() -> None:
            timer.cancel()
            over.set_result(None)

        timer = self.create_timer(NODE_POLL_S, end, callback_group=self._group)
        await over
        self.destroy_timer(timer)

    async def _values(self, node: str, names: list[str]) -> dict[str, Any]:
        """Return the values of some parameters of a node; None for those it does not have."""
        answer = await (await self._client(node)).get_parameters(names)
        found = [parameter_value_to_python(each) for each in answer.values] if answer else []
        return dict(zip(names, found or [None] * len(names), strict=False))

    async def _all_values(self, node: str) -> dict[str, Any]:
        answer = await (await self._client(node)).list_parameters()
        names = [each for each in answer.result.names if each not in LEFT_OUT] if answer else []
        values = await self._values(node, names) if names else {}
        return {name: list(value) if _is_array(value) else value for name, value in values.items() if value is not None}

    async def _set(self, node: str, values: Mapping[str, Any]) -> str:
        """Set values of one node together; returns the reason for which it refused them, or an empty text."""
        parameters = [Parameter(name, value=value) for name, value in values.items()]
        answer = await (await self._client(node)).set_parameters_atomically(parameters)
        if answer and answer.result.successful:
            return ""
        return (answer.result.reason if answer else "") or "no reason was given"


def _is_array(value: Any) -> bool:
    return hasattr(value, "__len__") and not isinstance(value, str)


def _converted(value: Any, now: Any) -> Any:
    """Convert a value to the parameter's type: `2` in a file is a double if one is declared."""
    return float(value) if isinstance(now, float) and type(value) is int else value


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(Presets, args)


if __name__ == "__main__":
    main()
