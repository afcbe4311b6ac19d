"""Finds programs that were started in other terminals, which are shown as processes but cannot be controlled from here,
and those nodes of launched programs that the launch file does not declare.

The graph of the domain tells which programs run, and `/proc` tells what started them; without `/proc` none are found.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from bot_console.tui.console.launch.vitals import FindVitals, Usage
from bot_console.tui.console.model import LaunchInfo, ProcessInfo, ProcessState

HEADING = "in other terminals"
"""The group of these programs in the list of processes."""
SEARCH_POLL_S = 1.0
"""Seconds between two searches."""
MAX_TITLE = 60
"""The length to which a displayed command is shortened."""
LAUNCHERS = ("ros2", "bot-console")
PYTHON_MODULES = {"bot_console.tui": "bot-console"}
"""The displayed names of our own programs that were started with `python -m`."""


class _Origin(NamedTuple):
    """What started a process: the pids of the process and its ancestors, and the terminal's command with its pid."""

    line: tuple[int, ...]
    command: str
    pid: int


class _ExternalProgram(NamedTuple):
    """A program that was found in the graph."""

    origin: _Origin
    usage: Usage | None


class ExternalPrograms:
    """Finds the programs of the domain that none of this console's launch hosts has started."""

    def __init__(
        self,
        processes: Callable[[], Mapping[int, Sequence[str]]] = dict,
        vitals: FindVitals = lambda pid: None,
        hosts: Callable[[], Iterable[int]] = lambda: (),
        proc: Path = Path("/proc"),
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """`processes` returns the nodes of the programs on this machine, by pid. `hosts` returns the pids of launch
        hosts whose processes are known already. `clock` returns seconds.
        """
        self._processes, self._vitals, self._hosts = processes, vitals, hosts
        self._proc, self._clock = proc, clock
        self._polled: float | None = None
        self._found: dict[int, _ExternalProgram] = {}
        self._infos: tuple[ProcessInfo, ...] = ()
        self._launched: dict[int, tuple[str, ...]] = {}
        """The nodes of launched processes, by pid."""
        self._ended: dict[str, tuple[str, ...]] = {}
        """The nodes of launched processes by key, kept for when a process has ended."""
        self._merged: tuple[tuple[object, ...], LaunchInfo] | None = None

    def merged_with(self, launch: LaunchInfo) -> LaunchInfo:
        """The launched processes and those started elsewhere; the same object until something changes."""
        now = self._clock()
        if self._polled is None or now - self._polled >= SEARCH_POLL_S:
            self._polled = now
            self._search(now, {each.pid for each in launch.processes})
        if not (self._infos or self._launched or self._ended):
            return launch
        parts = launch, self._infos, self._launched
        if self._merged is None or any(old is not new for old, new in zip(self._merged[0], parts, strict=True)):
            own = (self._with_nodes(each) for each in launch.processes)
            self._merged = parts, replace(launch, processes=(*own, *self._infos))
        return self._merged[1]

    def _with_nodes(self, process: ProcessInfo) -> ProcessInfo:
        """A process with the nodes that only the graph knows; it keeps them after its end."""
        found = self._launched.get(process.pid or 0) or self._ended.get(process.key, ())
        if found:
            self._ended[process.key] = found
        more = tuple(each for each in found if each not in process.nodes)
        return replace(process, nodes=(*process.nodes, *more)) if more else process

    def _search(self, now: float, launched: set[int | None]) -> None:
        nodes = {pid: names for pid, every in self._processes().items() if (names := _visible_nodes(every))}
        self._found = {pid: self._found.get(pid) or self._find(pid, now) for pid in sorted(nodes)}
        known = {os.getpid(), *self._hosts(), *launched}
        infos = tuple(
            _info(pid, nodes[pid], found, now)
            for pid, found in self._found.items()
            if found.origin.command and known.isdisjoint(found.origin.line)
        )
        if infos != self._infos:
            self._infos = infos
        own: dict[int, tuple[str, ...]] = {}
        for pid, found in self._found.items():
            owner = next((each for each in found.origin.line if each in launched), 0)
            own[owner] = (*own.get(owner, ()), *nodes[pid])
        own.pop(0, None)
        if own != self._launched:
            self._launched = own

    def _find(self, pid: int, now: float) -> _ExternalProgram:
        vitals = self._vitals(pid)
        return _ExternalProgram(self._origin(pid), None if vitals is None else Usage(vitals, now))

    def _origin(self, pid: int) -> _Origin:
        line, first, words = [pid], pid, self._words(pid)
        started = words
        while (parent := self._parent(line[-1])) > 1:
            line.append(parent)
            above = self._words(parent)
            if first == line[-2] and above and _runs_programs(above):
                first, started = parent, above
        return _Origin(tuple(line), _title(started) if started else "", first)

    def _words(self, pid: int) -> list[str]:
        try:
            content = (self._proc / str(pid) / "cmdline").read_bytes()
        except OSError:  # The process has ended or is another user's, or the system has no such file.
            return []
        return [each.decode("utf-8", "replace") for each in content.rstrip(b"\0").split(b"\0") if each]

    def _parent(self, pid: int) -> int:
        try:
            return int((self._proc / str(pid) / "stat").read_bytes().rpartition(b")")[2].split()[1])
        except (OSError, IndexError, ValueError):
            return 0


def _visible_nodes(nodes: Sequence[str]) -> tuple[str, ...]:
    """The nodes to show: neither those of tools, which are hidden, nor the one with which a launch sees the graph."""
    return tuple(each for each in nodes if "/_" not in each and not each.startswith("/launch_ros_"))


def _runs_programs(words: Sequence[str]) -> bool:
    """Whether a command line belongs to a program that starts nodes, rather than for example to a shell."""
    name = os.path.basename(words[0])
    return name in LAUNCHERS or name.startswith("python")


def _title(words: Sequence[str]) -> str:
    """A command roughly as it was typed: without the interpreter and the folders of files."""
    rest = list(words)
    if os.path.basename(rest[0]).startswith("python") and len(rest) > 1:
        rest = rest[1:]
        while len(rest) > 1 and rest[0].startswith("-") and rest[0] not in ("-m", "-c"):
            rest = rest[1:]
        if rest[0] == "-m" and len(rest) > 1:
            rest = [PYTHON_MODULES.get(rest[1], rest[1]), *rest[2:]]
    arguments = (os.path.basename(each) if os.path.isabs(each) else each for each in rest[1:])
    text = " ".join((os.path.basename(rest[0]), *arguments))
    return text if len(text) <= MAX_TITLE else f"{text[: MAX_TITLE - 1]}…"


def _info(pid: int, nodes: tuple[str, ...], found: _ExternalProgram, now: float) -> ProcessInfo:
    command, usage = found.origin.command, found.usage
    if usage is not None:
        usage.poll(now)
    label = nodes[0].rpartition("/")[2] if len(nodes) == 1 else f"{len(nodes)} nodes"
    return ProcessInfo(
        f"elsewhere@{pid}",
        label,
        ProcessState.RUNNING,
        pid,
        nodes,
        (HEADING, command),
        problem=usage.stall_reason if usage else "",
        cpu=usage.share if usage else None,
        memory=usage.memory if usage else None,
        started_by=f"{command} (pid {found.origin.pid})",
    )
