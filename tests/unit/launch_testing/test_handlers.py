"""The record of processes: which ones match, what they printed, and how they ended."""

from __future__ import annotations

import re
from types import SimpleNamespace
from typing import Any

import pytest
from launch.actions import ExecuteProcess
from launch.events.process import ProcessExited, ProcessStarted, ProcessStderr, ProcessStdout
from launch.substitutions import LocalSubstitution
from launch_testing import ActiveIoHandler, ActiveProcInfoHandler, event_handlers
from launch_testing.actions import GTest, PyTest, Test
from launch_testing.asserts import (
    EXIT_SIGINT,
    NO_CMD_ARGS,
    SequentialTextChecker,
    assertExitCodes,
    assertInStdout,
    assertInStream,
    assertSequentialStdout,
)
from launch_testing.util import NoMatchingProcessException, resolveProcesses

from launch import LaunchContext, LaunchDescription, LaunchService


def process(*words: str) -> ExecuteProcess:
    action = ExecuteProcess(cmd=["/bin/counter", *words])
    action.prepare(LaunchContext())
    return action


def event(kind: Any, action: Any, **more: Any) -> Any:
    return kind(action=action, pid=7, **{"cwd": None, "env": None, **action.process_details, **more})


@pytest.fixture
def known() -> SimpleNamespace:
    bare, fast = process(), process("--fast", "twice")
    info, output = ActiveProcInfoHandler(), ActiveIoHandler()
    for action in (bare, fast):
        info.append(event(ProcessStarted, action))
        output.track(action.process_details["name"])
    output.append(event(ProcessStdout, bare, text=b"one\n\x1b[31mtwo\x1b[0m\n"))
    output.append(event(ProcessStderr, bare, text=b"oops\n"))
    return SimpleNamespace(bare=bare, fast=fast, info=info, output=output)


def test_processes_are_matched_by_name_and_arguments(known: SimpleNamespace) -> None:
    def found(*process: Any, **more: Any) -> list[Any]:
        return resolveProcesses(known.info, process=process[0] if process else None, **more)

    assert found() == [known.bare, known.fast]
    assert found(known.fast) == [known.fast]
    assert found("counter", cmd_args="--fast") == found("counter", cmd_args=["--fast", "twice"]) == [known.fast]
    assert found("counter", cmd_args=NO_CMD_ARGS) == [known.bare]
    assert found("counter", strict_proc_matching=False) == [known.bare, known.fast]
    with pytest.raises(
        Exception, match="Found multiple processes matching name 'counter' and cmd_args 'None'"
    ) as several:
        found("counter")
    assert not isinstance(several.value, NoMatchingProcessException)
    with pytest.raises(NoMatchingProcessException, match=r"matching name 'x' and args 'None'. Procs: counter-\d+"):
        found("x")
    with pytest.raises(NoMatchingProcessException, match="No data recorded for proc echo hi"):
        found(ExecuteProcess(cmd=["echo", "hi"]))
    with pytest.raises(NoMatchingProcessException, match="Unknown - Process not launched yet"):
        found(ExecuteProcess(cmd=["echo", LocalSubstitution("who")]))
    with pytest.raises(TypeError, match="must be 'ExecuteProcess' or 'str' not <class 'int'>"):
        found(5)
    with pytest.raises(NoMatchingProcessException, match="No data recorded for any process"):
        resolveProcesses(ActiveIoHandler())


def test_output_is_kept_per_process(known: SimpleNamespace) -> None:
    name = known.bare.process_details["name"]
    assert known.output.process_names() == [name, known.fast.process_details["name"]]
    assert known.output.processes() == [known.bare]  # those that have printed something
    assert [each.text for each in known.output[name]] == [each.text for each in known.output[known.bare]]
    assert known.output[known.fast] == []
    with pytest.raises(KeyError):
        known.output["counter"]  # only a part of the name


def test_assert_in_stdout_matches_texts_patterns_and_lists(known: SimpleNamespace) -> None:
    assertInStdout(known.output, "one\ntwo", "counter")
    assertInStdout(known.output, re.compile("^two$", re.M), None)
    assertInStdout(known.output, ["one", "two"], known.bare)
    assertInStdout(known.output, "ONE", "counter", output_filter=str.upper)
    with pytest.raises(AssertionError, match=r"Did not find '\['two', 'one'\]' in output for any of the matching"):
        assertInStdout(known.output, ["two", "one"], "counter")
    with pytest.raises(AssertionError):
        assertInStdout(known.output, "one\ntwo", "counter", strip_ansi_escape_sequences=False)
    with pytest.raises(ValueError, match="must be 'stdout' or 'stderr'"):
        assertInStream(known.output, "one", None, stream="both")
    with pytest.raises(ValueError, match="output_filter is not callable"):
        assertInStream(known.output, "one", None, output_filter="x")  # type: ignore[arg-type]
    assert known.output.waitFor("oops") and not known.output.waitFor("one", timeout=0)
    with pytest.raises(NoMatchingProcessException):
        known.output.waitFor("one", "talker", timeout=0)


def test_sequential_assertions_respect_order(known: SimpleNamespace) -> None:
    with assertSequentialStdout(known.output, "counter") as checker:
        checker.assertInStdout("one")
        checker.assertInStdout("oops")
        with pytest.raises(AssertionError):
            checker.assertInStdout("one")
    checker = SequentialTextChecker(["a1 a2\n", "b\n", "c\n", "d\n"])
    checker.assertInStdout("a1")
    checker.assertInStdout("a2")
    checker.assertInStdout("b")
    with pytest.raises(AssertionError, match=r"'a1' not found in sequence after previous match\.  The output near"):
        checker.assertInStdout("a1")
    assert checker.get_nearby_lines() == "a1 a2\nb\nc\nd"


def test_exit_codes_are_kept_per_process(known: SimpleNamespace) -> None:
    with pytest.raises(AssertionError, match=r"Timed out waiting for process 'counter-\d+ --fast twice' to finish"):
        known.info.assertWaitForShutdown(known.fast, timeout=0)
    known.info.append(event(ProcessExited, known.fast, returncode=-2))
    known.info.append(event(ProcessExited, known.bare, returncode=0))
    known.info.assertWaitForShutdown("counter", "--fast", timeout=0)
    assert known.info["counter"].returncode == 0  # the first with that name
    with pytest.raises(KeyError):
        known.info["talker"]
    assertExitCodes(known.info, [0, -2])
    assertExitCodes(known.info, process=known.bare)
    with pytest.raises(AssertionError, match=r"Proc counter-\d+ exited with code -2"):
        assertExitCodes(known.info, [0, EXIT_SIGINT])
    with pytest.raises(AssertionError, match="Provided exit code 0 is not an int"):
        assertExitCodes(known.info, ["0"])  # type: ignore[list-item]


def test_ready_listener_runs_actions_when_text_appears() -> None:
    from launch.actions import OpaqueFunction, RegisterEventHandler

    done: list[str] = []

    def listener(text: str) -> Any:
        note = OpaqueFunction(function=lambda context: done.append(text))
        handler = event_handlers.StdoutReadyListener(target_action=message_of, ready_txt=text, actions=[note])
        assert handler.describe()[1] == [note]
        return RegisterEventHandler(handler)

    message_of = ExecuteProcess(cmd=["echo", "I am ready"])
    service = LaunchService(noninteractive=True)
    service.include_launch_description(LaunchDescription([listener("ready"), listener("steady"), message_of]))
    assert service.run() == 0
    assert done == ["ready"]


def test_test_actions_run_programs_with_a_timeout() -> None:
    locked = Test(cmd=["sleep", "60"], timeout=4.0)  # as in ROS 2, a process that starts later than that is not killed
    service = LaunchService(noninteractive=True)
    service.include_launch_description(LaunchDescription([locked]))
    service.run()
    assert locked.return_code == -9
    assert GTest(path="/bin/true").path == "/bin/true"
    words = PyTest(path="test_x.py", timeout=5.0).cmd
    assert [each[0].describe() for each in words[1:]] == ["'-m'", "'pytest'", "'test_x.py'"]
