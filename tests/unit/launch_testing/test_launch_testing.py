"""Tests of launch descriptions: what passes, what fails, and how failures are reported."""

from __future__ import annotations

import os
import subprocess
import sys
import unittest
from pathlib import Path
from xml.etree import ElementTree

import pytest
from launch_testing.launch_test import load, main
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

    def test_it_reports_hello(self, proc_output, answer):
        proc_output.assertWaitFor('hello', timeout=240, stream='stdout')
        assert answer == 42

    def test_it_starts(self, proc_info):
        proc_info.assertWaitForStartup('greeter', timeout=240)

@launch_testing.post_shutdown_test()
class TestAfterwards(unittest.TestCase):
    def test_exit_code(self, proc_info):
        launch_testing.asserts.assertExitCodes(proc_info, [-2, 1])

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
    def test_it_reports_good_bye(self, proc_output):
        proc_output.assertWaitFor('hello', timeout=240, stream='stdout')
        proc_output.assertWaitFor('good bye', timeout=0.1, stream='stdout')
"""
PARAMETRIZED = """
@pytest.mark.launch_test
@launch_testing.parametrize('word', ['red', 'blue'])
def generate_test_description(word):
    return described(word)

class TestGreeter(unittest.TestCase):
    def test_it_reports_its_word(self, proc_output, word):
        proc_output.assertWaitFor(word, timeout=240, stream='stdout')
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
def test_tests_run_beside_the_launch_and_after_shutdown(tmp_path: Path, text: str, count: int) -> None:
    result = run(write(tmp_path, text))
    assert (result.failures, result.errors, result.testsRun) == ([], [], count)


def test_failure_is_reported_with_its_message(tmp_path: Path) -> None:
    result = run(write(tmp_path, BAD))
    assert len(result.failures) == 1
    assert "'good bye' was not found in stdout within 0.1 s" in result.failures[0][1]


def test_launch_arguments_reach_the_description(tmp_path: Path) -> None:
    text = BAD.replace("'good bye', timeout=0.1", "\"['me']\", timeout=30")
    assert run(write(tmp_path, text), who="me").wasSuccessful()


def test_description_without_ready_to_test_is_rejected(tmp_path: Path) -> None:
    path = write(tmp_path, "def generate_test_description():\n    return launch.LaunchDescription([])\n")
    with pytest.raises(Exception, match="must return a LaunchDescription containing a ReadyToTest action"):
        run(path)


def test_launch_ending_before_its_tests_is_an_error(tmp_path: Path) -> None:
    text = BAD.replace(
        "return described()",
        "PROGRAM_ENDS = 'pass'\n    return launch.LaunchDescription(["
        "ExecuteProcess(cmd=[sys.executable, '-c', 'pass']), launch_testing.actions.ReadyToTest()])",
    )
    text = text.replace("timeout=0.1", "timeout=20")
    result = run(write(tmp_path, text))
    assert "Processes under test stopped before tests completed" in result.errors[0][1]


@pytest.mark.parametrize(("text", "code"), [pytest.param(GOOD, 0, marks=pytest.mark.slow), (BAD, 1)])
def test_exit_code_is_the_same_under_pytest_and_launch_test(tmp_path: Path, text: str, code: int) -> None:
    path = write(tmp_path, text)
    for words in (["test", "-q", "-p", "no:cacheprovider", str(path)], ["launch_test", str(path)]):
        ended = subprocess.run(
            [sys.executable, "-c", f"import sys; from bot_console.tui.cli.main import main; sys.exit(main({words!r}))"],
            # plugins needed only by our own tests
            cwd=tmp_path, env={**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert ended.returncode == code, ended.stdout + ended.stderr
    assert ("good bye" in ended.stderr) == bool(code)


def test_retry_on_failure_repeats_the_test() -> None:
    tries: list[int] = []

    @retry_on_failure(times=3)
    def flaky() -> None:
        tries.append(1)
        assert len(tries) == 3

    flaky()
    with pytest.raises(ValueError, match="times or timeout"):
        retry_on_failure()


BESIDE = """
@launch_testing.parametrize('word', ['red', 'blue'])
@launch_testing.markers.keep_alive
def generate_test_description(word):
    return launch.LaunchDescription([launch_testing.actions.ReadyToTest()]), {'given': 5}

class TestBeside(unittest.TestCase):
    @classmethod
    def setUpClass(cls, launch_service, proc_info, proc_output):
        def start(text, **more):
            action = ExecuteProcess(cmd=[sys.executable, '-c', f'print({text!r}); import sys; sys.exit(3)'])
            return launch_testing.tools.launch_process(launch_service, action, proc_info, proc_output, **more)
        cls.start = staticmethod(start)

    def test_a_process_of_its_own(self, word):
        keep = launch_testing.tools.basic_output_filter(filtered_patterns=['no'])
        with self.start(f'no{chr(10)}{word}', output_filter=keep) as process:
            assert process.wait_for_shutdown(timeout=240)
        assert process.terminated and not process.running
        assert (process.exit_code, process.stdout, process.stderr) == (3, f'{word}{chr(10)}', '')

    def test_output_while_it_runs(self, launch_service, proc_info, proc_output):
        stays = ExecuteProcess(cmd=[sys.executable, '-c', PROGRAM, 'x'], name='stays')
        with launch_testing.tools.launch_process(launch_service, stays, proc_info, proc_output) as process:
            found = process.wait_for_output(lambda text: 'hello' in text, timeout=240)
            assert found and 'hello' in repr(found) and process.running
        assert process.wait_for_shutdown(timeout=240)

@launch_testing.post_shutdown_test()
class TestAfterwards(unittest.TestCase):
    def test_all_have_ended(self, proc_info, given):
        assert given == 5
        launch_testing.asserts.assertExitCodes(proc_info, [3], 'python')
"""


def test_test_may_start_processes_itself(tmp_path: Path) -> None:
    result = run(write(tmp_path, BESIDE))
    assert (result.failures, result.errors, result.testsRun) == ([], [], 6)


def test_parametrized_test_names_include_their_parameters(tmp_path: Path) -> None:
    waits = "proc_output.assertWaitFor(word, timeout=240, stream='stdout')"
    result = run(write(tmp_path, PARAMETRIZED.replace(waits, "assert not word")))
    assert [test.id().rpartition(".")[2] for test, _ in result.failures] == [
        "test_it_reports_its_word[red]",
        "test_it_reports_its_word[blue]",
    ]


def test_skipped_description_skips_its_tests(tmp_path: Path) -> None:
    result = run(write(tmp_path, "@unittest.skip('not here')" + BAD))
    assert [text for _, text in result.skipped] == ["not here"]
    assert result.wasSuccessful()


def test_ready_to_test_timeout_is_an_error(tmp_path: Path) -> None:
    text = """
@launch_testing.ready_to_test_action_timeout(0.2)
def generate_test_description():
    late = launch.actions.TimerAction(period=60.0, actions=[launch_testing.actions.ReadyToTest()])
    return launch.LaunchDescription([launch_testing.util.KeepAliveProc(), late])
"""
    result = run(write(tmp_path, text))
    assert "Timed out waiting for processes to start up" in result.errors[0][1]


def test_output_of_a_process_that_ended_early_is_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = BAD.replace(
        "return described()",
        "return launch.LaunchDescription([ExecuteProcess(cmd=[sys.executable, '-c', 'raise RuntimeError(5)']), "
        "launch_testing.actions.ReadyToTest()])",
    )
    run(write(tmp_path, text.replace("timeout=0.1", "timeout=20")))
    shown = capsys.readouterr().out
    assert "exited with 1\n##### 'python" in shown and "RuntimeError: 5" in shown


def test_launch_test_shows_arguments_and_writes_junit_xml(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, report = write(tmp_path, BAD), tmp_path / "report.xml"
    assert main([str(path), "--show-args"]) == 0
    assert "    'who':\n        no description given\n        (default: 'you')" in capsys.readouterr().out
    assert main([str(path), "--package-name", "greeting", "--junit-xml", str(report)]) == 1
    suite = ElementTree.parse(report).getroot()[0]
    assert (suite.attrib["tests"], suite.attrib["failures"], suite.attrib["errors"]) == ("1", "1", "0")
    assert suite[0].attrib["name"] == "test_it_reports_good_bye" and "good bye" in suite[0][0].attrib["message"]


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["missing.py"], "Test file 'missing.py' does not exist"),
        (["{path}", "who:="], "malformed launch argument 'who:=', expected format '<name>:=<value>'"),
    ],
)
def test_launch_test_rejects_invalid_command_lines(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], words: list[str], text: str
) -> None:
    with pytest.raises(SystemExit) as ended:
        main([each.format(path=write(tmp_path, BAD)) for each in words])
    assert ended.value.code == 2 and f"error: {text}" in capsys.readouterr().err
