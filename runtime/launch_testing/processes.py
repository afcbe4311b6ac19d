"""Which process a test means: by its name or a part of it, by its action, and by its command line."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any


class NoMatchingProcessException(Exception):
    """No process is the one that is meant, or several are."""


def resolve(known: Iterable[Any], process: Any = None, cmd_args: Any = None, strict: bool = True) -> list[Any]:
    """The actions that are meant; all for None. Raises `NoMatchingProcessException`."""
    actions = list(dict.fromkeys(known))
    if process is None and cmd_args is None:
        return actions
    found = [each for each in actions if _is(each, process) and _has(each, cmd_args)]
    if not found:
        raise NoMatchingProcessException(
            f"Did not find any process matching {process!r} {cmd_args!r}: {_names(actions)}"
        )
    if strict and len(found) > 1:
        raise NoMatchingProcessException(f"Found multiple processes matching {process!r}: {_names(found)}")
    return found


def name_of(action: Any) -> str:
    """The name of a process, as launch gives it."""
    details = action.process_details
    return str(details["name"]) if details else ""


def _is(action: Any, process: Any) -> bool:
    return process is None or action is process or (isinstance(process, str) and process in name_of(action))


def _has(action: Any, cmd_args: Any) -> bool:
    if cmd_args is None:
        return True
    command = action.process_details["cmd"] if action.process_details else []
    return bool(cmd_args(command)) if callable(cmd_args) else any(str(cmd_args) in str(each) for each in command)


def _names(actions: Iterable[Any]) -> str:
    return ", ".join(map(name_of, actions)) or "no process has started"
