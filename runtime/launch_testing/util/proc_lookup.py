"""Selects processes: by their action, or by a part of their command's name and arguments."""

from __future__ import annotations

from typing import Any

from launch.actions import ExecuteLocal
from launch.substitutions import TextSubstitution

NO_CMD_ARGS = object()
"""Stands for a command without arguments."""


class NoMatchingProcessException(Exception):
    """No known process matches."""


def resolveProcesses(
    info_obj: Any, *, process: Any = None, cmd_args: Any = None, strict_proc_matching: bool = True
) -> list[Any]:
    """Return the matching actions that a handler knows; None matches all.

    Raises `NoMatchingProcessException` for none, `Exception` for several if one is required, `TypeError` for anything
    but an action or a text.
    """
    known = list(info_obj.processes())
    if process is None:
        if not known:
            raise NoMatchingProcessException("No data recorded for any process")
        return known
    if isinstance(process, ExecuteLocal):
        if process not in known:
            raise NoMatchingProcessException(f"No data recorded for proc {describe_process(process)}")
        return [process]
    if not isinstance(process, str):
        raise TypeError(f"proc argument must be 'ExecuteProcess' or 'str' not {type(process)}")
    if isinstance(cmd_args, str):
        cmd_args = [cmd_args]
    found = [each for each in known if process in name_of(each) and _has(each, cmd_args)]
    names = ", ".join(sorted(map(describe_process, known)))
    if not found:
        raise NoMatchingProcessException(
            f"Did not find any processes matching name '{process}' and args '{cmd_args}'. Procs: {names}"
        )
    if strict_proc_matching and len(found) > 1:
        raise Exception(  # upstream's class, which code that waits for a missing process does not catch
            f"Found multiple processes matching name '{process}' and cmd_args '{cmd_args}'. Procs: {names}"
        )
    return found


def name_of(action: Any) -> str:
    """Return the name that launch gave a process; empty before it was prepared."""
    details = action.process_details
    return str(details["name"]) if details else ""


def describe_process(action: Any) -> str:
    """Return the name and arguments of a process; before its launch, the command if it is plain text."""
    details = action.process_details
    if details:
        return " ".join([details["name"], *details["cmd"][1:]])
    words = action.process_description.cmd
    if not all(isinstance(part, TextSubstitution) for word in words for part in word):
        return "Unknown - Process not launched yet"
    return " ".join("".join(part.text for part in word) for word in words)


def _has(action: Any, cmd_args: Any) -> bool:
    if cmd_args is None:
        return True
    given = action.process_details["cmd"][1:]
    return not given if cmd_args is NO_CMD_ARGS else all(each in given for each in cmd_args)
