"""One scene, played to a console: what the backend of each pane sees of it, as plain data that can be compared.

It needs only the public interfaces of ROS 2, so that the same can be recorded on our runtime and on a real one. What
differs from run to run (times, process ids), and what each release of ROS 2 adds to every node, is left out.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.model import Endpoint, LaunchInfo, LogFilter, ParameterInfo, Severity
from bot_console.tui.console.protocol import Console
from rigs import ARM, ROBOT, TIMEOUT_S, Rig, until

LEVEL = "/level"
EVERY_NODES_OWN = re.compile(
    r"/(rosout|parameter_events|.*/(get_type_description|[gs]et_logger_levels|(get|set|list|describe)_parameter\w*))$"
)
"""Topics and services that come with every node, and whose number depends on the release."""
OF_A_RELEASE = ("use_sim_time", "start_type_description_service")
SETS: Sequence[tuple[str, str, Any]] = (
    (ROBOT, "speed", 1.5),
    (ROBOT, "speed", 2.5),
    (ROBOT, "speed", 1),
    (ROBOT, "count", -4),
    (ROBOT, "count", 2.0),
    (ROBOT, "mode", "brave"),
    (ROBOT, "frame", "map"),
    (ROBOT, "gains", (3.0,)),
    (ROBOT, "gains", (1.0, "x")),
    (ROBOT, "nothing", 1.0),
    ("/nobody", "speed", 1.0),
    (ARM, "reach", 0.25),
)

WOULD_CHANGE = ("careful", "slow", "wild")
"""Profiles, the last of which is refused."""

Pane = Callable[[Rig], Any]


def parameters(rig: Rig) -> Any:
    """The Parameters pane: the parameters listed for both nodes."""
    trees = rig.console.snapshot().parameters
    listed = {node: sorted(trees[node].parameters, key=lambda each: each.name) for node in (ROBOT, ARM)}
    return {node: [_parameter(each) for each in found if _is_ours(each)] for node, found in listed.items()}


def _is_ours(parameter: ParameterInfo) -> bool:
    return parameter.name not in OF_A_RELEASE and not parameter.name.startswith("qos_overrides.")


def _parameter(each: ParameterInfo) -> dict[str, Any]:
    span = each.range and [each.range.low, each.range.high, each.range.step]
    return {
        **{"name": each.name, "kind": each.kind.name, "value": _plain(each.value), "default": _plain(each.default)},
        **{"description": each.description, "range": span, "read_only": each.read_only, "dynamic": each.dynamic},
    }


def sets(rig: Rig) -> Any:
    """Setting: each outcome with who refused it and why; the node's own callback; several at once; undo and redo."""
    console, before = rig.console, len(rig.console.parameters.changes())
    reported: list[Any] = []

    def ask(node: str, values: Mapping[str, Any], *, atomically: bool = False) -> None:
        """Set, and wait for the journal: the event of an accepted value may follow the next answer."""
        reported.extend(_outcome(each) for each in _set(console, node, values, atomically=atomically))
        until(lambda: len(console.parameters.changes()[before:]) == len(reported), "the journal")

    for node, name, value in SETS:
        ask(node, {name: value})
    ask(ROBOT, {"speed": 9.0, "count": 5}, atomically=True)
    rig.forbid_speed()
    ask(ROBOT, {"speed": 1.0})
    changes = console.parameters.changes()[before:]
    journal = [[each.name, _plain(each.old), _plain(each.new), each.source.value, each.accepted] for each in changes]
    taken_back = console.parameters.undo().result(TIMEOUT_S).ok
    until(lambda: _value(console, ARM, "reach") == 1.0, "the value before")
    made_again = console.parameters.redo().result(TIMEOUT_S).ok
    until(lambda: _value(console, ARM, "reach") == 0.25, "the value again")
    return {"outcomes": reported, "journal": journal, "undo": taken_back, "redo": made_again}


def _set(console: Console, node: str, values: Mapping[str, Any], *, atomically: bool = False) -> Sequence[Any]:
    return console.parameters.set(node, values, atomically=atomically).result(TIMEOUT_S)


def _outcome(each: Any) -> list[Any]:
    return [each.node, each.name, _plain(each.value), each.accepted, each.refused_by, each.reason]


def _value(console: Console, node: str, name: str) -> Any:
    return getattr(console.snapshot().parameters[node].get(name), "value", None)


def profiles(rig: Rig) -> Any:
    """The Profiles pane: what each profile would change, and the result of applying one."""
    console = rig.console
    would = {name: [_difference(each) for each in console.profiles.differences(name)] for name in WOULD_CHANGE}
    applied = [_outcome(each) for each in console.profiles.apply("wild").result(TIMEOUT_S)]
    return {"would change": would, "wild": applied}


def _difference(each: Any) -> list[Any]:
    return [each.node, each.name, _plain(each.now), _plain(each.then), each.refusal, each.unknown]


def graph(rig: Rig) -> Any:
    """The Graph pane: both nodes with types and QoS of their endpoints."""

    def nodes() -> Mapping[str, Any]:
        return {each.name: each for each in rig.console.snapshot().graph.nodes}

    until(lambda: any(each.name == LEVEL for each in nodes()[ROBOT].publishers), "the publishers")
    kinds = ("publishers", "subscriptions", "services", "clients", "action_servers")
    found = {name: {kind: _ends(getattr(nodes()[name], kind)) for kind in kinds} for name in (ROBOT, ARM)}
    return {"nodes": found, "unheard": list(rig.console.snapshot().graph.unheard)}


def _ends(ends: Sequence[Endpoint]) -> list[list[Any]]:
    """Endpoints with reliability and durability; DDS does not report the depth of a queue."""
    named = [each for each in ends if not EVERY_NODES_OWN.search(each.name)]
    return sorted([each.name, list(each.types), " ".join(each.qos.split()[:2])] for each in named)


def logs(rig: Rig) -> Any:
    """The Logs pane: one line of each severity."""
    for severity in (Severity.INFO, Severity.WARN, Severity.ERROR, Severity.FATAL):
        rig.show_text(severity, f"it is {severity.name}")
    which = LogFilter(words="node:robot")

    def all_four() -> Sequence[int]:
        found = rig.console.logs.matching(which, 0)
        return list(found) if len(found) == 4 else ()

    numbers = until(all_four, "the lines")
    lines = [rig.console.logs.record(each) for each in numbers]
    return [[each.severity.name, each.node, each.text, bool(each.file and each.line)] for each in lines if each]


def topics(rig: Rig) -> Any:
    """The Topics pane: a message as a tree, a service call, and a call of a service that does not exist."""
    traffic = rig.console.topics
    traffic.listen(LEVEL)
    until(rig.heard_by_somebody, "the subscription")
    rig.publish(1.25)
    heard = until(lambda: message if (message := traffic.heard()).fields else None, "the message")
    replies = [
        traffic.call(service, "std_srvs/srv/Trigger", {}).result(TIMEOUT_S) for service in ("/greet", "/nowhere")
    ]
    traffic.listen("")
    return {
        "heard": [heard.topic, heard.type, [[each.path, each.type, each.text] for each in heard.fields]],
        "greet": [replies[0].ok, [[each.path, each.type, each.text] for each in replies[0].fields]],
        "nowhere": [replies[1].ok, replies[1].text],
    }


def plot(rig: Rig) -> Any:
    """The Plot pane: a curve of a topic and of a parameter."""
    console, curves = rig.console, ("/level/data", f"{ROBOT}:speed")
    watched = [console.plots.watch(each).ok for each in curves]
    until(rig.heard_by_somebody, "the subscription")
    for each in (0.5, -2.0):
        rig.publish(each)
    until(lambda: list(console.plots.samples(curves[0]).values)[-2:] == [0.5, -2.0], "the curve")
    values = [list(console.plots.samples(each).values)[-2:] for each in curves]
    for each in curves:
        console.plots.unwatch(each)
    return {"watched": watched, "values": values, "refused": console.plots.watch("/nowhere/data").text}


def steering(rig: Rig) -> Any:
    """The Steering pane: what the robot received of a command, of ALL STOP, of a command while it holds, and after
    it.
    """

    def give(velocity: tuple[float, float]) -> None:
        def heard() -> bool:
            rig.console.drive.move(*velocity)
            return velocity in rig.received

        until(heard, f"the command {velocity}")

    give((0.5, -0.25))
    drive = rig.console.snapshot().drive
    rig.console.drive.stop(True)
    until(lambda: rig.received[-1] == (0.0, 0.0), "the stop")
    rig.console.drive.move(1.0, 0.0)
    rig.console.drive.stop(False)
    until(lambda: not rig.console.snapshot().drive.stopped, "the end of the stop")
    give((0.1, 0.0))
    heard = [each for number, each in enumerate(rig.received) if number == 0 or each != rig.received[number - 1]]
    return {"topic": drive.topic, "robots": list(drive.robots), "heard": heard}


def loggers(rig: Rig) -> Any:
    """Logger levels, set and listed."""
    answers = [rig.console.logs.set_level(node, Severity.WARN).result(TIMEOUT_S).ok for node in (ROBOT, "/nobody")]
    reported = {each.logger: each.severity.name for each in rig.console.logs.levels(ROBOT).result(TIMEOUT_S)}
    return {"set": answers, "robot": reported.get("robot")}


PANES: Mapping[str, Pane] = {
    **{"parameters": parameters, "profiles": profiles, "graph": graph, "logs": logs, "topics": topics},
    **{"plot": plot, "steering": steering, "loggers": loggers, "sets": sets},
}
"""In this order, since each depends on what the previous ones have left behind."""


def play(rig: Rig) -> dict[str, Any]:
    """What each pane saw."""
    return {name: pane(rig) for name, pane in PANES.items()}


def play_launch(launcher: Launcher, info: Callable[[], LaunchInfo], settle: Callable[[], None], path: str) -> Any:
    """The Launch pane: one process, launched, restarted, stopped, started and killed, and verbs that do not apply."""
    began = launcher.launch(path, {"robot": "bob"}).result(TIMEOUT_S)
    seen: list[Any] = ["launch", began.ok]
    for verb in ("", "restart", "start", "stop", "stop", "start", "kill", "kill"):
        settle()
        if verb:
            answer = getattr(launcher, verb)(info().processes[-1].key).result(TIMEOUT_S)
            seen += [verb, answer.ok, _without_ids(answer.text)]
            settle()
        process = info().processes[-1]
        label, runs = _without_ids(process.label), process.started > process.ended
        seen.append([label, process.state.value, process.restarts, process.exit_code, runs, list(process.group)])
    nobody = launcher.stop("nobody").result(TIMEOUT_S)
    reported = [_without_ids(each.text) for each in info().timeline]
    return {
        "steps": seen,
        "nobody": nobody.ok,
        "timeline": [each for each in reported if not each.endswith("has ended")],
    }


def _without_ids(text: str) -> str:
    """Text without process ids, launch's process numbers, and the folder of the file.

    The end of a file whose processes have all ended is reported at varying places, so it is left out.
    """
    text = re.sub(r", pid \d+", "", text)
    return re.sub(r"(\.py)-\d+\b", r"\1", re.sub(r"\S+/(?=\w+\.launch\.py)", "", text))


def _plain(value: Any) -> Any:
    """The value as JSON returns it."""
    return list(value) if isinstance(value, (tuple, list)) else value
