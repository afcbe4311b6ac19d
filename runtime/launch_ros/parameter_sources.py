"""Which part of a launch file sets each parameter of a node: a launch argument, or a line of the file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

from launch.child import News, report_news
from launch.substitutions import LaunchConfiguration
from launch.utilities import perform_substitutions
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


def report_given(context: LaunchContext, node: str, parameters: Sequence[Any], origin: str) -> None:
    """Report the parameters that a launch file gives a node; files report theirs. `origin` is the action's line."""
    given = {
        name: source
        for entry in parameters
        if not isinstance(entry, ParameterFile)
        for name, source in _sources(context, entry, origin)
    }
    if given:
        report_news(News(0, "launch", "given", {"node": node, "parameters": given}))


def _sources(context: LaunchContext, entry: Any, origin: str) -> Iterator[tuple[str, str]]:
    pairs = [(entry.name, entry.value)] if isinstance(entry, Parameter) else dict(entry).items()
    for name, value in pairs:
        text = name if isinstance(name, str) else perform_substitutions(context, name)
        names = list(dict.fromkeys(_arguments(context, value)))
        words = "s" if len(names) > 1 else ""
        yield text, f"launch argument{words} {', '.join(names)}" if names else f"launch file {origin}".rstrip()


def _arguments(context: LaunchContext, value: object) -> Iterator[str]:
    """Yield the launch configurations of which a value is composed, at any depth."""
    if isinstance(value, LaunchConfiguration):
        yield perform_substitutions(context, value.variable_name)
    elif isinstance(value, ParameterValue):
        yield from _arguments(context, value.value)
    elif isinstance(value, Mapping):
        for each in cast("Mapping[Any, Any]", value).values():
            yield from _arguments(context, each)
    elif isinstance(value, (list, tuple)):
        for each in cast("Sequence[Any]", value):
            yield from _arguments(context, each)
