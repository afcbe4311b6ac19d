"""One test description with its test cases, and how they run."""

from __future__ import annotations

import functools
import inspect
import threading
import unittest
from collections.abc import Mapping
from typing import Any

from launch.actions import RegisterEventHandler
from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart
from launch_testing.actions import ReadyToTest
from launch_testing.decorators import PARAMETERS, POST_SHUTDOWN
from launch_testing.io_handler import ActiveIoHandler
from launch_testing.markers import KEEP_ALIVE
from launch_testing.proc_info_handler import ActiveProcInfoHandler

from launch import LaunchDescription, LaunchService

START_LIMIT = 15.0
"""Seconds within which what is tested has to be ready, as upstream."""
DESCRIPTION = "generate_test_description"


class TestRun:
    """Starts what a description describes, runs the tests beside it, ends it, and runs the tests for afterwards."""

    __test__ = False

    def __init__(self, module: Any, description: Any, parameters: Mapping[str, Any]) -> None:
        self.parameters = dict(parameters)
        self._module = module
        self._description = description
        self.name = ", ".join(f"{name}={value!r}" for name, value in parameters.items())

    def run(self, arguments: Mapping[str, str], result: unittest.TestResult) -> None:
        """Run all tests into a result; a launch that ends before the tests counts as an error."""
        ready = threading.Event()
        description, context = self._describe(ready.set)
        proc_info, proc_output = ActiveProcInfoHandler(), ActiveIoHandler()
        service = LaunchService(argv=[f"{name}:={value}" for name, value in arguments.items()], noninteractive=True)
        service.context.launch_configurations.update(arguments)
        known = {**context, **self.parameters, "proc_info": proc_info, "proc_output": proc_output}
        known |= {"launch_service": service, "test_args": dict(arguments)}
        before, after = self._suites(known)
        service.include_launch_description(LaunchDescription([*_watched(proc_info, proc_output), description]))
        tester = threading.Thread(target=self._run_beside, args=(ready, before, result, service), daemon=True)
        tester.start()
        service.run(shutdown_when_idle=not getattr(self._description, KEEP_ALIVE, False))
        tester.join(timeout=1.0)
        if tester.is_alive():
            result.addError(
                _Named(f"{self._module.__name__} {self.name}"),
                _raised("Processes under test stopped before tests completed"),
            )
            return
        setattr(result, "_previousTestClass", None)  # noqa: B010 -- else unittest tears its last class down a second time
        after.run(result)

    def _describe(self, ready: Any) -> tuple[LaunchDescription, dict[str, Any]]:
        wants_ready = "ready_fn" in inspect.signature(self._description).parameters
        made = self._description(ready_fn=ready) if wants_ready else self._description()
        description, context = made if isinstance(made, tuple) else (made, {})
        marks = [each for each in entities_of(description) if isinstance(each, ReadyToTest)]
        for mark in marks:
            mark._add_callback(ready)
        if not marks and not wants_ready:
            if not getattr(self._description, KEEP_ALIVE, False):
                raise RuntimeError(f"{DESCRIPTION} without an argument ready_fn has to contain an action ReadyToTest")
            ready()
        return description, context

    def _suites(self, known: Mapping[str, Any]) -> tuple[unittest.TestSuite, unittest.TestSuite]:
        """The test cases for beside and for afterwards, with what their methods ask for by name."""
        suites = unittest.TestSuite(), unittest.TestSuite()
        classes = [each for each in vars(self._module).values() if isinstance(each, type)]
        for case in (each for each in classes if issubclass(each, unittest.TestCase)):
            suite = suites[bool(getattr(case, POST_SHUTDOWN, False))]
            for test in unittest.defaultTestLoader.loadTestsFromTestCase(case):
                _bind(test, known)
                suite.addTest(test)
        return suites

    def _run_beside(
        self, ready: threading.Event, suite: unittest.TestSuite, result: unittest.TestResult, service: LaunchService
    ) -> None:
        try:
            if ready.wait(START_LIMIT):
                suite.run(result)
            else:
                result.addError(_Named(self._module.__name__), _raised("Timed out waiting for processes to start up"))
        finally:
            service.shutdown()


class _Named(unittest.TestCase):
    """Stands for a whole run in a result."""

    def __init__(self, name: str) -> None:
        super().__init__("runTest")
        self._name = name

    def runTest(self) -> None:
        """Nothing."""

    def __str__(self) -> str:
        return self._name

    def id(self) -> str:
        """Its name."""
        return self._name


def _raised(text: str) -> Any:
    error = RuntimeError(text)
    return RuntimeError, error, error.__traceback__


def _watched(proc_info: ActiveProcInfoHandler, proc_output: ActiveIoHandler) -> list[RegisterEventHandler]:
    heard = (
        OnProcessStart(on_start=lambda event, _: proc_info.append(event)),
        OnProcessExit(on_exit=lambda event, _: proc_info.append(event)),
        OnProcessIO(on_stdout=proc_output.append, on_stderr=proc_output.append),
    )
    return [RegisterEventHandler(each) for each in heard]


def entities_of(entity: Any) -> list[Any]:
    """An entity and all below it."""
    below = list(entity.entities) if isinstance(entity, LaunchDescription) else list(entity.describe_sub_entities())
    if not isinstance(entity, LaunchDescription):
        below += [each for _, some in entity.describe_conditional_sub_entities() for each in some]
    return [entity, *(found for each in below for found in entities_of(each))]


def _bind(test: Any, known: Mapping[str, Any]) -> None:
    """Give a test, its `setUp` and its class what they name as arguments; also as attributes, as upstream."""
    for name in ("proc_info", "proc_output", "launch_service", "test_args"):
        setattr(test, name, known[name])
    for name in (test._testMethodName, "setUp", "tearDown"):
        method = getattr(test, name)
        wanted = [each for each in inspect.signature(method).parameters if each in known]
        if wanted:
            setattr(test, name, functools.partial(method, **{each: known[each] for each in wanted}))


def test_runs(module: Any) -> list[TestRun]:
    """The runs that a test module describes; none where it has no `generate_test_description`."""
    description = getattr(module, DESCRIPTION, None)
    if description is None:
        return []
    rows = getattr(description, PARAMETERS, lambda: [(description, {})])()
    return [TestRun(module, made, row) for made, row in rows]


test_runs.__test__ = False  # type: ignore[attr-defined] -- it is no test itself
