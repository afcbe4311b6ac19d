"""Events, handlers, timers and processes. Contract, sections 1.3, 1.4 and 4."""

from __future__ import annotations

import asyncio
import re
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    LogInfo,
    OpaqueCoroutine,
    OpaqueFunction,
    RegisterEventHandler,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
    UnregisterEventHandler,
)
from launch.event_handlers import OnExecutionComplete, OnProcessExit, OnProcessIO, OnProcessStart, OnShutdown
from launch.events import Shutdown as ShutdownEvent
from launch.events import matches_action
from launch.events.process import ShutdownProcess, SignalProcess
from launch.substitutions import LaunchConfiguration, LocalSubstitution
from launching import Launch, Outcome
from sampling import slow_after

from launch import Event, EventHandler, LaunchContext, LaunchDescription, LaunchService


def python(code: str, **options: Any) -> ExecuteProcess:
    options.setdefault("name", "p")
    return ExecuteProcess(cmd=[sys.executable, "-S", "-c", code], **options)


def process_lines(outcome: Outcome) -> list[str]:
    """Return lines about and from processes, without their numbers."""
    lines = [each for each in outcome.lines if re.search(r"-\d+\]", each)]
    lines = [re.sub(r"\[p-\d+\]", "[p]", each) for each in lines]
    return [re.sub(r"pid \[?\d+\]?", "pid", each) for each in lines]


def test_process_prints_start_output_and_exit_code(run: Launch) -> None:
    outcome = run([python("print('a'); import sys; sys.exit(3)", output="screen")])
    started, printed, died = process_lines(outcome)
    assert (started, printed) == ("[INFO] [p]: process started with pid", "[p] a")
    assert re.fullmatch(r"\[ERROR\] \[p\]: process has died \[pid, exit code 3, cmd '.*'\]\.", died)
    assert outcome.code == 0


OUT = "import sys; print('out'); print('err', file=sys.stderr)"
OUTPUTS: list[tuple[Any, set[str], str]] = [
    ("screen", {"out", "err"}, ""),
    ("log", {"err"}, "out err"),
    ("both", {"out", "err"}, "out err"),
    ("own_log", set(), ""),
    ("full", {"out", "err"}, "out err"),
    ({"stdout": "screen"}, {"out"}, ""),
    ({"both": ["screen", "log"]}, {"out", "err"}, "out err"),
    ({"stdout": "log", "stderr": "screen"}, {"err"}, "out"),
]


@pytest.mark.parametrize(("output", "shown", "logged"), OUTPUTS, ids=[str(row[0]) for row in OUTPUTS])
def test_output_option_selects_screen_and_log(run: Launch, output: Any, shown: set[str], logged: str) -> None:
    import launch.logging

    outcome = run([python(OUT, output=output)])
    assert {each.partition("] ")[2] for each in outcome.lines if re.match(r"\[p-\d+\]", each)} == shown
    log = Path(launch.logging.launch_config.get_log_file_path()).read_text()
    for word in ("out", "err"):
        assert bool(re.search(rf"^\d+\.\d{{7}} \[p-\d+\] {word}$", log, re.M)) is (word in logged.split())


def test_own_log_files_contain_bare_lines(run: Launch) -> None:
    import launch.logging

    name = next(each for each in run([python(OUT, output="own_log")]).lines if "process started" in each)
    name = name.partition("[INFO] [")[2].partition("]")[0]
    for file, lines in (
        (f"{name}-stdout.log", {"out"}),
        (f"{name}-stderr.log", {"err"}),
        (f"{name}.log", {"out", "err"}),
    ):
        text = Path(launch.logging.launch_config.get_log_file_path(file)).read_text()
        assert set(text.splitlines()) == {f"[{name}] {line}" for line in lines}


def test_environment_variable_overrides_output(run: Launch, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OVERRIDE_LAUNCH_PROCESS_OUTPUT", "screen")
    assert "[p] out" in process_lines(run([python(OUT, output="nonsense")]))


def test_invalid_output_is_rejected(run: Launch) -> None:
    text = 'nonsense is not a valid standard output config i.e. "screen", "log" or "both"'
    assert run([python(OUT, output="nonsense")]).caught == text


def test_unfinished_line_is_printed_after_the_end(run: Launch) -> None:
    lines = process_lines(run([python("print('part', end='')", output="screen")]))
    assert lines[1:] == ["[INFO] [p]: process has finished cleanly [pid", "[p] part"]


def test_output_format_formats_each_line(run: Launch) -> None:
    outcome = run([python("print('a')", output="screen", output_format="<{line}>")])
    assert "<a>" in outcome.lines


def test_cached_output_is_kept(run: Launch) -> None:
    process = python("print('kept')", cached_output=True)
    assert process.return_code is None
    run([process])
    assert (process.get_stdout(), process.return_code) == ("kept\n", 0)
    with pytest.raises(RuntimeError):
        python("").get_stdout()


def test_missing_executable_is_logged_and_the_launch_goes_on(run: Launch) -> None:
    outcome = run([ExecuteProcess(cmd=["/no/such/program"]), LogInfo(msg="on")])
    assert outcome.code == 0
    assert "exception occurred while executing process:" in outcome.text


def test_process_numbers_increase_across_launches(run: Launch) -> None:
    first, second = python("", name="a"), python("", name="b")
    run([first, second])
    names = [each.process_description.final_name or "" for each in (first, second)]
    assert int(names[1].rpartition("-")[2]) == int(names[0].rpartition("-")[2]) + 1


def test_executing_an_action_twice_is_an_error(run: Launch) -> None:
    process = python("")
    outcome = run([process, process])
    assert re.match(r"ExecuteLocal action 'p-\d+': executed more than once: <", outcome.caught)


AGAIN: dict[str, Callable[[Any], Any]] = {
    "itself": lambda process: process,
    "in a group": lambda process: GroupAction([process]),
    "from a function": lambda process: OpaqueFunction(function=lambda context: [process]),
    "by a timer": lambda process: TimerAction(period=0.0, actions=[process]),
    "in a nested description": lambda process: LaunchDescription([process]),
}
"""Ways in which a handler executes the same process again."""


@pytest.mark.parametrize("again", slow_after(2, AGAIN))
@pytest.mark.parametrize("after", ["start", "output"])
def test_reexecuting_a_running_action_keeps_its_process(run: Launch, again: str, after: str) -> None:
    ended: list[int] = []
    process = python(
        "print('up', flush=True); input()",
        respawn=after == "start",
        on_exit=lambda event, context: ended.append(event.pid),
    )
    entity = AGAIN[again](process)
    handlers = {
        "start": OnProcessStart(target_action=process, on_start=[entity]),
        "output": OnProcessIO(target_action=process, on_stdout=lambda event: entity),
    }
    outcome = run([RegisterEventHandler(handlers[after]), process])
    assert re.match(r"ExecuteLocal action 'p-\d+': executed more than once: <", outcome.caught)
    assert "exception occurred" not in outcome.text, "only the second execution fails"
    assert len(ended) == 1
    assert process.process_details is not None and process.process_details["pid"] == ended[0]


def test_command_given_as_text_is_split_into_characters_with_a_warning(run: Launch) -> None:
    made: list[ExecuteProcess] = []

    def make(context: LaunchContext) -> None:
        made.append(ExecuteProcess(cmd="/x y"))

    outcome = run([OpaqueFunction(function=make)])
    assert [each[0].describe() for each in made[0].cmd] == ["'/'", "'x'", "' '", "'y'"]
    assert "cmd='/x y' is read letter by letter: give a list of words, cmd=['/x', 'y']" in outcome.text


def test_launch_prefix_filter_limits_the_prefix(run: Launch) -> None:
    code = "import os; print(os.environ.get('BC_P'))"
    filtered = {"launch-prefix": "env BC_P=1", "launch-prefix-filter": "nothing"}
    assert "1" in [
        each.partition("] ")[2] for each in run([python(code, output="screen")], {"launch-prefix": "env BC_P=1"}).lines
    ]
    assert "None" in [each.partition("] ")[2] for each in run([python(code, output="screen")], filtered).lines]
    own = python(code, output="screen", prefix="env BC_P=2")
    assert "2" in [each.partition("] ")[2] for each in run([own], filtered).lines]


def test_env_replaces_and_additional_env_extends_environment(run: Launch) -> None:
    code = "import os; print(os.environ.get('BC_A'), 'PATH' in os.environ)"
    added = python(code, output="screen", additional_env={"BC_A": LaunchConfiguration("x")})
    replaced = python(code, output="screen", env={"BC_A": "2"})
    text = run([added, replaced], {"x": "1"}).text
    assert "] 1 True" in text
    assert "] 2 False" in text


def test_process_respawns_until_retries_are_used_up(run: Launch) -> None:
    ended: list[int] = []
    process = python("", respawn=True, respawn_max_retries=2, on_exit=lambda event, context: ended.append(event.pid))
    outcome = run([process])
    assert len(ended) == len(set(ended)) == 3
    assert outcome.text.count("process has finished cleanly") == 3


def test_process_does_not_respawn_during_shutdown(run: Launch) -> None:
    process = python("", respawn=True, respawn_delay=60.0)
    outcome = run(
        [process, RegisterEventHandler(OnProcessExit(on_exit=[TimerAction(period=0.01, actions=[Shutdown()])]))]
    )
    assert outcome.text.count("process started") == 1


def test_exit_of_a_required_process_shuts_down_the_launch(run: Launch) -> None:
    outcome = run([python("import sys; sys.exit(1)", on_exit=Shutdown())])
    assert outcome.code == 0
    assert re.search(r"\[INFO\] \[launch\]: process\[p-\d+\] was required: shutting down launched system", outcome.text)


WAITS = "import os, signal, time; signal.signal(signal.SIGINT, {}); os.write(1, b'up\\n'); time.sleep(60)"


def test_shutdown_sends_sigint(run: Launch) -> None:
    process = python(WAITS.format("lambda *_: os._exit(0)"), output="screen")
    on_io = OnProcessIO(target_action=process, on_stdout=lambda event: EmitEvent(event=ShutdownEvent()))
    lines = process_lines(run([process, RegisterEventHandler(on_io)]))
    assert lines[2] == "[INFO] [p]: sending signal 'SIGINT' to process[p]", lines
    assert lines[3] == "[INFO] [p]: process has finished cleanly [pid"


def test_shutdown_escalates_to_sigkill(run: Launch) -> None:
    code = "import signal, time\nfor each in (signal.SIGINT, signal.SIGTERM): signal.signal(each, signal.SIG_IGN)\n"
    code += "import os; os.write(1, b'up\\n')\ntime.sleep(60)"
    process = python(code, sigterm_timeout="0.1", sigkill_timeout="0.2", output="screen")
    on_io = OnProcessIO(target_action=process, on_stdout=lambda event: Shutdown())
    text = run([process, RegisterEventHandler(on_io)]).text
    assert "failed to terminate '0.1' seconds after receiving 'SIGINT', escalating to 'SIGTERM'" in text
    assert re.search(r"failed to terminate '0\.3\d*' seconds after receiving 'SIGTERM', escalating to 'SIGKILL'", text)
    assert "exit code -9" in text


def test_signal_can_be_sent_by_name(run: Launch) -> None:
    process = python(WAITS.format("signal.default_int_handler"), output="screen")

    def signal_it(event: Any) -> Any:
        return EmitEvent(event=SignalProcess(signal_number="SIGTERM", process_matcher=matches_action(process)))

    outcome = run(
        [process, RegisterEventHandler(OnProcessIO(target_action=process, on_stdout=signal_it, handle_once=True))]
    )
    assert "sending signal 'SIGTERM'" in outcome.text
    assert outcome.caught == "'str' object cannot be interpreted as an integer"
    assert outcome.code == 1


def test_single_process_can_be_shut_down(run: Launch) -> None:
    process = python(WAITS.format("lambda *_: os._exit(0)"), output="screen")
    event = ShutdownProcess(process_matcher=matches_action(process))
    on_io = OnProcessIO(target_action=process, on_stdout=lambda _: EmitEvent(event=event))
    assert "sending signal 'SIGINT'" in run([process, RegisterEventHandler(on_io)]).text


def test_start_and_exit_handlers_run_in_order(run: Launch) -> None:
    process = python("")
    seen: list[Any] = []

    def exited(event: Any, context: Any) -> Any:
        seen.append((event.action is process, event.returncode, event.process_name, event.pid > 0))
        return [LogInfo(msg="exited")]

    outcome = run(
        [
            process,
            RegisterEventHandler(OnProcessExit(target_action=process, on_exit=exited)),
            RegisterEventHandler(OnProcessStart(target_action=process, on_start=[LogInfo(msg="started")])),
            RegisterEventHandler(
                OnProcessExit(target_action=lambda action: action is process, on_exit=LogInfo(msg="predicate"))
            ),
            RegisterEventHandler(OnProcessExit(target_action=python(""), on_exit=LogInfo(msg="never"))),
        ]
    )
    assert outcome.message == ["started", "predicate", "exited"]  # the newest handler runs first
    assert seen == [(True, 0, process.process_description.final_name, True)]


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (
            lambda: OnProcessExit(on_exit=["x"]),
            "expected all items in 'on_event' iterable to be of type 'LaunchDescriptionEntity' but got '<class 'str'>'",
        ),
        (
            lambda: OnProcessExit(target_action=5, on_exit=[]),
            "action_matcher must be an 'ExecuteLocal' instance or a callable",
        ),
    ],
)
def test_invalid_handlers_are_rejected(make: Any, text: str) -> None:
    with pytest.raises(TypeError) as caught:
        make()
    assert str(caught.value) == text


def test_emit_event_rejects_non_events() -> None:
    wrong: Any = "x"
    with pytest.raises(RuntimeError, match=r"EmitEvent\(\) expected an event instance, got 'x'."):
        EmitEvent(event=wrong)


def test_static_tree_is_visited_before_any_process_starts(run: Launch) -> None:
    lines = run([python(""), LogInfo(msg="later")]).lines
    assert lines.index("[INFO] [launch.user]: later") < next(i for i, each in enumerate(lines) if "started" in each)


def test_handler_sees_configurations_of_its_event(run: Launch) -> None:
    process = python("")
    on_exit = OnProcessExit(target_action=process, on_exit=[LogInfo(msg=LaunchConfiguration("x"))])
    group = GroupAction([SetLaunchConfiguration("x", "in"), RegisterEventHandler(on_exit), process])
    assert run([SetLaunchConfiguration("x", "out"), group]).message == ["out"]


class Own(Event):
    name = "own"


def test_shutdown_handlers_get_the_reason(run: Launch) -> None:
    reason = LogInfo(msg=LocalSubstitution("event.reason"))
    assert run([RegisterEventHandler(OnShutdown(on_shutdown=[reason])), Shutdown(reason="done")]).message == ["done"]
    assert run([RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context: [reason]))]).message[-1] == "idle"


def test_completion_handler_must_be_registered_before_completion(run: Launch) -> None:
    timer = TimerAction(period=0.01, actions=[])
    before = RegisterEventHandler(OnExecutionComplete(target_action=timer, on_completion=[LogInfo(msg="complete")]))
    assert run([before, timer]).message == ["complete"]
    late = TimerAction(period=0.01, actions=[])
    after = RegisterEventHandler(OnExecutionComplete(target_action=late, on_completion=[LogInfo(msg="never")]))
    assert run([late, after]).message[1:] == []


def test_custom_events_respect_handle_once_and_unregistering(run: Launch) -> None:
    once = EventHandler(matcher=lambda event: isinstance(event, Own), entities=[LogInfo(msg="once")], handle_once=True)
    gone = EventHandler(matcher=lambda event: isinstance(event, Own), entities=[LogInfo(msg="gone")])
    entities = [RegisterEventHandler(once), RegisterEventHandler(gone), UnregisterEventHandler(gone)]
    assert run([*entities, EmitEvent(event=Own()), EmitEvent(event=Own())]).message == ["once"]


def test_coroutines_run_and_are_cancelled_at_the_end(run: Launch) -> None:
    ran: list[str] = []

    async def later(context: Any, word: str) -> None:
        await asyncio.sleep(0)
        ran.append(word)

    async def for_ever() -> None:
        await asyncio.Event().wait()

    assert run([OpaqueCoroutine(coroutine=later, args=["a"])]).code == 0
    assert ran == ["a"]
    assert run([OpaqueCoroutine(coroutine=for_ever, ignore_context=True), Shutdown()]).code == 0


def test_exception_in_handler_stops_running_processes(run: Launch) -> None:
    process = python(WAITS.format("lambda *_: os._exit(0)"), output="screen")

    def fail(event: Any) -> None:
        raise ValueError("on purpose")

    outcome = run([process, RegisterEventHandler(OnProcessIO(on_stdout=fail, handle_once=True))])
    assert (outcome.code, outcome.caught) == (1, "on purpose")
    assert "sending signal 'SIGINT'" in outcome.text


def test_service_runs_in_another_thread(log_lines: list[str]) -> None:
    service = LaunchService(noninteractive=True)
    codes: list[int] = []
    runs = threading.Event()
    service.include_launch_description(LaunchDescription([OpaqueFunction(function=lambda context: runs.set())]))
    thread = threading.Thread(target=lambda: codes.append(service.run(shutdown_when_idle=False)))
    thread.start()
    assert runs.wait(240)
    heard = threading.Event()
    service.include_launch_description(LaunchDescription([OpaqueFunction(function=lambda context: heard.set())]))
    assert heard.wait(240)
    service.shutdown()
    thread.join(240)
    assert codes == [0]


def test_service_rejects_a_concurrent_run(log_lines: list[str]) -> None:
    service = LaunchService()

    async def twice() -> None:
        first = asyncio.ensure_future(service.run_async(shutdown_when_idle=False))
        await asyncio.sleep(0)
        with pytest.raises(RuntimeError, match=r"LaunchService cannot be run multiple times concurrently\."):
            await service.run_async()
        await service.shutdown()
        await first

    asyncio.run(twice())


def test_launch_starts_with_log_folder_and_verbosity(run: Launch) -> None:
    first, second = run([]).lines
    assert first.startswith("[INFO] [launch]: All log files can be found below ")
    assert second == "[INFO] [launch]: Default logging verbosity is set to INFO"


class _CustomEvent(Event):
    """An event for tests."""


def _while_it_runs(act: Callable[[LaunchService], Any], *handlers: Any) -> tuple[int, list[Any]]:
    """Call something in another thread while a service runs; return the exit code and the result of the call."""
    service = LaunchService(noninteractive=True)
    given: list[Any] = []

    def other() -> None:
        given.append(act(service))
        service.shutdown()

    thread = threading.Thread(target=other)

    def begin(context: Any) -> None:
        thread.start()

    entities = [*(RegisterEventHandler(each) for each in handlers), OpaqueFunction(function=begin)]
    service.include_launch_description(LaunchDescription(entities))
    code = service.run(shutdown_when_idle=False)
    thread.join()
    return code, given


def test_emit_from_another_thread_returns_once_the_loop_took_the_event() -> None:
    begun, free = threading.Event(), threading.Event()

    def held_up(context: Any) -> None:
        begun.set()
        free.wait(240.0)

    def act(service: LaunchService) -> list[bool]:
        service.emit_event(_CustomEvent())
        begun.wait(240.0)  # the handler blocks the loop now
        second = threading.Thread(target=service.emit_event, args=(_CustomEvent(),))
        second.start()
        second.join(0.1)
        waits = second.is_alive()
        free.set()
        second.join(240.0)
        return [waits, second.is_alive()]

    handler = EventHandler(
        matcher=lambda event: isinstance(event, _CustomEvent), entities=OpaqueFunction(function=held_up)
    )
    assert _while_it_runs(act, handler) == (0, [[True, False]])


def test_emit_inside_the_loop_is_refused_instead_of_deadlocking(log_lines: list[str]) -> None:
    service = LaunchService(noninteractive=True)
    inside = OpaqueFunction(function=lambda context: service.emit_event(_CustomEvent()))
    service.include_launch_description(LaunchDescription([inside]))
    assert service.run() == 1
    assert "return the action EmitEvent(event=...)" in "\n".join(log_lines)


def test_shutdown_returns_a_coroutine_outside_coroutines_too() -> None:
    service = LaunchService()
    loop = asyncio.new_event_loop()
    loop.run_until_complete(loop.create_task(service.shutdown()))
    loop.close()
    assert service.shutdown(force_sync=True) is None
    assert service.run() == 0
