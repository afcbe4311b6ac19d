"""A pytest plugin: a function marked `launch(fixture=...)` runs during the launch of its fixture, or after it.

`shutdown=True` means after it. A generator runs up to its `yield` during the launch and continues after it; if other
tests use the fixture, too, the part after the `yield` is a separate test that comes last.
"""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any

import pytest
from launch_pytest.fixture import RUNNING, options_of

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_service import LaunchService

_AFTER = pytest.StashKey[bool]()
_FIRST = pytest.StashKey[Any]()
_STARTED = pytest.StashKey[Any]()
_SUFFIX = "[shutdown_test]"
NO_FIXTURE = '"fixture" keyword argument is required in a pytest.mark.launch() decorator'
AFTER_ALONE = "generator or async generator based launch test items cannot be marked with shutdown=True"


class LaunchTestWarning(pytest.PytestWarning):
    """A mark lacks a required argument."""


def _is_generator(function: object) -> bool:
    return inspect.isgeneratorfunction(function) or inspect.isasyncgenfunction(function)


def _running(item: pytest.Item) -> Any:
    mark = item.get_closest_marker("launch")
    return RUNNING.get(options_of(mark.kwargs.get("fixture"))[0]) if mark else None


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(collector: Any, name: str, obj: Any) -> Any:
    """Collect functions with the mark, including coroutines and generators."""
    own = [each for each in getattr(obj, "pytestmark", []) if each.name == "launch"]
    marks = [*own, *collector.iter_markers("launch")]
    if not marks or not inspect.isfunction(obj) or not collector.istestfunction(obj, name):
        return None
    if marks[0].kwargs.get("fixture") is None:
        return _skipped(list(collector._genfunctions(name, obj)))
    fixture, scope = options_of(marks[0].kwargs["fixture"])
    shutdown = bool(marks[0].kwargs.get("shutdown"))
    pytest.mark.usefixtures(fixture)(obj)
    items = list(collector._genfunctions(name, obj))
    for item in items:
        item.stash[_AFTER] = shutdown
    return [*items, *_second_halves(collector, name, obj, items)] if scope != "function" else items


def _skipped(items: list[pytest.Item]) -> list[pytest.Item]:
    for item in items:
        item.warn(LaunchTestWarning(NO_FIXTURE))
        item.add_marker(pytest.mark.skip(NO_FIXTURE))
    return items


def _second_halves(collector: Any, name: str, obj: Any, items: list[pytest.Item]) -> list[pytest.Item]:
    if not _is_generator(obj):
        return []
    halves = list(collector._genfunctions(name, obj))
    for half, item in zip(halves, items, strict=True):
        half.name, half._nodeid = half.name + _SUFFIX, half._nodeid + _SUFFIX
        half.stash[_AFTER], half.stash[_FIRST] = True, item
        item.stash[_STARTED] = None
    return halves


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Move tests that run after the shutdown to the end of their class or module."""
    places: dict[Any, int] = {}
    for item in items:
        places.setdefault(item.parent, len(places))
    if any(item.stash.get(_AFTER, False) for item in items):
        items.sort(key=lambda item: (places[item.parent], item.stash.get(_AFTER, False)))


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: Any) -> bool | None:
    """Run a marked test; leave all others to pytest."""
    running = _running(pyfuncitem)
    if running is None:
        return None
    first = pyfuncitem.stash.get(_FIRST, None)
    if pyfuncitem.stash.get(_AFTER, False):
        if first is None and _is_generator(pyfuncitem.obj):
            pytest.fail(AFTER_ALONE, pytrace=False)
        running.shutdown()
    if first is not None:
        _finish(running, first.stash.get(_STARTED, None))
        return True
    names = pyfuncitem._fixtureinfo.argnames
    made = pyfuncitem.obj(**{name: pyfuncitem.funcargs[name] for name in names})
    if inspect.iscoroutine(made):
        running.run(made)
    elif _is_generator(pyfuncitem.obj):
        _step(running, made)
        if _STARTED in pyfuncitem.stash:
            pyfuncitem.stash[_STARTED] = made
        else:
            running.shutdown()
            _finish(running, made)
    return True


def _step(running: Any, generator: Any) -> None:
    """Run a generator up to its next `yield`; raises `StopIteration` or `StopAsyncIteration` if there is none left."""
    if inspect.isgenerator(generator):
        next(generator)
    else:
        running.run(_next(generator))


async def _next(generator: Any) -> None:
    await anext(generator)


def _finish(running: object, generator: object) -> None:
    if generator is None:
        pytest.skip("the part before the shutdown has failed")
    try:
        _step(running, generator)
    except (StopIteration, StopAsyncIteration):
        return
    kind = "a generator" if inspect.isgenerator(generator) else "an async generator"
    pytest.fail(f"launch tests using {kind} function must stop iteration after yielding once", pytrace=False)


def _part(request: pytest.FixtureRequest) -> Any:
    found = _running(request.node)
    if found is None:
        raise RuntimeError("this fixture is for tests that are marked launch(fixture=...)")
    return found


@pytest.fixture
def launch_service(request: pytest.FixtureRequest) -> LaunchService:
    """Return the launch service of the running launch."""
    return _part(request).service


@pytest.fixture
def launch_context(launch_service: LaunchService) -> LaunchContext:
    """Return the context of the running launch."""
    return launch_service.context


@pytest.fixture
def event_loop(request: pytest.FixtureRequest) -> Any:
    """Return the event loop of the running launch."""
    return _part(request).loop


def pytest_configure(config: pytest.Config) -> None:
    """Register the marker."""
    config.addinivalue_line("markers", "launch(fixture, shutdown=False): run beside a launch description, or after it")
