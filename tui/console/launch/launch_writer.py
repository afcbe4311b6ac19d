"""Writes a launch file and a parameter file that start the nodes of a running system again, as far as they are known.

Known are the processes that the launch hosts of the domain have started, and the command lines of programs that run on
this machine. Everything else is written as a comment that begins with `UNKNOWN`.
"""

from __future__ import annotations

import json
import os
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, cast

from bot_console.tui.console.graph.lifecycle_states import GET_STATE
from bot_console.tui.console.launch.ros_arguments import read_ros_arguments
from bot_console.tui.console.model import GraphInfo, LaunchInfo, NodeInfo, ParameterTree, ProcessState, Program
from bot_console.tui.console.parameters.file.saving import save
from bot_console.tui.console.parameters.provenance import WRITTEN_BY_LAUNCH
from bot_console.tui.files.save_file import NotSaved, save_file

MARK = "written by `bot-console graph --launch`"
"""Stands in the first line of both files: existing files are replaced only if they contain it."""
SUFFIX = ".launch.py"
CONTAINERS = (
    "component_container",
    "component_container_mt",
    "component_container_isolated",
    "component_container_event",
)
LAUNCH = ("ros2", "launch")
"""The beginning of a command that runs another launch file."""
ALIVE = (ProcessState.STARTING, ProcessState.RUNNING)
HEAD = '''\
"""Starts the nodes of a running system again, {mark}.

Event handlers, delays, conditions and arguments of the launch files that started them are not known here.{unknown}
"""

{imports}from launch import LaunchDescription
from launch_ros.actions import Node
{constants}

def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
'''


@dataclass(frozen=True)
class RunningSystem:
    """What is known of a running system."""

    graph: GraphInfo
    launch: LaunchInfo = field(default_factory=LaunchInfo)
    parameters: Mapping[str, ParameterTree] = field(default_factory=dict[str, ParameterTree])
    processes: Mapping[int, Sequence[str]] = field(default_factory=dict[int, Sequence[str]])
    """The nodes of programs on this machine, by pid."""


@dataclass(frozen=True)
class WrittenLaunch:
    """The files that were written, and what they do not contain."""

    launch_file: Path
    parameter_file: Path | None
    started: int
    """Number of programs."""
    unknown: tuple[str, ...]
    left_out: tuple[str, ...]
    """Parameters that no file can contain, with the reason."""

    @property
    def text(self) -> str:
        """A summary of the result for the user."""
        files = " and ".join(str(each) for each in (self.launch_file, self.parameter_file) if each)
        parts = [f"{files}: {self.started} program{'' if self.started == 1 else 's'}"]
        if self.unknown:
            parts.append(f"marked as UNKNOWN: {', '.join(self.unknown)}")
        return "; ".join((*parts, *(f"left out: {each}" for each in self.left_out)))


def write_launch(path: Path, system: RunningSystem) -> WrittenLaunch:
    """Write `NAME.launch.py`, and `NAME.yaml` beside it; raises `NotSaved` if that fails."""
    if not path.name.endswith(SUFFIX):
        path = path.with_name(f"{path.name.removesuffix('.py')}{SUFFIX}")
    parameter_file = path.with_name(f"{path.name.removesuffix(SUFFIX)}.yaml")
    for each in (path, parameter_file):
        _check_replaceable(each)
    starts, unknown = found_starts(system)
    if not starts and not unknown:
        raise NotSaved("there are no nodes to start")
    # The parameters of all nodes: a program takes those of its own nodes, whose names may be unknown here.
    trees = {name: tree for name, tree in system.parameters.items() if not _is_tool(name)}
    left_out: tuple[str, ...] = ()
    written = False
    if any(tree.parameters for tree in trees.values()):
        parameter_file.unlink(missing_ok=True)
        saved = save(parameter_file, trees, all_of_them=True, title=f"# Parameters of a running system, {MARK}.\n")
        left_out, written = saved.left_out, True
    save_file(path, _text(starts, unknown, system, parameter_file.name if written else ""))
    names = tuple(each.name for each in unknown)
    return WrittenLaunch(path, parameter_file if written else None, len(starts), names, left_out)


def _check_replaceable(path: Path) -> None:
    try:
        with path.open(encoding="utf-8", errors="replace") as file:
            ours = MARK in file.readline(200)
    except FileNotFoundError:
        return
    except OSError as error:
        raise NotSaved(f"{path}: {error.strerror}") from None
    if not ours:
        raise NotSaved(f"{path} is there already, and was not written here; give another name")


@dataclass(frozen=True)
class Start:
    """A program to start, with its known nodes."""

    program: Program
    nodes: tuple[str, ...]


def found_starts(system: RunningSystem) -> tuple[list[Start], list[NodeInfo]]:
    """The programs of a system, and the nodes whose programs are not known."""
    starts = [*_launched_programs(system)]
    covered = {node for each in starts for node in each.nodes}
    launched = {each.pid for each in system.launch.processes}
    for pid, nodes in sorted(system.processes.items()):
        if pid in launched:
            continue
        own = tuple(node for node in nodes if node not in covered and not _is_tool(node))
        if own and (program := _program_of(pid)) is not None:
            if program.command[:2] == LAUNCH:  # several processes of one launch share its command line
                others = [each for each in starts if each.program == program]
                starts = [each for each in starts if each.program != program]
                own = (*(node for each in others for node in each.nodes), *own)
            starts.append(Start(program, own))
            covered.update(own)
    rest = [each for each in system.graph.nodes if each.name not in covered and not _is_tool(each.name)]
    return starts, rest


def _launched_programs(system: RunningSystem) -> Iterator[Start]:
    there = {each.name for each in system.graph.nodes}
    for each in system.launch.processes:
        if each.program is None or each.state not in ALIVE:
            continue
        nodes = [*each.nodes]
        if each.pid is not None and not _is_container(each.program):
            nodes += [node for node in system.processes.get(each.pid, ()) if not _is_tool(node)]
        folder = each.program.folder or (
            _folder_it_needs(each.pid, each.program) if each.pid in system.processes else ""
        )
        program = replace(each.program, folder=folder)
        yield Start(program, tuple(dict.fromkeys(node for node in nodes if node in there)))


def _folder_it_needs(pid: int | None, program: Program) -> str:
    """The folder in which a process of this machine runs, if its command line names a file there; otherwise empty."""
    try:
        folder = os.readlink(f"/proc/{pid}/cwd")
    except OSError:
        return ""
    words = (each for each in program.command if not os.path.isabs(each))
    return folder if any(os.path.isfile(os.path.join(folder, each)) for each in words) else ""


def _is_tool(node: str) -> bool:
    """Whether a node belongs to a tool: hidden, or one with which a launch sees the graph."""
    return "/_" in node or node.startswith("/launch_ros_")


def _is_container(program: Program) -> bool:
    return os.path.basename(program.command[0]) in CONTAINERS if program.command else False


def _program_of(pid: int) -> Program | None:
    """The program of a process on this machine, from its command line; None if that names no program with nodes."""
    try:
        content = Path(f"/proc/{pid}/cmdline").read_bytes()
        folder = os.readlink(f"/proc/{pid}/cwd")
    except OSError:
        return None
    words = [each.decode("utf-8", "replace") for each in content.rstrip(b"\0").split(b"\0")]
    at = next(
        (index for index, each in enumerate(words[:3]) if os.path.basename(each) in ("ros2", "bot-console")), None
    )
    if at is None:
        is_own = any(each.startswith("bot_console.") for each in words[:4])
        return None if is_own or not words[0] else Program(tuple(words), folder=folder)
    verb, *rest = words[at + 1 :] or [""]
    if verb == "launch" and rest:
        return Program((*LAUNCH, *rest), folder=folder)
    if verb != "run" or not rest or rest[0].startswith("-"):
        return None
    if os.path.isfile(os.path.join(folder, rest[0])):
        return Program(("python3", *rest), folder=folder)
    return Program(tuple(rest[1:]), package=rest[0], folder=folder) if len(rest) > 1 else None


def _text(starts: Sequence[Start], unknown: Sequence[NodeInfo], system: RunningSystem, parameter_file: str) -> str:
    about = {each.name: each for each in system.graph.nodes}
    body = "".join(_start_text(each, about, system.parameters, parameter_file) for each in starts)
    body += "".join(_unknown_text(each, bool(parameter_file)) for each in unknown)
    is_process = any(not _is_node(each) for each in starts)
    imports = "from pathlib import Path\n\n" if parameter_file else ""
    constants = ""
    if parameter_file:
        constants = f"\nPARAMETERS = str(Path(__file__).with_name({_quoted(parameter_file)}))\n"
    named = f" Search for UNKNOWN:\n{len(unknown)} of its nodes cannot be started by it yet." if unknown else ""
    head = HEAD.format(mark=MARK, imports=imports, constants=constants, unknown=named)
    if is_process:
        head = head.replace("from launch_ros", "from launch.actions import ExecuteProcess\nfrom launch_ros")
    return f"{head}{body}        ]\n    )\n"


def _is_node(start: Start) -> bool:
    program = start.program
    is_node = program.package or start.nodes or "--ros-args" in program.command
    return bool(is_node) and program.command[:2] != LAUNCH


def _start_text(
    start: Start, about: Mapping[str, NodeInfo], trees: Mapping[str, ParameterTree], parameter_file: str
) -> str:
    program = start.program
    if not _is_node(start):
        given: dict[str, Any] = {"cmd": [*shlex.split(program.prefix), *program.command], "cwd": program.folder or None}
        names = f"            # its nodes: {_plain(', '.join(start.nodes))}\n" if start.nodes else ""
        return names + _call("ExecuteProcess", {**given, **_respawn(program)})
    ros = read_ros_arguments(program.command[1:])
    executable = os.path.basename(program.command[0]) if program.package else program.command[0]
    others = list(ros.others)
    comments = [] if start.nodes else ["UNKNOWN: the names of its nodes"]
    comments += [f"{node}: {why}" for node in start.nodes for why in _remarks(about.get(node), node in trees)]
    if not parameter_file or not start.nodes or any(node not in trees for node in start.nodes):
        others += _without_temporary_files(ros.parameters)
    arguments = {
        "package": program.package or None,
        "executable": executable,
        "name": ros.name or None,
        "namespace": ros.namespace or None,
        "arguments": list(ros.arguments) or None,
        "ros_arguments": others or None,
        "parameters": ["PARAMETERS"] if parameter_file else None,
        "remappings": list(ros.remappings) or None,
        "prefix": program.prefix or None,
        "cwd": program.folder or None,
        **_respawn(program),
    }
    return "".join(f"            # {_plain(each)}\n" for each in comments) + _call("Node", arguments)


def _without_temporary_files(words: Sequence[str]) -> Iterator[str]:
    """The parameter options of a command line, without the files that launch creates and removes."""
    for option, value in zip(words[::2], words[1::2], strict=True):
        if not os.path.basename(value).startswith(WRITTEN_BY_LAUNCH):
            yield from (option, value)


def _respawn(program: Program) -> dict[str, Any]:
    if not program.respawn:
        return {}
    return {"respawn": True, "respawn_delay": program.respawn_delay}


def _remarks(node: NodeInfo | None, known: bool) -> Iterator[str]:
    if not known:
        yield "UNKNOWN: its parameters, since it does not answer; those of its command line are kept"
    if node is not None and node.copies > 1:
        yield f"UNKNOWN: {node.copies} nodes have this name"
    if node is not None and any(GET_STATE in each.types for each in node.services):
        yield "a lifecycle node, which starts unconfigured"


def _unknown_text(node: NodeInfo, parameters: bool) -> str:
    space, _, name = node.name.rpartition("/")
    namespace = f", namespace={_quoted(space)}" if space else ""
    topics = [each.name for each in (*node.publishers, *node.subscriptions) if "/_" not in each.name]
    used = f"; it uses {', '.join(dict.fromkeys(topics))}" if topics else ""
    given = ", parameters=[PARAMETERS]" if parameters else ""
    lines = (
        f"UNKNOWN: what started {node.name}{used}",
        f'Node(package="?", executable="?", name={_quoted(name)}{namespace}{given}),',
    )
    return "".join(f"            # {_plain(each)}\n" for each in lines)


def _plain(text: str) -> str:
    return " ".join("".join(each if each.isprintable() else "?" for each in text).split())


def _call(name: str, arguments: Mapping[str, Any]) -> str:
    given = "".join(
        f"                {key}={_literal(value)},\n" for key, value in arguments.items() if value is not None
    )
    return f"            {name}(\n{given}            ),\n"


def _literal(value: Any) -> str:
    if value == ["PARAMETERS"]:
        return "[PARAMETERS]"
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, (list, tuple)):
        items = ", ".join(map(_literal, cast("Sequence[Any]", value)))
        return f"[{items}]" if isinstance(value, list) else f"({items})"
    return repr(value)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)
