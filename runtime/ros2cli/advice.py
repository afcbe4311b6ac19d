"""Advice for a person at a terminal, beyond the output of `ros2`; programs that read the output do not get it."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterable, Sequence

from bot_console.runtime.programs.hints import did_you_mean, is_read
from bot_console.runtime.programs.hints import wrong_type as _written

FEW = 8
"""How many names fit into a hint of one or two lines."""
ABOUT_DDS = {"multicast", "security"}
"""Commands of ROS 2 that are meaningless here."""
NEEDS_TYPE = {("topic", "pub"): "topic", ("service", "call"): "service", ("action", "send_goal"): "action"}
"""Verbs that take a name and its type, and the command that prints the type."""
_WRONG_TYPE = r"Wrong parameter type, expected 'Type\.(\w+)' got 'Type\.(\w+)'"


def advise(text: Callable[[], str]) -> None:
    """Print a hint on stderr if stderr is a terminal; `text` is called only then, and an empty hint is not printed."""
    if is_read() and (message := text()):
        print(message, file=sys.stderr)


def no_parameter(node: str, name: str, names: Iterable[str]) -> str:
    """Return the hint that a node does not declare a parameter, with the most similar name that it does declare."""
    meant = did_you_mean(name, names)
    return f"{node} has no parameter {name}{meant or f'; ros2 param list {node} shows those it has'}"


def no_node(name: str, names: Sequence[str]) -> str:
    """Return the hint that no node has the name, with the most similar one that runs, or all if they are few."""
    if not names:
        return "no node runs in this ROS domain"
    near = did_you_mean(name, names)
    listed = f"; there are: {', '.join(names)}" if len(names) <= FEW else ""
    return f"no node {name} runs{near or listed}"


def no_subscription(topic: str, kind: str, kinds: Iterable[str], subscribed: Iterable[str]) -> str:
    """Return why nobody receives what is published: subscriptions of other types, or a topic with a similar name."""
    others = sorted(set(kinds) - {kind})
    if others:
        return f"{topic} is subscribed to as {', '.join(others)}, which does not match {kind}"
    near = did_you_mean(topic, subscribed)
    return f"nobody subscribes to {topic}{near}" if near else ""


def wrong_type(name: str, value: str, reason: str) -> str:
    """Return how to write a value that was refused for its type; empty if `reason` is a different one."""
    found = re.match(_WRONG_TYPE, reason)
    if found is None:
        return ""
    return _written(name, value, *found.groups())


def usage(words: Sequence[str]) -> str:
    """Return what replaces a missing option or command, or how to find a missing type; otherwise empty."""
    if words and words[0] in ABOUT_DDS:
        return f"bot-console has no `ros2 {words[0]}`: it is about DDS, which bot-console does not use"
    if len(words) == 3 and not words[2].startswith("-") and (of := NEEDS_TYPE.get((words[0], words[1]))):
        return f"the type is missing after {words[2]}; `ros2 {of} type {words[2]}` prints it"
    if list(words[:2]) == ["param", "dump"] and "--output-dir" in words[:-1]:
        folder = words[words.index("--output-dir") + 1].rstrip("/") or "/"
        node = next((each for each in words[2:] if each.startswith("/")), "/node")
        file = f"{folder}/{node.strip('/').replace('/', '__')}.yaml"
        make = "" if os.path.isdir(folder) else f"mkdir -p {folder} && "
        return f"Jazzy has no --output-dir, and prints the parameters: {make}ros2 param dump {node} > {file}"
    return ""


def launch_files(package: str, names: Sequence[str]) -> str:
    """Return the hint that lists a package's launch files, for a command line that names none or an unknown one."""
    if not names:
        return f"package '{package}' has no launch files; they are in its folder launch/, and setup.py installs them"
    return f"package '{package}' has: {', '.join(names)}"
