"""Parses the ROS arguments of a command line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

BEGIN, END = "--ros-args", "--"
REMAP = ("-r", "--remap")
PARAMETER = ("-p", "--param", "--params-file")
WITH_VALUE = ("-e", "--enclave", "--log-level", "--log-config-file", "--log-file-name")


@dataclass(frozen=True)
class RosArguments:
    """The parsed arguments: `arguments` are those not meant for ROS; `parameters` and `others` are words as given."""

    arguments: tuple[str, ...] = ()
    name: str = ""
    namespace: str = ""
    remappings: tuple[tuple[str, str], ...] = ()
    parameters: tuple[str, ...] = ()
    others: tuple[str, ...] = ()


def read_ros_arguments(words: Sequence[str]) -> RosArguments:
    """Parse the words after a program's name; never raises."""
    arguments: list[str] = []
    rules: list[tuple[str, str]] = []
    parameters: list[str] = []
    others: list[str] = []
    inside = False
    rest = iter(words)
    for word in rest:
        if not inside or word in (BEGIN, END):
            if word == BEGIN or (inside and word == END):
                inside = word == BEGIN
            else:
                arguments.append(word)
        elif word in REMAP:
            source, _, target = next(rest, "").partition(":=")
            rules.append((source, target))
        elif word in PARAMETER:
            parameters += [word, next(rest, "")]
        else:
            others += [word, next(rest, "")] if word in WITH_VALUE else [word]
    names = [target for source, target in rules if source in ("__node", "__name")]
    spaces = [target for source, target in rules if source == "__ns"]
    remappings = tuple(each for each in rules if each[0] not in ("__node", "__name", "__ns"))
    # In rcl, the first of several matching rules counts.
    return RosArguments(
        tuple(arguments),
        names[0] if names else "",
        spaces[0] if spaces else "",
        remappings,
        tuple(parameters),
        tuple(others),
    )
