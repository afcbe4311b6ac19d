"""Generates the classes that contain the parts of services and actions, and the modules that export all classes."""

from __future__ import annotations

from bot_console.runtime.rosidl.definition import Interface

SERVICE_PARTS = ("Request", "Response", "Event")
SERVICE_HEAD = '''\
"""Service {package}/srv/{name}; generated, do not edit."""
# ruff: noqa
# pyright: reportPrivateUsage=false
from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bot_console.runtime.rosidl.message import ServiceType as _ServiceType

if TYPE_CHECKING:
'''
SERVICE_TAIL = """\

def __getattr__(name: str) -> Any:
    if name not in _PARTS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}__parts"), name)
"""


def service_module(interface: Interface, parts_module: str) -> str:
    """Return the module of a service's class; request, response and event are imported on first use."""
    name = interface.name
    parts = [f"{name}_{each}" for each in SERVICE_PARTS]
    lines = [SERVICE_HEAD.format(package=interface.package, name=name).rstrip()]
    lines += [f"    from .{parts_module} import {each} as {each}" for each in parts]
    lines += ["", f"_PARTS = {parts!r}", "", "", f"class {name}(metaclass=_ServiceType):"]
    lines += [
        f'    """Service class \'{name}\'."""',
        "",
        f"    _later = {SERVICE_PARTS!r}",
        "",
        "    if TYPE_CHECKING:",
    ]
    lines += [f"        {each} = {name}_{each}" for each in SERVICE_PARTS]
    return "\n".join(lines) + "\n\n" + SERVICE_TAIL


def service(name: str) -> list[str]:
    """Return the class of a service of an action."""
    return [
        "",
        f"class {name}(metaclass=_ServiceType):",
        f'    """Service class \'{name}\'."""',
        "",
        *(f"    {each} = {name}_{each}" for each in SERVICE_PARTS),
        "",
    ]


def action(name: str) -> list[str]:
    """Return the class of an action."""
    return [
        "",
        f"class {name}(metaclass=_ServiceType):",
        f'    """Action class \'{name}\'."""',
        "",
        f"    Goal = {name}_Goal",
        f"    Result = {name}_Result",
        f"    Feedback = {name}_Feedback",
        "",
        "    class Impl:",
        '        """The services and messages that an action is made of."""',
        "",
        "        from action_msgs.msg._goal_status_array import GoalStatusArray as GoalStatusMessage",
        "        from action_msgs.srv._cancel_goal import CancelGoal as CancelGoalService",
        "",
        f"        SendGoalService = {name}_SendGoal",
        f"        GetResultService = {name}_GetResult",
        f"        FeedbackMessage = {name}_FeedbackMessage",
        "",
    ]


def package_module(classes: dict[str, str]) -> str:
    """Return the `__init__` of a `msg`, `srv` or `action` folder: classes by name, each imported on first use."""
    lines = ["from typing import TYPE_CHECKING", "", "if TYPE_CHECKING:"]
    rows = sorted(classes.items())
    lines += [f"    from .{file} import {name} as {name}" for name, file in rows] or ["    pass"]
    lines += ["", f"_FILES = {dict(rows)!r}", f"__all__ = {[name for name, _ in rows]!r}", "", LAZY]
    return "\n".join(lines)


LAZY = """\
def __getattr__(name: str):
    if name not in _FILES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value = globals()[name] = getattr(import_module(f"{__name__}.{_FILES[name]}"), name)
    return value


def __dir__():
    return sorted({*globals(), *_FILES})
"""
