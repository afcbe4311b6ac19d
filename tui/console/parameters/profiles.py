"""Profiles: named ROS parameter files that can be applied to the running system, and launch files with arguments."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import chain
from operator import itemgetter
from pathlib import Path
from types import MappingProxyType
from typing import Any, cast

import yaml
from bot_console.tui.console.model import ParameterTree, Profile, ProfileDifference, Value, same
from bot_console.tui.console.parameters.file.node_keys import is_wildcard, matches_node
from bot_console.tui.console.parameters.file.text import KEYWORD, NOTHING, sections, value_at
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.console.values import refusal
from bot_console.tui.files.folders import expanded_path
from bot_console.tui.files.store_file import read_store
from bot_console.tui.text.yaml_faults import UNREADABLE, fault_of

AT_RESET = "at reset"
"""Parameters with these words in their descriptions take effect when the world is reset."""
MAX_FILE_BYTES = 4_000_000
"""Size limit of a profile, in bytes."""


def find(folders: Iterable[Path], *, mixed: Iterable[Path] = ()) -> tuple[Profile, ...]:
    """Find the profiles in some folders, sorted by name; an unreadable file becomes a profile with a problem.

    `mixed` are folders that contain other YAML files as well, which are ignored. If several files have the same name,
    the one in the first folder keeps it, and the package or folder is added to the names of the others.
    """
    found: dict[str, Profile] = {}
    for folder, sure in (*((each, True) for each in folders), *((each, False) for each in mixed)):
        for path in sorted(each for each in folder.glob("*.y*ml") if each.suffix in (".yaml", ".yml")):
            if sure or _is_profile(path):
                profile = load(path)
                where = folder.parent.name if folder.name == "config" else folder.name
                name = profile.name if profile.name not in found else f"{profile.name} ({where})"
                found.setdefault(name, _named(profile, name))
    return tuple(profile for _, profile in sorted(found.items()))


def _named(profile: Profile, name: str) -> Profile:
    return replace(profile, name=name)


def _is_profile(path: Path) -> bool:
    try:
        return KEYWORD in read_store(path, MAX_FILE_BYTES).decode("utf-8-sig")
    except (OSError, UnicodeDecodeError):
        return False


def load(path: Path) -> Profile:
    """Read a ROS parameter file as a profile; its first comment line is the title."""
    try:
        text = read_store(path, MAX_FILE_BYTES).decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
        title = next((line[1:].strip() for line in text.splitlines() if line.startswith("#")), "")
        launch = _launch_profile(path, title, text)
        if launch is not None:
            return launch
        values = {
            (section.key, name): value_at(name, place)
            for section in sections(text)
            for name, place in section.places.items()
        }
    except UnicodeDecodeError:
        return Profile(path.stem, str(path), problem="it is not a text file")
    except OSError as error:
        return Profile(path.stem, str(path), problem=f"cannot be read: {error.strerror}")
    except ValueError as error:
        return Profile(path.stem, str(path), problem=str(error))
    if not values:
        return Profile(path.stem, str(path), problem=NOTHING)
    world = values.get(("/simulator", "world"), "")
    return Profile(path.stem, str(path), title, MappingProxyType(values), str(world))


def _launch_profile(path: Path, title: str, text: str) -> Profile | None:
    """Read a launch file with arguments (`launch: FILE`, and `arguments:`); returns None for a parameter file."""
    if not any(line.startswith("launch:") for line in text.splitlines()):
        return None
    try:
        data: Any = yaml.safe_load(text)
    except UNREADABLE as error:
        raise ValueError(f"not YAML: {fault_of(error)}") from None
    found = cast("dict[Any, Any]", data) if isinstance(data, dict) else {}
    launch: Any = found.get("launch")
    arguments: Any = found.get("arguments") or {}
    if not isinstance(launch, str) or not isinstance(arguments, dict):
        raise ValueError("a launch profile has the lines 'launch: FILE' and 'arguments:' with 'name: value' below it")
    file = path.parent / expanded_path(launch)
    given = {str(name): _argument(value) for name, value in cast("dict[Any, Any]", arguments).items()}
    problem = "" if file.is_file() else f"there is no launch file {file}"
    return Profile(path.stem, str(path), title, problem=problem, launch=str(file), arguments=MappingProxyType(given))


def _argument(value: Any) -> str:
    try:
        return str(value).lower() if isinstance(value, bool) else str(value)
    except ValueError:  # Python does not format integers of more than 4,300 digits
        raise ValueError("an argument is an integer with thousands of digits") from None


def differences(profile: Profile, trees: Mapping[str, ParameterTree]) -> Sequence[ProfileDifference]:
    """The changes that a profile would make in the running system, with the refusals that the descriptors predict.

    Keys that match no running node are left out, see `unmatched`. A parameter that a node lacks is unknown; below a
    wildcard key, the parameter is simply not meant for that node.
    """
    found: list[ProfileDifference] = []
    entries = _by_key(profile)
    for node, tree in trees.items():
        for name, (key, then) in _values_for(entries, node).items():
            parameter = tree.get(name)
            if parameter is None:
                if not is_wildcard(key):
                    why = refusal(None, then)[1]
                    found.append(ProfileDifference(node, name, None, then, why, unknown=True))
                continue
            now = parameter.value
            if same(now, then):
                continue
            _, why = refusal(parameter, then)
            reset = AT_RESET in parameter.description
            unsafe = takes_safety(parameter, now, then)
            found.append(ProfileDifference(node, name, now, then, why, reset, unsafe))
    return found


_Entry = tuple[int, str, str, Value]
"""Position in the profile, parameter, key, value."""


def _by_key(profile: Profile) -> dict[str, list[_Entry]]:
    """The parameters by key, so that each key, instead of each value, is compared with a node."""
    found: dict[str, list[_Entry]] = {}
    for place, ((key, name), value) in enumerate(profile.values.items()):
        found.setdefault(key, []).append((place, name, key, value))
    return found


def _values_for(entries: Mapping[str, list[_Entry]], node: str) -> dict[str, tuple[str, Value]]:
    """The values that a profile gives to a node, with the key of each; as in ROS, the later of two keys wins."""
    meant = chain.from_iterable(below for key, below in entries.items() if matches_node(key, node))
    return {name: (key, value) for _, name, key, value in sorted(meant, key=itemgetter(0))}


def cannot_apply(profile: Profile, trees: Mapping[str, ParameterTree]) -> str:
    """Why a profile cannot be applied to any node; empty if it can.

    Without this check, it would become active although no node has its values. A launch profile has no values: it is
    applied by launching it.
    """
    if profile.launch:
        return ""
    keys = {key for key, _ in profile.values}
    return "none of its nodes is running" if len(unmatched(profile, trees)) == len(keys) else ""


def unmatched(profile: Profile, trees: Mapping[str, ParameterTree]) -> tuple[str, ...]:
    """The keys of a profile that match no running node."""
    keys = dict.fromkeys(key for key, _ in profile.values)
    return tuple(key for key in keys if not any(matches_node(key, node) for node in trees))
