"""Tests of launch descriptions: what passes, what fails, and how it is told."""

from __future__ import annotations

import os
import subprocess
import sys
import unittest
from pathlib import Path

import pytest
from launch_testing.asserts import SequentialTextChecker
from launch_testing.asserts.texts import matcher
from launch_testing.launch_test import load
from launch_testing.markers import retry_on_failure
from launch_testing.test_run import test_runs as runs_of

pytestmark = pytest.mark.filterwarnings("ignore::pytest.PytestUnknownMarkWarning")

HEAD = """
import sys, unittest
import launch, launch_testing, launch_testing.actions, launch_testing.asserts, launch_testing.markers
import pytest
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration

PROGRAM = (
    "import sys, time; print('oops', file=sys.stderr, flush=True); "
    "print('hello', sys.argv[1:], flush=True); time.sleep(60)"
)

def described(*words):
    return launch.LaunchDescription([
        DeclareLaunchArgument('who', default_value='you'),
        ExecuteProcess(cmd=[sys.executable, '-c', PROGRAM, LaunchConfiguration('who'), *words], name='greeter'),
        launch_testing.actions.ReadyToTest(),
    ])
"""
GOOD = """
@pytest.mark.launch_test
def generate_test_description():
    return described(), {'answer': 42}

class TestGreeter(unittest.TestCase):
    made = []

    @classmethod
    def setUpClass(cls):
        cls.made.append('fixture')

    @classmethod
    def tearDownClass(cls):
        cls.made.remove('fixture')

    def test_it_says_hello(self, proc_output, answer):
        proc_output.assertWaitFor('hello', timeout=30, stream='stdout')
        assert answer == 42

    def test_it_starts(self, proc_info):
        proc_info.assertWaitForStartup('greeter', timeout=30)

@launch_testing.post_shutdown_test()
class TestAfterwards(unittest.TestCase):
    def test_exit_code(self, proc_info):
        launch_testing.asserts.assertExitCodes(proc_info, [launch_testing.asserts.EXIT_SIGINT, 1])

    def test_output(self):
        launch_testing.asserts.assertInStderr(self.proc_output, 'oops', 'greeter')
        with launch_testing.asserts.assertSequentialStdout(self.proc_output, 'greeter') as checker:
            checker.assertInStdout('hello')
"""
BAD = """
@pytest.mark.launch_test
def generate_test_description():
    return described()

class TestGreeter(unittest.TestCase):
    def test_it_says_good_bye(self, proc_output):
        proc_output.assertWaitFor('good bye', timeout=0.1, stream='stdout')
"""
PARAMETRIZED = """
@pytest.mark.launch_test
@launch_testing.parametrize('word', ['red', 'blue'])
def generate_test_description(word):
    return described(word)

class TestGreeter(unittest.TestCase):
    def test_it_says_its_word(self, proc_output, word):
        proc_output.assertWaitFor(word, timeout=30, stream='stdout')
"""


def write(folder: Path, text: str, name: str = "test_greeter.py") -> Path:
    path = folder / name
    path.write_text(HEAD + text)
    return path


def run(path: Path, **arguments: str) -> unittest.TestResult:
    result = unittest.TestResult()
    for each in runs_of(load(path)):
        each.run(arguments, result)
    return result


@pytest.mark.parametrize(("text", "count"), [(GOOD, 4), (PARAMETRIZED, 2)])
def test_tests_run_beside_and_afterwards(tmp_path: Path, text: str, count: int) -> None:
    result = run(write(tmp_path, text))
    assert (result.failures, result.errors, result.testsRun) == ([], [], count)


def test_a_failure_is_told(tmp_path: Path) -> None:
    result = run(write(tmp_path, BAD))
    assert len(result.failures) == 1
    assert "'good bye' was not found within 0.1 s" in result.failures[0][1]


def test_launch_arguments_reach_the_description(tmp_path: Path) -> None:
    text = BAD.replace("'good bye', timeout=0.1", "\"['me']\", timeout=30")
    assert run(write(tmp_path, text), who="me").wasSuccessful()


def test_a_description_that_never_becomes_ready_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path, "def generate_test_description():\n    return launch.LaunchDescription([])\n")
    with pytest.raises(RuntimeError, match="has to contain an action ReadyToTest"):
        run(path)


def test_a_launch_that_ends_before_its_tests_is_an_error(tmp_path: Path) -> None:
    text = BAD.replace(
        "return described()",
        "PROGRAM_ENDS = 'pass'\n    return launch.LaunchDescription(["
        "ExecuteProcess(cmd=[sys.executable, '-c', 'pass']), launch_testing.actions.ReadyToTest()])",
    )
    text = text.replace("timeout=0.1", "timeout=20")
    result = run(write(tmp_path, text))
    assert "Processes under test stopped before tests completed" in result.errors[0][1]


@pytest.mark.parametrize(("text", "code"), [(GOOD, 0), (BAD, 1)])
def test_under_pytest_and_alone(tmp_path: Path, text: str, code: int) -> None:
    path = write(tmp_path, text)
    for words in (["test", "-q", "-p", "no:cacheprovider", str(path)], ["launch_test", str(path)]):
        ended = subprocess.run(
            [sys.executable, "-c", f"import sys; from bot_console.tui.cli.main import main; sys.exit(main({words!r}))"],
            cwd=tmp_path, env={**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},  # those for our own tests
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert ended.returncode == code, ended.stdout + ended.stderr
    assert ("good bye" in ended.stderr) == bool(code)


def test_what_can_be_looked_for() -> None:
    import re

    assert matcher("b")("abc") and not matcher("d")("abc")
    assert matcher(re.compile("a.c"))("abc")
    assert matcher(["a", "c"])("a\nb\nc") and not matcher(["c", "a"])("a\nb\nc")
    with pytest.raises(ValueError, match="cannot look for 5"):
        matcher(5)
    checker = SequentialTextChecker(["one", "two"])
    checker.assertInStdout("two")
    with pytest.raises(AssertionError):
        checker.assertInStdout("one")


def test_a_test_may_be_tried_again() -> None:
    tries: list[int] = []

    @retry_on_failure(times=3)
    def flaky() -> None:
        tries.append(1)
        assert len(tries) == 3

    flaky()
    with pytest.raises(ValueError, match="times or timeout"):
        retry_on_failure()
