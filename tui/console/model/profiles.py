"""Profiles as the panes see them, and the changes that applying them would make."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from bot_console.tui.console.model.parameters import Value


@dataclass(frozen=True, slots=True)
class Profile:
    """A named parameter file: the values that it sets by node and parameter, and the world for which it was made."""

    name: str
    path: str
    title: str = ""
    values: Mapping[tuple[str, str], Value] = field(default_factory=lambda: MappingProxyType({}))
    world: str = ""
    problem: str = ""
    launch: str = ""
    """The launch file that replaces the running system; empty if the profile is a parameter file."""
    arguments: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    """The arguments of the launch file."""
    own: bool = False
    """Whether it is in the user's own folder, so that it may be renamed and deleted."""


@dataclass(frozen=True, slots=True)
class ProfileDifference:
    """A value that applying a profile would change.

    `refusal` says why the node would refuse it, `unsafe` how it would make the robot less safe; they are empty where
    that is not so.
    """

    node: str
    name: str
    now: Value
    then: Value
    refusal: str = ""
    needs_reset: bool = False
    unsafe: str = ""
    unknown: bool = False
    """Whether the node has no such parameter, so that the value is left out."""
