"""Profiles: named ROS parameter files that can be applied to the running system."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, cast

import yaml
from bot_console.tui.console.model import ParameterTree, Profile, ProfileDifference, Value
from bot_console.tui.console.values import refusal

Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
KEYWORD = "ros__parameters"
AT_RESET = "at reset"
"""A parameter whose description says so needs a reset of the world to take effect."""


def find(folders: Iterable[Path]) -> tuple[Profile, ...]:
    """The profiles of some folders, by file name; a file that cannot be read is a profile with a problem."""
    files = sorted({path.stem: path for folder in folders for path in sorted(folder.glob("*.yaml"))}.items())
    return tuple(load(path) for _, path in files)


def load(path: Path) -> Profile:
    """Read a ROS parameter file as a profile; its first comment line is the title."""
    try:
        text = path.read_text(encoding="utf-8")
        values = dict(_values("", _mapping(yaml.load(text, Loader)) or {}))
    except (OSError, UnicodeDecodeError) as error:
        return Profile(path.stem, str(path), problem=f"cannot be read: {error}")
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f" in line {mark.line + 1}" if mark else ""
        return Profile(path.stem, str(path), problem=f"not YAML{where}: {getattr(error, 'problem', error)}")
    except ValueError as error:
        return Profile(path.stem, str(path), problem=str(error))
    if not values:
        return Profile(path.stem, str(path), problem=f"sets nothing; a parameter stands below 'node_name: {KEYWORD}:'")
    first = next((line[1:].strip() for line in text.splitlines() if line.startswith("#")), "")
    world = values.get(("/simulator", "world"), "")
    return Profile(path.stem, str(path), first, MappingProxyType(values), str(world))


def _mapping(data: object) -> Mapping[Any, Any] | None:
    return cast("Mapping[Any, Any]", data) if isinstance(data, dict) else None


def _values(space: str, data: Mapping[Any, Any]) -> Iterable[tuple[tuple[str, str], Value]]:
    for key, below in data.items():
        name = str(key).strip("/")
        if key == KEYWORD:
            parameters = _mapping(below or {})
            if parameters is None:
                raise ValueError(f"below '{KEYWORD}' of {space or 'no node'} stand no 'name: value' lines")
            yield from (((space, each), value) for each, value in _flat("", parameters))
        elif str(key).startswith("ros_parameters"):
            raise ValueError(f"'{key}' should be '{KEYWORD}', with two underscores")
        elif (inside := _mapping(below)) is not None:
            yield from _values(f"{space}/{name}", inside)


def _flat(prefix: str, data: Mapping[Any, Any]) -> Iterable[tuple[str, Value]]:
    for key, value in data.items():
        name = f"{prefix}{key}"
        if (inside := _mapping(value)) is not None:
            yield from _flat(name + ".", inside)
        else:
            yield name, tuple(cast("list[Any]", value)) if isinstance(value, list) else value


def differences(profile: Profile, trees: Mapping[str, ParameterTree]) -> Sequence[ProfileDifference]:
    """What a profile would change in the running system, with the refusals that the descriptors foretell.

    Nodes of the profile that do not run are left out; a node that runs but lacks a parameter is a refusal.
    """
    found: list[ProfileDifference] = []
    for (node, name), then in profile.values.items():
        tree = trees.get(node)
        if tree is None:
            continue
        parameter = tree.get(name)
        now = parameter.value if parameter else None
        if parameter and now == then and type(now) is type(then):
            continue
        _, why = refusal(parameter, then)
        reset = bool(parameter and AT_RESET in parameter.description)
        found.append(ProfileDifference(node, name, now, then, why, reset))
    return found
