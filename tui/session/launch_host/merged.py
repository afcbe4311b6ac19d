"""Merges the states of several launch hosts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from bot_console.tui.console.launch.timeline import MAX_EVENTS
from bot_console.tui.console.model import LaunchEvent, LaunchInfo, ProcessInfo

SEPARATOR = "|"
"""Separates the name of a host from the key of a process on it."""


class MergedInfo:
    """Merges states: keys are prefixed with the host's name, events are renumbered in order of arrival."""

    def __init__(self) -> None:
        self._infos: dict[str, LaunchInfo] = {}
        self._seen: dict[str, int] = {}
        self._info = LaunchInfo()

    def forget(self, name: str, text: str) -> None:
        """Remove a host, and add a text as an event."""
        self._infos = {}  # forces the next merge, even if the result is empty
        self._seen.pop(name, None)
        stamp = self._info.timeline[-1].stamp if self._info.timeline else 0
        self._add([LaunchEvent(0, stamp, text)])

    def merge(self, infos: Mapping[str, LaunchInfo]) -> LaunchInfo:
        """Merge the states of hosts, by their names; returns the same object if nothing is new.

        If several hosts have a problem, that of the last one is shown.
        """
        same = infos.keys() == self._infos.keys() and all(infos[name] is self._infos[name] for name in infos)
        if same and (infos or not self._info.processes):
            return self._info
        self._infos = dict(infos)
        new: list[LaunchEvent] = []
        for name, info in infos.items():
            new += [each for each in info.timeline if each.seq > self._seen.get(name, -1)]
            if info.timeline:
                self._seen[name] = info.timeline[-1].seq
        self._info = LaunchInfo(
            tuple(file for each in infos.values() for file in each.files),
            tuple(_with_host_key(name, process) for name, each in infos.items() for process in each.processes),
            self._info.timeline,
            next((each.problem for each in [*infos.values()][::-1] if each.problem), ""),
            sum(each.delayed for each in infos.values()),
        )
        self._add(sorted(new, key=lambda each: each.stamp))
        return self._info

    def _add(self, events: Sequence[LaunchEvent]) -> None:
        first = self._info.timeline[-1].seq + 1 if self._info.timeline else 0
        numbered = (replace(each, seq=first + at) for at, each in enumerate(events))
        self._info = replace(self._info, timeline=(*self._info.timeline, *numbered)[-MAX_EVENTS:])


def _with_host_key(name: str, process: ProcessInfo) -> ProcessInfo:
    return replace(process, key=f"{name}{SEPARATOR}{process.key}")
