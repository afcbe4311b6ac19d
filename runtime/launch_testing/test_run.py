"""One test description with its test cases, and how they are run."""

from __future__ import annotations

import functools
import inspect
import threading
import unittest
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, cast

from launch.actions import IncludeLaunchDescription, RegisterEventHandler
from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart
from launch_testing.actions import ReadyToTest
from launch_testing.decorators import PARAMETERS, POST_SHUTDOWN, READY_TIMEOUT
from launch_testing.io_handler import ActiveIoHandler
from launch_testing.markers import KEEP_ALIVE
from launch_testing.proc_info_handler import ActiveProcInfoHandler

from launch import LaunchDescription, LaunchDescriptionSource, LaunchService

if TYPE_CHECKING:
    from types import ModuleType

START_TIMEOUT_S = 15.0
"""Time (s) within which the processes under test must be ready, as upstream."""
DESCRIPTION = "generate_test_description"


class TestRun:
    """Starts a launch description, runs its tests beside it, ends it, and runs the post-shutdown tests."""

    __test__ = False

    def __init__(self, module: ModuleType, description: Any, parameters: Mapping[str, Any]) -> None:
        self.parameters = dict(parameters)
        self._module = module
        self._description = description
        self.name = f"[{', '.join(map(str, parameters.values()))}]" if parameters else ""

    def describe(self) -> tuple[LaunchDescription, list[ReadyToTest], dict[str, Any]]:
        """Return the launch description, its marks and the arguments for its tests; raises `Exception` without a
        mark.
        """
        made = self._description()
        description, context = made if isinstance(made, tuple) else (made, {})
        marks = [each for each in entities_of(description) if isinstance(each, ReadyToTest)]
        if not marks:
            raise Exception(f"{DESCRIPTION} functions must return a LaunchDescription containing a ReadyToTest action")
        return description, marks, context

    def run(self, arguments: Mapping[str, str], result: unittest.TestResult) -> None:
        """Run all tests and record them in `result`; a launch that ends before the tests counts as an error."""
        try:
            description, marks, context = self.describe()
        except unittest.SkipTest as skipped:
            result.addSkip(self._whole(), str(skipped))
            return
        ready = threading.Event()
        for mark in marks:
            mark._add_callback(ready.set)
        proc_info, proc_output = ActiveProcInfoHandler(), ActiveIoHandler()
        service = LaunchService(argv=[f"{name}:={value}" for name, value in arguments.items()], noninteractive=True)
        known = {**context, **self.parameters, "proc_info": proc_info, "proc_output": proc_output}
        known |= {"test_args": dict(arguments)}
        before, after = self._suite(False, {**known, "launch_service": service}), self._suite(True, known)
        included = IncludeLaunchDescription(LaunchDescriptionSource(description), launch_arguments=arguments.items())
        service.include_launch_description(LaunchDescription([*_recording_handlers(proc_info, proc_output), included]))
        tester = threading.Thread(target=self._run_beside, args=(ready, before, result, service), daemon=True)
        tester.start()
        service.run(shutdown_when_idle=not getattr(self._description, KEEP_ALIVE, False))
        tester.join(timeout=1.0)
        if tester.is_alive():
            result.addError(self._whole(), _exc_info("Processes under test stopped before tests completed"))
            _print_output_of_failed(proc_info, proc_output)
            return
        setattr(result, "_previousTestClass", None)  # noqa: B010 -- else unittest tears its last class down a second time
        after.run(result)

    def _suite(self, afterwards: bool, known: Mapping[str, Any]) -> unittest.TestSuite:
        """Return the test cases to run beside the launch, or `afterwards`, with the arguments their methods name."""
        suite = unittest.TestSuite()
        named = (getattr(self._module, name) for name in dir(self._module))  # by name, like unittest
        for case in (each for each in named if isinstance(each, type) and issubclass(each, unittest.TestCase)):
            if bool(getattr(case, POST_SHUTDOWN, False)) == afterwards:
                suite.addTests(self._tests_of(case, known))
        return suite

    def _tests_of(self, case: type[unittest.TestCase], known: Mapping[str, Any]) -> Iterator[unittest.TestCase]:
        """Yield the tests of a class, from a subclass for this run: others must not see the attributes set on it."""
        own = type(case.__name__, (case,), {"__module__": case.__module__, "__qualname__": case.__qualname__})
        for name in ("proc_info", "proc_output", "launch_service", "test_args"):
            if name in known:
                setattr(own, name, known[name])
        for name in ("setUpClass", "tearDownClass"):
            setattr(own, name, _bind_known(getattr(own, name), known))
        for test in cast("Iterable[unittest.TestCase]", unittest.defaultTestLoader.loadTestsFromTestCase(own)):
            for name in (test._testMethodName, "setUp", "tearDown"):
                setattr(test, name, _bind_known(getattr(test, name), known))
            if self.name:
                method = getattr(test, test._testMethodName)
                test._testMethodName += self.name
                setattr(test, test._testMethodName, method)
            yield test

    def _run_beside(
        self, ready: threading.Event, suite: unittest.TestSuite, result: unittest.TestResult, service: LaunchService
    ) -> None:
        try:
            if ready.wait(getattr(self._description, READY_TIMEOUT, START_TIMEOUT_S)):
                suite.run(result)
            else:
                result.addError(self._whole(), _exc_info("Timed out waiting for processes to start up"))
        finally:
            service.shutdown()

    def _whole(self) -> unittest.TestCase:
        return _RunPlaceholder(f"{self._module.__name__}{self.name}")


class _RunPlaceholder(unittest.TestCase):
    """Stands for a whole run in a result."""

    def __init__(self, name: str) -> None:
        super().__init__("runTest")
        self._name = name

    def runTest(self) -> None:
        """Do nothing."""

    def __str__(self) -> str:
        return self._name

    def id(self) -> str:
        """Return the name of the run."""
        return self._name


def _exc_info(text: str) -> Any:
    error = RuntimeError(text)
    return RuntimeError, error, error.__traceback__


def _print_output_of_failed(proc_info: ActiveProcInfoHandler, proc_output: ActiveIoHandler) -> None:
    """Print output that may explain why processes ended too early."""
    for event in (each for each in proc_info if getattr(each, "returncode", 0)):
        print(f"Process '{event.process_name}' exited with {event.returncode}")
        print(f"##### '{event.process_name}' output #####")
        for piece in proc_output[event.process_name]:
            print(piece.text.decode(errors="replace"))
        print("#" * (len(event.process_name) + 21))


def _recording_handlers(proc_info: ActiveProcInfoHandler, proc_output: ActiveIoHandler) -> list[RegisterEventHandler]:
    heard = (
        OnProcessStart(on_start=lambda event, _: proc_output.track(event.process_name)),
        OnProcessStart(on_start=lambda event, _: proc_info.append(event)),
        OnProcessExit(on_exit=lambda event, _: proc_info.append(event)),
        OnProcessIO(on_stdout=proc_output.append, on_stderr=proc_output.append),
    )
    return [RegisterEventHandler(each) for each in heard]


def entities_of(entity: Any) -> list[Any]:
    """Return an entity and all entities below it."""
    below = list(entity.entities) if isinstance(entity, LaunchDescription) else list(entity.describe_sub_entities())
    if not isinstance(entity, LaunchDescription):
        below += [each for _, some in entity.describe_conditional_sub_entities() for each in some]
    return [entity, *(found for each in below for found in entities_of(each))]


def _bind_known(method: Any, known: Mapping[str, Any]) -> Any:
    """Return those arguments of a method that are known by name."""
    wanted = [each for each in inspect.signature(method).parameters if each in known]
    return functools.partial(method, **{each: known[each] for each in wanted}) if wanted else method


def test_runs(module: ModuleType) -> list[TestRun]:
    """Return the runs that a test module describes; none if it has no `generate_test_description`."""
    description = getattr(module, DESCRIPTION, None)
    if description is None:
        return []
    rows = getattr(description, PARAMETERS, lambda: [(description, {})])()
    return [TestRun(module, made, row) for made, row in rows]


test_runs.__test__ = False  # type: ignore[attr-defined] -- it is no test itself
