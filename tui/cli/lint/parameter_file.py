"""Checks parameter files for what ROS would reject, and for values that reach no parameter."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

from bot_console.runtime.rmw.parameter_file import read_parameter_file
from bot_console.runtime.rmw.parameter_overrides import ParameterOverrides, ParameterYamlError
from bot_console.tui.cli.lint.finding import LintFinding
from bot_console.tui.cli.lint.parameter_declarations import DeclaredNames
from bot_console.tui.console.parameters.file.node_keys import is_wildcard
from bot_console.tui.console.parameters.file.text import KEYWORD, sections

_MEANT = re.compile(r"^\s*ros_+parameters\s*:", re.MULTILINE)
_NO_KEYWORD = "Cannot have a value before"
_LINE = re.compile(r",?(?: Error)?(?: at| near)? line(?:_num)? (\d+)")


def looks_like_parameter_file(path: Path) -> bool:
    """Whether a YAML file is meant as a parameter file, even if it is malformed."""
    try:
        return _MEANT.search(path.read_text(encoding="utf-8-sig", errors="replace")) is not None
    except OSError:
        return True  # reading it later reports why


def rejections(path: Path) -> Iterator[LintFinding]:
    """The finding that says why a node would not start with this file, if it would not."""
    try:
        read_parameter_file(str(path), ParameterOverrides())
    except ParameterYamlError as error:
        message = str(error).strip()
        named = _LINE.search(message)
        place, _, hint = error.hint.removeprefix(str(path)).removeprefix(":").partition(": ")
        line = int(place) if place.isdigit() else int(named[1]) if named else 0
        if message.startswith(_NO_KEYWORD) and not hint:
            hint = "expected: a node's name, below it ros__parameters, and below that name: value"
        yield LintFinding(str(path), line, "refused", _LINE.sub("", message).rstrip("."), hint)


def dead_values(path: Path, declared: DeclaredNames) -> Iterator[LintFinding]:
    """Keys that match no node, and parameters that no node declares."""
    try:
        text = path.read_text(encoding="utf-8-sig")
        found = sections(text) if KEYWORD in text else []
    except (ValueError, OSError) as error:
        print(f"{path}: {error}", file=sys.stderr)
        return
    for section in found:
        line = section.mapping.line
        if not is_wildcard(section.key) and section.key.rpartition("/")[2] not in declared.nodes:
            yield LintFinding(str(path), line, "dead key", section.key)
            continue
        for name, place in section.places.items() if declared.whole else ():
            if name not in declared.parameters and name != "use_sim_time" and not name.startswith("qos_overrides."):
                yield LintFinding(str(path), place.line, "dead parameter", f"{section.key} {name}")
