"""The arguments that a launch file declares, as data for a form."""

from __future__ import annotations

from typing import Any

from bot_console.tui.console.launch.fault import fault_text
from bot_console.tui.console.model import LaunchArgument


def read_arguments(path: str) -> list[LaunchArgument]:
    """The arguments declared by a launch file and its includes; raises `ValueError` if one of them cannot be read."""
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    from launch import LaunchContext

    try:
        context = LaunchContext()
        declared = AnyLaunchDescriptionSource(path).get_launch_description(context).get_launch_arguments()
    except (Exception, SystemExit) as error:  # a launch file is a program: whatever it raises is shown to the user
        raise ValueError(fault_text(error, path, reading=True)) from error
    return [_argument(each, context) for each in declared]


def _argument(action: Any, context: Any) -> LaunchArgument:
    choices = tuple(action.choices or ())
    default = _default(action, context)
    return LaunchArgument(action.name, _description(action.description or "", choices), default, choices)


def _default(action: Any, context: Any) -> str | None:
    """The default as text; if only a running launch can evaluate it, a description of it, as from `--show-args`."""
    from launch.utilities import perform_substitutions

    if action.default_value is None:
        return None
    try:
        text = perform_substitutions(context, action.default_value)
    except Exception:  # a substitution may run any code, or look for packages, files and programs
        return " + ".join(each.describe() for each in action.default_value)
    context.launch_configurations.setdefault(action.name, text)  # later defaults may refer to this one
    return text


def _description(text: str, choices: tuple[str, ...]) -> str:
    """The description without the list of choices, since the form shows it already."""
    if text == "no description given":
        return ""
    listed = str(list(choices))
    return text.removesuffix(f" Valid choices are: {listed}").removesuffix(f"One of: {listed}") if choices else text
