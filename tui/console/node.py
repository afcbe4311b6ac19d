"""The console's own ROS node: hidden, and using only the public rclpy API, so that it works on every ROS system."""

from __future__ import annotations

import contextlib
import importlib
import time
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Future
from functools import partial
from typing import Any

import rclpy
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.calls import Calls, NoAnswer
from bot_console.tui.console.graph.type_discovery import TypeSource
from bot_console.tui.console.graph.warnings import SOURCE, GraphWarnings
from bot_console.tui.console.graph.watch import FrozenNodes, GraphEvents, GraphWatch
from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.console.logs.levels import LoggerLevels
from bot_console.tui.console.logs.rosout import RosoutWatch
from bot_console.tui.console.model import (
    ChangeSource,
    GraphInfo,
    LoggerLevel,
    ParameterTree,
    Profile,
    ProfileDifference,
    SetOutcome,
    Severity,
    Value,
)
from bot_console.tui.console.parameters.file.saving import save
from bot_console.tui.console.parameters.history import History
from bot_console.tui.console.parameters.journal import Journal
from bot_console.tui.console.parameters.mirror import ParameterMirror
from bot_console.tui.console.parameters.profiles import differences
from bot_console.tui.console.parameters.provenance import Provenance
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.console.parameters.setter import ParameterSetter
from bot_console.tui.console.plot.watch import PlotWatch
from bot_console.tui.console.robot.drive_node import DriveNode
from bot_console.tui.console.robot.world_watch import WorldWatch
from bot_console.tui.console.sensors.node_sensors import NodeSensors
from bot_console.tui.console.topics.node_traffic import NodeTraffic
from bot_console.tui.files.save_file import NotSaved, typed_path
from rcl_interfaces.msg import SetParametersResult
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

NAME = "_bot_console"


class ConsoleNode:
    """Watches a ROS system and acts on it for the panes; methods may be called from any thread."""

    def __init__(
        self,
        robot: DriveNode,
        log: Add,
        graph_events: GraphEvents | None = None,
        provenance: Provenance | None = None,
        history: History | None = None,
        *,
        foreign: bool = False,
        frozen: FrozenNodes | None = None,
        types: TypeSource | None = None,
    ) -> None:
        """`robot` stops the robot, and exists before anything here that may fail.

        In a `foreign` system nothing is requested before it is offered: its nodes would log warnings about us.
        """
        self.context = robot.context
        self.node = rclpy.create_node(
            NAME,
            context=self.context,
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
        )
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self._log = log
        self._warnings = GraphWarnings(log)
        self._rosout = RosoutWatch(self.node, log, foreign=foreign)
        self.loggers = self._rosout.loggers
        """Names of the loggers whose lines `/rosout` has brought."""
        self.journal = Journal(history=history)
        self.calls = Calls(self.node, self.executor)
        self._levels = LoggerLevels(self.calls, self.loggers)
        self.plots = PlotWatch(self.node)
        self.world = WorldWatch(self.node)
        self._drive_node = robot
        self.drive = robot.link
        self.provenance = provenance or Provenance()
        reported = self._parameter_changed, self.provenance, self._parameters_restarted
        self.parameters = ParameterMirror(self.node, self.calls, *reported)
        self._compared: tuple[Profile | None, object, int] = (None, None, 0)
        self.setter = ParameterSetter(self.calls, self.parameters, self.journal)
        self.traffic = NodeTraffic(self.node, self.calls, lambda: self.graph.info, types)
        self.sensors = NodeSensors(self.node, self.calls, lambda: self.graph)
        self.graph = GraphWatch(self.node, self._graph_changed, graph_events, frozen, foreign=foreign)

    def spin(self) -> None:
        """Serve until `close`; called in the console's own thread."""
        self.graph.poll()
        with contextlib.suppress(ExternalShutdownException):
            self.executor.spin()

    def close(self, why: str) -> None:
        """End `spin` and leave the graph; pending and later requests are answered with the reason."""
        self.graph.close()
        self.traffic.close()
        self.calls.close(why)
        self.executor.shutdown(timeout_sec=1.0)
        self._drive_node.close()
        self.node.destroy_node()
        self.context.try_shutdown()
        self.journal.close()

    def _graph_changed(self, graph: GraphInfo) -> None:
        self._drive_node.follow(graph)  # before anything that may fail, since it finds the locks
        self._warnings.follow(graph)
        self._rosout.follow()
        self.parameters.follow(graph)
        self.world.follow(graph)
        self.traffic.follow(graph)
        self.sensors.follow(graph)

    def _parameter_changed(self, node: str, name: str, old: Value, new: Value) -> ChangeSource:
        self.plots.parameter_is(node, name, new)
        source = self.setter.announced(node, name, old, new)
        self._warn_if_unsafe(node, name, old, new)
        return source

    def _parameters_restarted(self, node: str, name: str, old: Value, new: Value) -> None:
        self.plots.parameter_is(node, name, new)
        self.setter.restarted(node, name, old, new)
        self._warn_if_unsafe(node, name, old, new)

    def _warn_if_unsafe(self, node: str, name: str, old: Value, new: Value) -> None:
        parameter = self.parameters.get(node, name)
        why = takes_safety(parameter, old, new) if parameter else ""
        if why:
            text = f"{node} {name} {old} -> {new} {why}"
            self._log(time.time_ns(), Severity.WARN, SOURCE, text, ("", "", 0))

    def choose_robot(self, robot: str) -> None:
        """Drive another robot, and watch its surroundings."""
        self.drive.choose(robot)
        self.executor.create_task(self.world.choose, robot)

    def learn(self, kind: str, facts: Mapping[str, Any]) -> None:
        """Receive a fact that a program or a launch reports about itself; from any thread."""
        node = self.provenance.learn(kind, facts)
        if node in self.parameters.trees:
            self.calls.run(self.parameters.refresh(node), lambda why: None)

    def call(self, service: str, type_name: str, fields: Mapping[str, object]) -> Future[Answer]:
        """Call a service of any type."""
        return self.calls.run(self._call(service, type_name, fields), _not_done)

    async def _call(self, service: str, type_name: str, fields: Mapping[str, object]) -> Answer:
        from rosidl_runtime_py import set_message_fields

        package, _, rest = type_name.partition("/")
        try:
            kind = getattr(importlib.import_module(f"{package}.srv"), rest.rsplit("/", 1)[-1])
            request = kind.Request()
            set_message_fields(request, dict(fields))
            response = await self.calls.ask(kind, service, request)
        except (ImportError, AttributeError, TypeError, ValueError, OverflowError) as error:
            return Answer(False, f"{type_name} cannot be called like this: {error}")
        except NoAnswer as error:
            return Answer(False, str(error))
        result = getattr(response, "result", None)
        if isinstance(result, SetParametersResult):
            return Answer(result.successful, result.reason)
        message = getattr(response, "message", None)
        return Answer(bool(getattr(response, "success", True)), repr(response) if message is None else str(message))

    def set_logger_level(self, node: str, severity: Severity, logger: str) -> Future[Answer]:
        """Set a logger's level through the logger service of its node, if it has one."""
        return self.calls.run(self._levels.set(node, severity, logger), _not_done)

    def logger_levels(self, node: str) -> Future[tuple[LoggerLevel, ...]]:
        """The levels of a node's loggers."""
        return self.calls.run(self._levels.of(node))

    def set(
        self, node: str, values: Mapping[str, Value], source: ChangeSource, *, atomically: bool
    ) -> Future[tuple[SetOutcome, ...]]:
        """Set parameters of one node."""
        wanted = [(node, name, value) for name, value in values.items()]
        return self.calls.run(self.setter.set(node, values, source, atomically=atomically), partial(refused, wanted))

    def set_all(
        self, values: Mapping[str, Mapping[str, Value]], source: ChangeSource, by: str
    ) -> Future[tuple[SetOutcome, ...]]:
        """Set parameters of several nodes, all or none."""
        wanted = [(node, name, value) for node, found in values.items() for name, value in found.items()]
        return self.calls.run(self.setter.set_all(values, source, by), partial(refused, wanted))

    def undo(self) -> Future[Answer]:
        """Revert the last change made by this console."""
        return self.calls.run(self.setter.undo(), _not_done)

    def redo(self) -> Future[Answer]:
        """Repeat the last undone change."""
        return self.calls.run(self.setter.redo(), _not_done)

    def differences(self, profile: Profile) -> Sequence[ProfileDifference]:
        """What applying a profile now would change."""
        return differences(profile, self.parameters.trees)

    def profile_changes(self, profile: Profile | None) -> int:
        """How many values of a profile differ from those of the running nodes; recounted when a parameter changes."""
        trees = self.parameters.trees
        if self._compared[0] is not profile or self._compared[1] is not trees:
            self._compared = (profile, trees, _count(profile, trees))
        return self._compared[2]

    def apply(self, profile: Profile, reset_world: bool) -> Future[tuple[SetOutcome, ...]]:
        """Set the values that a profile changes, all or none, then reset the simulator if requested."""
        found = [each for each in self.differences(profile) if not each.unknown]
        wanted = [(each.node, each.name, each.then) for each in found]
        return self.calls.run(self._apply(profile.name, found, reset_world), partial(refused, wanted))

    async def _apply(self, name: str, found: Sequence[ProfileDifference], reset_world: bool) -> tuple[SetOutcome, ...]:
        by_node: dict[str, dict[str, Value]] = {}
        for each in found:
            by_node.setdefault(each.node, {})[each.name] = each.then
        outcomes = await self.setter.apply(name, by_node)
        if reset_world and all(each.accepted for each in outcomes):
            await self._call("/reset", "std_srvs/srv/Trigger", {})
        return outcomes

    def save(self, path: str, nodes: Sequence[str], only_changed: bool = False) -> Answer:
        """Write parameters to a file."""
        try:
            place = typed_path(path)
            saved = save(place, self.parameters.trees, tuple(nodes), only_changed=only_changed)
        except NotSaved as error:
            return Answer(False, f"not saved: {error}")
        self.journal.saved(nodes)
        return Answer(True, saved.text(place))


def refused(wanted: Iterable[tuple[str, str, Value]], why: str) -> tuple[SetOutcome, ...]:
    """Outcomes for values (node, name, value) that could not even be sent."""
    return tuple(SetOutcome(node, name, value, False, why, "console") for node, name, value in wanted)


def _count(profile: Profile | None, trees: Mapping[str, ParameterTree]) -> int:
    """How many values of a profile differ from those of the nodes that have the parameter."""
    return sum(not each.unknown for each in differences(profile, trees)) if profile else 0


def _not_done(why: str) -> Answer:
    return Answer(False, why)
