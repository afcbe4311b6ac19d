"""Profiles as the panes see them, and what applying each would change."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from bot_console.tui.console.model.parameters import Value


@dataclass(frozen=True, slots=True)
class Profile:
    """A named parameter file: the values it sets by node and parameter, and the world it was made for."""

    name: str
    path: str
    title: str = ""
    values: Mapping[tuple[str, str], Value] = field(default_factory=lambda: MappingProxyType({}))
    world: str = ""
    problem: str = ""
    launch: str = ""
    """The launch file that replaces the running system; empty for a parameter file."""
    arguments: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    """The arguments of that launch file."""
    own: bool = False
    """Whether it is in the user's own folder, so that it may be renamed and deleted."""


@dataclass(frozen=True, slots=True)
class ProfileDifference:
    """One value that applying a profile would change.

    `refusal` says why it would be refused, and is empty when it would be accepted; `unsafe` says how it makes the robot
    less safe, and is empty when it does not.
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
