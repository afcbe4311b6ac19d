"""Fixtures of launch descriptions: tests beside the launch, tests after its shutdown, and reported failures."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

HEAD = """
import sys
import launch, launch_pytest, pytest
from launch.actions import ExecuteProcess
from launch_pytest import tools

PROGRAM = "import sys, time; print('oops', file=sys.stderr, flush=True); print('hi', flush=True); time.sleep(%s)"

def greeter(seconds):
    return ExecuteProcess(cmd=[sys.executable, '-c', PROGRAM % seconds], cached_output=True)

@pytest.fixture
def proc():
    return greeter(60)

@launch_pytest.fixture
def described(proc):
    return launch.LaunchDescription([proc, launch_pytest.actions.ReadyToTest()])

@pytest.fixture(scope='module')
def common_proc():
    return greeter(60)

@launch_pytest.fixture(scope='module')
def common(common_proc):
    return launch.LaunchDescription([common_proc]), 42
"""
BESIDE = """
@pytest.mark.launch(fixture=described)
def test_plain(proc, launch_context, launch_service, event_loop):
    assert tools.wait_for_start_sync(launch_context, proc, timeout=240)
    assert tools.wait_for_output_sync(launch_context, proc, lambda text: text.split() == ['hi'], timeout=240)
    assert not tools.wait_for_output_sync(launch_context, proc, lambda text: text == 'never', timeout=0.05)
    tools.assert_stderr_sync(launch_context, proc, lambda text: 'oops' in text, timeout=240)
    assert not tools.wait_for_exit_sync(launch_context, proc, timeout=0.05)
    assert launch_service.context is launch_context and launch_service.event_loop is event_loop

@pytest.mark.launch(fixture=described)
async def test_coroutine(proc, launch_context, event_loop):
    import asyncio
    assert asyncio.get_running_loop() is event_loop
    await tools.assert_output(launch_context, proc, lambda text: text == 'hi\\n', timeout=240)

@pytest.mark.launch(fixture=described)
@pytest.mark.parametrize('number', [1, 2])
def test_generator(proc, launch_context, number):
    assert tools.wait_for_start_sync(launch_context, proc, timeout=240)
    assert proc.return_code is None
    yield
    assert proc.return_code is not None

@pytest.mark.launch(fixture=described)
async def test_async_generator(proc, launch_context):
    await tools.wait_for_output(launch_context, proc, lambda text: text == 'hi\\n', timeout=240)
    yield
    assert proc.return_code is not None

@pytest.mark.launch(fixture=described, shutdown=True)
def test_afterwards(proc):
    assert proc.return_code is not None

def test_without_a_launch():
    pass
"""
COMMON = """
PIDS = set()

@pytest.mark.launch(fixture=common, shutdown=True)
def test_end(common_proc):
    assert common_proc.return_code is not None and len(PIDS) == 1

@pytest.mark.launch(fixture=common)
def test_one(common_proc, common, launch_context):
    tools.wait_for_start_sync(launch_context, common_proc, timeout=240)
    PIDS.add(common_proc.process_details['pid'])
    assert common[1] == 42 and common_proc.return_code is None

@pytest.mark.launch(fixture=common)
def test_two(common_proc):
    PIDS.add(common_proc.process_details['pid'])
    yield
    assert common_proc.return_code is not None
"""
BAD = """
@pytest.mark.launch(fixture=described)
def test_output(proc, launch_context):
    def check(text):
        assert text == 'something else'
    tools.wait_for_output_sync(launch_context, proc, check, timeout=0.2)

@pytest.mark.launch(fixture=described)
def test_after(proc):
    yield
    assert proc.return_code is None, 'it has ended'

@pytest.mark.launch(fixture=described)
def test_twice(proc):
    yield
    yield

@launch_pytest.fixture
def broken():
    def late(context):
        raise ValueError('no such thing')
    return launch.LaunchDescription([launch.actions.OpaqueFunction(function=late)])

@pytest.mark.launch(fixture=broken)
def test_never():
    pass
"""


UNMARKED = "@pytest.mark.launch\ndef test_it(): pass\n"
FOREIGN = "@pytest.fixture\ndef plain(): pass\n@pytest.mark.launch(fixture=plain)\ndef test_it(): pass\n"
REFUSED = """
@launch_pytest.fixture
def no_description():
    return object()

@pytest.mark.launch(fixture=no_description)
def test_no_description():
    pass

@launch_pytest.fixture
def ready_twice():
    return launch.LaunchDescription([launch_pytest.actions.ReadyToTest(), launch_pytest.actions.ReadyToTest()])

@pytest.mark.launch(fixture=ready_twice)
def test_ready_twice():
    pass

@launch_pytest.fixture
def ends_at_once():
    return launch.LaunchDescription([launch_pytest.actions.ReadyToTest()])

@pytest.mark.launch(fixture=ends_at_once, shutdown=True)
def test_two_halves_afterwards():
    yield
"""
BY_ITSELF = """
@launch_pytest.fixture(auto_shutdown=False)
def by_itself():
    ends = ExecuteProcess(cmd=[sys.executable, '-c', 'import time; time.sleep(0.3)'])
    return launch.LaunchDescription([ends, launch_pytest.actions.ReadyToTest()]), ends

@pytest.mark.launch(fixture=by_itself, shutdown=True)
def test_by_itself(by_itself):
    assert by_itself[1].return_code == 0
"""
FILES = {"beside": BESIDE, "common": COMMON, "bad": BAD, "unmarked": UNMARKED, "foreign": FOREIGN}
FILES |= {"refused": REFUSED, "itself": BY_ITSELF}


class PytestRun:
    """One run of all files: its output, and the test cases of each file with their outcomes."""

    def __init__(self, folder: Path) -> None:
        for name, text in FILES.items():
            (folder / f"test_{name}.py").write_text(HEAD + text)
        words = ["test", "-p", "no:cacheprovider", "-q", "--junitxml=report.xml", "--continue-on-collection-errors"]
        program = f"import sys; from bot_console.tui.cli.main import main; sys.exit(main({words!r}))"
        command = [sys.executable, "-c", program]
        environment = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}  # plugins needed only by our own tests
        done = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, timeout=240, check=False
        )
        self.code, self.printed = done.returncode, done.stdout
        self.cases: dict[str, list[tuple[str, list[str]]]] = {name: [] for name in FILES}
        # Not from the output: the lines of processes are mixed into it.
        for each in ElementTree.parse(folder / "report.xml").iter("testcase"):
            where = (each.attrib["classname"] or each.attrib["name"]).removeprefix("test_")
            self.cases[where].append((each.attrib["name"], [kind.tag for kind in each]))


@pytest.fixture(scope="module")
def pytest_run(tmp_path_factory: pytest.TempPathFactory) -> PytestRun:
    return PytestRun(tmp_path_factory.mktemp("launched"))


def test_functions_coroutines_and_generators_run_beside_and_after_a_launch(pytest_run: PytestRun) -> None:
    assert [kinds for _, kinds in pytest_run.cases["beside"]] == [[]] * 7, pytest_run.printed


def test_module_fixture_runs_once_and_shutdown_tests_come_last(pytest_run: PytestRun) -> None:
    order = ["test_one", "test_two", "test_end", "test_two[shutdown_test]"]
    assert pytest_run.cases["common"] == [(name, []) for name in order], pytest_run.printed


def test_failures_are_reported_with_their_own_assertion(pytest_run: PytestRun) -> None:
    assert sorted(kind for _, kinds in pytest_run.cases["bad"] for kind in kinds) == ["error", *["failure"] * 3]
    for text in (
        "something else",
        "it has ended",
        "must stop iteration after yielding once",
        "before it was ready: no such thing",
    ):
        assert text in pytest_run.printed


def test_mark_requires_a_fixture(pytest_run: PytestRun) -> None:
    assert pytest_run.code == 1
    assert "pytest.mark.launch takes fixture=" in pytest_run.printed
    assert pytest_run.cases["unmarked"] == [("test_it", ["skipped"])]
    assert '"fixture" keyword argument is required in a pytest.mark.launch() decorator' in pytest_run.printed


def test_invalid_fixtures_are_rejected(pytest_run: PytestRun) -> None:
    cases = dict(pytest_run.cases["refused"])
    assert cases["test_no_description"] == cases["test_ready_twice"] == ["error"]
    assert "fixture 'no_description': return value must be either a launch description" in pytest_run.printed
    assert "containing only one ReadyToTest action" in pytest_run.printed
    assert cases["test_two_halves_afterwards"] == ["failure"]
    assert "launch test items cannot be marked with shutdown=True" in pytest_run.printed


def test_launch_may_end_by_itself(pytest_run: PytestRun) -> None:
    assert pytest_run.cases["itself"] == [("test_by_itself", [])], pytest_run.printed
