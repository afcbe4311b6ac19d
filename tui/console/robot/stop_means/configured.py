"""Reads the means of stopping from the settings. Standard library only."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

LOCK, SET_BOOL, TRIGGER, DEACTIVATE, SWITCH = KINDS = ("lock", "set_bool", "trigger", "deactivate", "switch")
"""The kinds of means: a Bool topic, a SetBool or Trigger service, a lifecycle node, a controller manager."""
OPTIONS: Mapping[str, tuple[str, ...]] = {
    LOCK: ("hold", "state"),
    SET_BOOL: ("hold",),
    TRIGGER: ("release",),
    DEACTIVATE: (),
    SWITCH: ("controllers",),
}
MAX_MEANS = 20
MAX_NAME = 200
"""Maximum length of a name, in characters."""
NAME = re.compile(r"/?[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*")


@dataclass(frozen=True)
class ConfiguredMeans:
    """One means of stopping a robot: its kind, and the full name of its topic, service or node."""

    kind: str
    target: str
    hold: bool = True
    """The value of a lock topic or SetBool that holds the robot; the opposite releases it."""
    release: str = ""
    """The Trigger service that undoes a Trigger; empty if it has to be undone at the robot."""
    state: str = ""
    """The Bool topic on which the robot reports that a lock topic holds it; empty if nothing acknowledges it."""
    controllers: tuple[str, ...] = ()
    """The controllers to deactivate, and to activate again on release."""

    @property
    def name(self) -> str:
        """The name shown to users."""
        return f"{self.kind} {self.target}"


def configured_means(data: object) -> tuple[tuple[ConfiguredMeans, ...], list[str]]:
    """Parse the means listed in a settings file; also returns what is wrong with entries that are left out."""
    if data is None:
        return (), []
    if not isinstance(data, Sequence) or isinstance(data, (str, bytes)):
        return (), ["a list with entries such as `- lock: /e_stop`"]
    found: list[ConfiguredMeans] = []
    wrong: list[str] = []
    entries = list(cast("Sequence[Any]", data))
    for number, entry in enumerate(entries[:MAX_MEANS], 1):
        try:
            found.append(_means(entry))
        except ValueError as error:
            wrong.append(f"entry {number}: {error}")
    if len(entries) > MAX_MEANS:
        wrong.append(f"more than {MAX_MEANS} entries; the rest is ignored")
    return tuple(found), wrong


def _means(entry: object) -> ConfiguredMeans:
    given = dict(cast("Mapping[Any, Any]", entry)) if isinstance(entry, Mapping) else {}
    kinds = [each for each in KINDS if each in given]
    if len(kinds) != 1:
        raise ValueError(f"names exactly one of {', '.join(KINDS)}, such as `lock: /e_stop`")
    kind = kinds[0]
    target = _name(kind, given.pop(kind))
    strange = [str(each)[:40] for each in given if each not in OPTIONS[kind]]
    if strange:
        allowed = f"only {', '.join(OPTIONS[kind])}" if OPTIONS[kind] else "nothing else"
        raise ValueError(f"{kind} takes {allowed}, not '{strange[0]}'")
    hold = given.get("hold", True)
    if not isinstance(hold, bool):
        raise ValueError("hold is true or false: the value that holds the robot")
    names = {each: _name(each, given[each]) for each in ("release", "state") if each in given}
    controllers = given.get("controllers", ())
    if kind == SWITCH and not (_is_texts(controllers) and controllers):
        raise ValueError("controllers lists the controllers to deactivate, such as [diff_drive_controller]")
    return ConfiguredMeans(
        kind, target, hold, names.get("release", ""), names.get("state", ""), tuple(controllers) if controllers else ()
    )


def _is_texts(value: object) -> bool:
    if not isinstance(value, Sequence) or isinstance(value, (str, bytes)):
        return False
    return all(isinstance(each, str) and 0 < len(each) <= MAX_NAME for each in cast("Sequence[Any]", value))


def _name(key: str, value: object) -> str:
    if isinstance(value, str) and len(value) <= MAX_NAME and NAME.fullmatch(value):
        return f"/{value.lstrip('/')}"
    raise ValueError(f"{key}: '{str(value)[:40]}' is not a valid ROS name, such as /base/stop")
