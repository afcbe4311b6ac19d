"""Profiles: named ROS parameter files that can be applied to the running system."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from bot_console.tui.console.model import ParameterTree, Profile, ProfileDifference
from bot_console.tui.console.parameters.patch import same
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.console.parameters.text import NOTHING, sections, value_at
from bot_console.tui.console.values import refusal

AT_RESET = "at reset"
"""A parameter whose description says so needs a reset of the world to take effect."""


def find(folders: Iterable[Path]) -> tuple[Profile, ...]:
    """The profiles of some folders, by file name; a file that cannot be read is a profile with a problem."""
    files = sorted({path.stem: path for folder in folders for path in sorted(folder.glob("*.yaml"))}.items())
    return tuple(load(path) for _, path in files)


def load(path: Path) -> Profile:
    """Read a ROS parameter file as a profile; its first comment line is the title."""
    try:
        text = path.read_text(encoding="utf-8-sig")
        values = {
            (section.key, name): value_at(name, place)
            for section in sections(text)
            for name, place in section.places.items()
        }
    except UnicodeDecodeError:
        return Profile(path.stem, str(path), problem="it is no text")
    except OSError as error:
        return Profile(path.stem, str(path), problem=f"cannot be read: {error.strerror}")
    except ValueError as error:
        return Profile(path.stem, str(path), problem=str(error))
    if not values:
        return Profile(path.stem, str(path), problem=NOTHING)
    first = next((line[1:].strip() for line in text.splitlines() if line.startswith("#")), "")
    world = values.get(("/simulator", "world"), "")
    return Profile(path.stem, str(path), first, MappingProxyType(values), str(world))


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
        if parameter and same(now, then):
            continue
        _, why = refusal(parameter, then)
        reset = bool(parameter and AT_RESET in parameter.description)
        unsafe = takes_safety(parameter, now, then) if parameter else ""
        found.append(ProfileDifference(node, name, now, then, why, reset, unsafe))
    return found
