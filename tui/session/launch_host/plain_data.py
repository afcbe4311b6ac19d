"""Converts a launcher's state to plain data and back."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from typing import Any

from bot_console.tui.console.model import (
    LaunchArgument,
    LaunchEvent,
    LaunchInfo,
    ProcessInfo,
    ProcessState,
    Program,
    Severity,
)


def info_to_data(info: LaunchInfo, timeline_from: int) -> dict[str, Any]:
    """The state of a launcher as plain data, with the timeline events from number `timeline_from` on."""
    return {
        "files": list(info.files),
        "problem": info.problem,
        "delayed": info.delayed,
        "processes": [{**asdict(each), "state": each.state.value} for each in info.processes],
        "timeline": [
            [each.seq, each.stamp, each.text, int(each.severity)] for each in info.timeline if each.seq >= timeline_from
        ],
    }


def info_from_data(data: Mapping[str, Any], before: LaunchInfo, kept: int) -> LaunchInfo:
    """Apply the data of `info_to_data` to the previous state; unchanged parts are the same objects."""
    known = {each.key: each for each in before.processes}
    processes: list[ProcessInfo] = []
    for each in data["processes"]:
        process = _process(each)
        same = known.get(process.key)
        processes.append(same if same is not None and same == process else process)
    events = (LaunchEvent(seq, stamp, text, Severity(severity)) for seq, stamp, text, severity in data["timeline"])
    timeline = (*before.timeline, *events)[-kept:]
    return LaunchInfo(tuple(data["files"]), tuple(processes), timeline, data["problem"], data.get("delayed", 0))


def _process(data: Mapping[str, Any]) -> ProcessInfo:
    fields = dict(data)
    fields.update(state=ProcessState(data["state"]), nodes=tuple(data["nodes"]), group=tuple(data["group"]))
    if (program := data.get("program")) is not None:
        words: dict[str, Any] = {**program, "command": tuple(program["command"])}
        fields["program"] = Program(**words)
    return ProcessInfo(**fields)


def arguments_to_data(arguments: Iterable[LaunchArgument]) -> list[dict[str, Any]]:
    """The arguments of a launch file as plain data."""
    return [asdict(each) for each in arguments]


def arguments_from_data(data: Sequence[Mapping[str, Any]]) -> tuple[LaunchArgument, ...]:
    """The arguments from the data of `arguments_to_data`."""
    return tuple(
        LaunchArgument(each["name"], each["description"], each["default"], tuple(each["choices"])) for each in data
    )
