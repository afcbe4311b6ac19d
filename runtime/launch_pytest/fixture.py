"""`@launch_pytest.fixture`: a launch description that runs for the lifetime of a fixture."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import pytest
from launch_pytest.running import Running

from launch import LaunchDescription

RUNNING: dict[str, Any] = {}
"""The running launches, by the names of their fixtures."""
_OPTIONS = "_launch_pytest_options"


def fixture(
    decorated: Callable[..., Any] | None = None,
    *,
    shutdown_when_idle: bool = True,
    auto_shutdown: bool = True,
    **options: Any,
) -> Any:
    """Make a fixture from a function that returns a launch description, or a sequence starting with one.

    Without `auto_shutdown` the launch must end by itself, and tests after the shutdown wait for its end.
    """
    if decorated is None:
        more = {"shutdown_when_idle": shutdown_when_idle, "auto_shutdown": auto_shutdown}
        return functools.partial(fixture, **more, **options)
    name = options.get("name") or decorated.__name__

    def described(*args: Any, **kwargs: Any) -> Iterator[Any]:
        made = decorated(*args, **kwargs)
        description = made[0] if isinstance(made, Sequence) and made else made
        assert isinstance(description, LaunchDescription), (
            f"When running launch_pytest fixture '{name}': return value must be either a launch description "
            "or a sequence which first item is a launch description"
        )
        running = Running(description, shutdown_when_idle, auto_shutdown)
        RUNNING[name] = running
        try:
            yield made
        finally:
            del RUNNING[name]
            running.close()

    described.__name__, described.__doc__, described.__module__ = name, decorated.__doc__, decorated.__module__
    described.__signature__ = inspect.signature(decorated)  # type: ignore[attr-defined] -- pytest reads it
    made = pytest.fixture(**options)(described)
    setattr(made, _OPTIONS, (name, options.get("scope", "function")))
    return made


def options_of(made: object) -> tuple[str, str]:
    """Return name and scope of a fixture made by `fixture`; raises `TypeError` for anything else."""
    if not hasattr(made, _OPTIONS):
        raise TypeError("pytest.mark.launch takes fixture=..., which has to be made with @launch_pytest.fixture")
    name, scope = getattr(made, _OPTIONS)
    return name, scope
