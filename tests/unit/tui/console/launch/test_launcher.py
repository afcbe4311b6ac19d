"""The launcher over the embedded launch: processes controlled one by one, several launch files, files that fail."""

import re
import threading
from contextlib import suppress
from importlib import import_module

import pytest
from bot_console.tui.console.launch.restart_policy import RestartPolicy
from bot_console.tui.console.model import LaunchArgument, ProcessState, Severity
from domains import unused_domain
from launcher_bench import DEAF, ENDS, FAILS, TIMEOUT_S, WAITS, Bench


@pytest.fixture
def bench(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    made = Bench(tmp_path)
    yield made
    made.launcher.close()


@pytest.fixture
def supervising_bench(tmp_path, monkeypatch):
    """A bench whose settings restart failed processes, twice and at once."""
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    made = Bench(tmp_path, policy=RestartPolicy(2, 0.0, 0.0), restarts=True)
    yield made
    made.launcher.close()


@pytest.fixture
def waiting_node(bench):
    """A launched node that waits."""
    path = bench.program(WAITS, "waits.py")
    assert bench.run(f"[Node(executable={path!r}, name='bob', namespace='ns')]").ok
    bench.until(lambda: any(text == "up" for _, _, text in bench.printed), "its first line")
    return bench.process()


def test_a_process_is_shown_with_label_and_nodes(bench, waiting_node):
    assert (waiting_node.state, waiting_node.nodes, waiting_node.group) == (
        ProcessState.RUNNING,
        ("/ns/bob",),
        ("system.launch.py",),
    )
    assert waiting_node.pid is not None, "it has its own process"
    assert waiting_node.started and waiting_node.restarts == 0 and waiting_node.exit_code is None
    assert bench.info is bench.info


def test_a_stopped_process_can_be_started_again(bench, waiting_node):
    assert bench.do("stop", waiting_node).ok
    ended = bench.process()
    assert (ended.state, ended.exit_code, ended.pid) == (ProcessState.EXITED, 0, None)
    assert bench.do("start", ended).ok
    again = bench.process()
    assert (again.key, again.state, again.restarts) == (waiting_node.key, ProcessState.RUNNING, 1)
    assert again.nodes == ("/ns/bob",)
    assert again.exit_code == 0, "the last exit stays visible"


def test_restart_ends_and_starts_a_process(bench, waiting_node):
    assert bench.do("restart", waiting_node).ok
    again = bench.process()
    assert (again.state, again.restarts) == (ProcessState.RUNNING, 1)
    assert again.started > waiting_node.started


def test_restart_of_an_ended_process_starts_it(bench, waiting_node):
    bench.do("stop", waiting_node)
    assert bench.do("restart", waiting_node).ok
    assert bench.process().state is ProcessState.RUNNING


def test_kill_ends_a_process_at_once(bench, waiting_node):
    assert bench.do("kill", waiting_node).ok
    killed = bench.process()
    assert (killed.state, killed.exit_code) == (ProcessState.CRASHED, -9)
    assert "killed" in killed.problem
    assert bench.do("start", killed).ok


@pytest.mark.parametrize(
    ("before", "verb", "text"),
    [("", "start", "is already running"), ("stop", "stop", "is not running"), ("stop", "kill", "is not running")],
)
def test_verbs_that_do_not_apply_are_refused_with_the_reason(bench, waiting_node, before, verb, text):
    if before:
        bench.do(before, waiting_node)
    answer = bench.do(verb, waiting_node)
    assert not answer.ok
    assert text in answer.text


def test_an_unknown_process_is_refused(bench):
    answer = bench.launcher.stop("nobody").result(TIMEOUT_S)
    assert (answer.ok, answer.text) == (False, "there is no process nobody")


def test_a_process_that_ignores_signals_is_killed_by_the_escalation(bench):
    path = bench.program(DEAF)
    bench.run(f"[ExecuteProcess(cmd=['python3', '-u', {path!r}], sigterm_timeout='0.1', sigkill_timeout='0.1')]")
    bench.until(lambda: any("up" in text for _, _, text in bench.printed), "its first line")
    assert bench.do("stop", bench.process()).ok
    assert bench.process().exit_code == -9


def test_a_stopping_process_can_be_killed(bench):
    path = bench.program(DEAF)
    bench.run(f"[ExecuteProcess(cmd=['python3', '-u', {path!r}], sigterm_timeout='600')]")
    bench.until(lambda: any("up" in text for _, _, text in bench.printed), "its first line")
    stopping = bench.launcher.stop(bench.process().key)
    assert bench.process().state is ProcessState.STOPPING
    assert not stopping.done()
    assert bench.do("kill", bench.process()).ok
    assert stopping.result(TIMEOUT_S).ok


def test_stop_cancels_a_pending_restart(bench):
    path = bench.program(DEAF)
    bench.run(f"[ExecuteProcess(cmd=['python3', '-u', {path!r}], sigterm_timeout='1.0', sigkill_timeout='0.1')]")
    bench.until(lambda: any("up" in text for _, _, text in bench.printed), "its first line")
    key = bench.process().key
    restart, stop = bench.launcher.restart(key), bench.launcher.stop(key)
    assert stop.result(TIMEOUT_S).ok
    assert not restart.result(TIMEOUT_S).ok
    assert bench.process().restarts == 0


def test_a_respawning_process_is_started_again(bench):
    path = bench.program(FAILS)
    bench.run(f"[Node(executable={path!r}, respawn=True, respawn_delay=0.01)]")
    bench.until(lambda: bench.process().restarts >= 3, "the third respawn")
    assert bench.process().exit_code == 1
    assert bench.do("stop", bench.process()).ok
    stopped = bench.process()
    assert stopped.state in (ProcessState.EXITED, ProcessState.CRASHED)
    bench.until(lambda: bench.texts()[-1] == "system.launch.py has ended", "the end of the launch")
    assert bench.process().restarts == stopped.restarts


def test_stop_during_the_respawn_delay_prevents_the_respawn(bench):
    path = bench.program(ENDS)
    bench.run(f"[Node(executable={path!r}, respawn=True, respawn_delay=600.0)]")
    bench.until(lambda: bench.process().exit_code is not None, "its end")
    assert bench.process().state is ProcessState.STARTING
    assert bench.do("stop", bench.process()).ok
    assert bench.process().state is ProcessState.EXITED


def test_a_killed_process_that_respawns_is_started_again(bench):
    path = bench.program(WAITS)
    bench.run(f"[Node(executable={path!r}, respawn=True)]")
    assert bench.do("kill", bench.process()).ok
    bench.until(lambda: bench.process().state is ProcessState.RUNNING, "the respawn")
    assert bench.process().restarts == 1


def test_a_process_still_respawns_after_a_restart(bench):
    path = bench.program(WAITS)
    bench.run(f"[Node(executable={path!r}, respawn=True)]")
    assert bench.do("restart", bench.process()).ok
    assert bench.do("kill", bench.process()).ok
    bench.until(lambda: bench.process().restarts == 2 and bench.process().state is ProcessState.RUNNING, "the respawn")


def test_a_crash_is_reported_and_does_not_affect_other_processes(bench):
    fails, waits = bench.program(FAILS, "fails.py"), bench.program(WAITS, "waits.py")
    bench.run(f"[Node(executable={waits!r}), Node(executable={fails!r})]")
    bench.until(lambda: len(bench.info.processes) == 2 and bench.process("fails").exit_code == 1, "the crash")
    crashed = bench.process("fails")
    assert (crashed.state, crashed.problem) == (ProcessState.CRASHED, "RuntimeError: the fault (fails.py:1)")
    assert bench.process("waits").state is ProcessState.RUNNING
    assert next(each for each in bench.info.timeline if each.severity is Severity.ERROR).text.startswith("fails.py")


def test_a_deleted_program_does_not_end_the_launch(bench):
    fails, waits = bench.folder / "fails.py", bench.program(WAITS, "waits.py")
    bench.program(FAILS, "fails.py")
    bench.run(f"[Node(executable={waits!r}), Node(executable={str(fails)!r})]")
    bench.until(lambda: len(bench.info.processes) == 2 and bench.process("fails").exit_code == 1, "the crash")
    fails.unlink()
    answer = bench.do("start", bench.process("fails"))
    assert not answer.ok
    assert bench.process("fails").state is ProcessState.CRASHED
    assert bench.process("waits").state is ProcessState.RUNNING


def test_postponed_starts_are_counted_until_they_begin(bench):
    path = bench.program(WAITS, "waits.py")
    late = f"Node(executable={path!r})"
    never = "TimerAction(period=3600.0, actions=[Shutdown()])"
    event = f"RegisterEventHandler(OnProcessExit(on_exit=[TimerAction(period=3600.0, actions=[{late}])]))"
    assert bench.run(
        f"[Node(executable={path!r}), {event}, {never}, TimerAction(period=3600.0, actions=[GroupAction([{late}])]), "
        f"TimerAction(period=0.01, actions=[{late}])]"
    ).ok
    bench.until(lambda: [each.state for each in bench.info.processes] == [ProcessState.RUNNING] * 2, "the second node")
    bench.until(lambda: bench.info.delayed == 1, "the one that is put off for an hour, and none else")


def test_the_tree_names_files_and_groups(bench):
    path = bench.program(WAITS)
    bench.file(f"[Node(executable={path!r}, name='inner')]", "inner.launch.py")
    inner = str(bench.folder / "inner.launch.py")
    bench.run(
        f"[GroupAction([PushRosNamespace('left'), IncludeLaunchDescription({inner!r})]),"
        f" IncludeLaunchDescription({inner!r}), Node(executable={path!r}, name='outer')]",
    )
    bench.until(lambda: len(bench.info.processes) == 3, "three processes")
    assert {each.nodes[0]: each.group for each in bench.info.processes} == {
        "/left/inner": ("system.launch.py", "left", "inner.launch.py"),
        "/inner": ("system.launch.py", "inner.launch.py"),
        "/outer": ("system.launch.py",),
    }


def test_two_launch_files_run_at_once_and_one_of_them_twice(bench):
    path = bench.program(WAITS)
    bench.run(f"[Node(executable={path!r}, name='a')]", "a.launch.py")
    bench.run(f"[Node(executable={path!r}, name='b')]", "b.launch.py")
    bench.run(f"[Node(executable={path!r}, name='c')]", "b.launch.py")
    assert [each.group for each in bench.info.processes] == [("a.launch.py",), ("b.launch.py",), ("b.launch.py (2)",)]
    assert bench.do("stop", bench.info.processes[0]).ok
    assert [each.state for each in bench.info.processes[1:]] == [ProcessState.RUNNING] * 2


def test_a_failed_launch_does_not_use_up_a_number(bench):
    bench.file("[1 / 0]", "a.launch.py")
    assert not bench.launcher.launch(str(bench.folder / "a.launch.py"), {}).result(TIMEOUT_S).ok
    bench.run(f"[Node(executable={bench.program(WAITS)!r}, name='a')]", "a.launch.py")
    assert [each.group for each in bench.info.processes] == [("a.launch.py",)]


SYNTAX = "def generate_launch_description(:\n    pass\n"
RAISES = "def generate_launch_description():\n    return 1 / 0\n"
RECURS = "def generate_launch_description():\n    raise RecursionError\n"
"""A file that includes itself does the same when there are too many levels."""
NOTHING = "x = 1\n"
EXITS = "import sys\nsys.exit('no robot today')\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (SYNTAX, r"line 1: syntax error: invalid syntax"),
        (RAISES, r"line 2: ZeroDivisionError: division by zero"),
        (RECURS, r"line 2: launch files include each other endlessly"),
        (NOTHING, r"broken.launch.py.* does not contain the required function"),
        (EXITS, r"line 2: SystemExit: no robot today"),
    ],
)
@pytest.mark.parametrize("included", [False, True])
def test_a_failing_launch_file_gives_one_message_and_stops_nothing_else(bench, waiting_node, text, message, included):
    path = bench.folder / "broken.launch.py"
    path.write_text(text)
    asked = bench.file(f"[IncludeLaunchDescription({str(path)!r})]", "asked.launch.py") if included else str(path)
    answer = bench.launcher.launch(asked, {}).result(TIMEOUT_S)
    assert not answer.ok
    assert re.search(message, answer.text), answer.text
    assert answer.text.startswith(str(path))
    assert "\n" not in answer.text
    bench.until(lambda: bench.info.problem == answer.text, "the message")
    assert bench.process().state is ProcessState.RUNNING


def test_a_missing_package_is_reported(bench):
    answer = bench.run("[LogInfo(msg='x'),\n Node(package='not_there', executable='x')]")
    assert not answer.ok
    assert "system.launch.py, line 9: package 'not_there' not found" in answer.text


@pytest.mark.slow
def test_an_endless_include_is_reported(bench):
    answer = bench.launcher.launch(bench.file("[IncludeLaunchDescription(__file__)]"), {}).result(3 * TIMEOUT_S)
    assert answer.text.endswith("line 8: launch files include each other endlessly")


def test_a_missing_file_is_reported(bench):
    answer = bench.launcher.launch("/nowhere/x.launch.py", {}).result(TIMEOUT_S)
    assert (answer.ok, answer.text) == (False, "/nowhere/x.launch.py: No such file or directory")


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("c.launch.xml", "<launch>\n<nodel/>\n</launch>", "line 2: Unrecognized"),
        ("b.launch.xml", "<launch>\n<node>\n</launch>", "line 3: mismatched tag"),
        ("b.launch.yaml", "launch:\n- {a: b\n- c", "line 3: expected"),
    ],
)
def test_xml_and_yaml_launch_files_run(bench, name, text, message):
    path = bench.folder / name
    path.write_text(text)
    assert message in bench.launcher.launch(str(path), {}).result(TIMEOUT_S).text
    with pytest.raises(ValueError, match=message):
        bench.launcher.arguments(str(path))


def test_arguments_are_described_for_a_form(bench):
    path = bench.file(
        "[DeclareLaunchArgument('must', description='needed'), DeclareLaunchArgument('size', default_value='1'),"
        " DeclareLaunchArgument('same', default_value=LaunchConfiguration('size')),"
        " DeclareLaunchArgument('lost', default_value=LaunchConfiguration('nowhere')),"
        " DeclareLaunchArgument('mode', default_value='b', choices=['a', 'b'], description='Which')]"
    )
    assert bench.launcher.arguments(path) == [
        LaunchArgument("must", "needed"),
        LaunchArgument("size", "", "1"),
        LaunchArgument("same", "", "1"),
        LaunchArgument("lost", "", "LaunchConfig('nowhere')"),
        LaunchArgument("mode", "Which.", "b", ("a", "b")),
    ]
    assert bench.launcher.files() == (path,)


def test_arguments_reach_the_launch(bench):
    answer = bench.run("[DeclareLaunchArgument('must'), Node(executable=LaunchConfiguration('must'))]")
    assert "must" in answer.text and not answer.ok
    path = bench.program(WAITS)
    assert bench.run("[DeclareLaunchArgument('must'), Node(executable=LaunchConfiguration('must'))]", must=path).ok


def test_a_launch_that_shuts_itself_down_ends_its_processes(bench):
    ends, waits = bench.program(ENDS, "ends.py"), bench.program(WAITS, "waits.py")
    bench.run(f"[Node(executable={waits!r}), Node(executable={ends!r}, on_exit=Shutdown(reason='enough'))]")
    bench.until(lambda: bench.process("waits").exit_code is not None, "the end of the other")
    assert "system.launch.py ends: enough" in bench.texts()
    assert bench.process("waits").state is ProcessState.EXITED
    assert bench.do("start", bench.process("waits")).ok


def test_cpu_usage_of_a_process_is_shown(bench, waiting_node, monkeypatch):
    from bot_console.tui.console.launch import vitals as process_vitals

    monkeypatch.setattr(process_vitals, "CPU_POLL_S", 0.01)
    bench.until(lambda: bench.process().cpu is not None, "its processor share")


def test_process_that_computes_without_pause_is_reported_once(bench, waiting_node, monkeypatch):
    from bot_console.tui.console.launch import launcher
    from bot_console.tui.console.launch import vitals as process_vitals

    monkeypatch.setattr(process_vitals, "CPU_POLL_S", 1e-6)
    monkeypatch.setattr(process_vitals, "BUSY_SHARE", 0.0)  # Even a process that waits counts as computing.
    monkeypatch.setattr(launcher, "BUSY_S", 0.1)
    reports = lambda: [each.text for each in bench.info.timeline if "computing" in each.text]  # noqa: E731
    bench.until(reports, "its figures in the timeline")
    assert reports() == [f"{bench.process().label} has been computing for 0.1 s without a pause"]


def test_bundled_node_that_survives_being_killed_is_reported(bench, monkeypatch):
    stop = threading.Event()

    def compute():
        while not stop.is_set():
            sum(range(1000))

    def survive():
        print("up", flush=True)
        while not stop.is_set():
            with suppress(BaseException):
                compute()

    module = import_module("bot_console_demos.demo_nodes.talker")
    main = module.main_cpp
    monkeypatch.setattr(module, "main_cpp", survive)
    try:
        bench.run("[Node(package='demo_nodes_cpp', executable='talker')]")
        bench.until(lambda: any("up" in text for _, _, text in bench.printed), "its first line")
        assert bench.do("kill", bench.process()).ok
        assert bench.process().exit_code == -9
        bench.until(lambda: bench.process().state is ProcessState.ABANDONED, "the notice")
        assert f"It hangs in {__file__}:" in bench.process().problem
        assert "is abandoned" in bench.texts()[-1]
        monkeypatch.setattr(module, "main_cpp", main)
        assert bench.do("start", bench.process()).ok
        assert bench.process().state is ProcessState.RUNNING
    finally:
        stop.set()


def test_closing_ends_all_processes(bench, waiting_node):
    bench.launcher.close()
    bench.launcher.close()
    assert bench.process().state is ProcessState.EXITED
    for answer in (bench.launcher.start(waiting_node.key), bench.launcher.launch("x", {})):
        assert answer.result(TIMEOUT_S).text == "the console is closing"


def test_closing_kills_processes_that_do_not_end_in_time(bench):
    path = bench.program(DEAF)
    bench.run(f"[ExecuteProcess(cmd=['python3', '-u', {path!r}])]")
    bench.until(lambda: any("up" in text for _, _, text in bench.printed), "its first line")
    bench.launcher.close(timeout_s=0.0)
    assert bench.process().exit_code == -9


def test_a_missing_package_is_shown_as_missing_and_the_launch_goes_on(bench):
    path = bench.program(WAITS, "waits.py")
    nodes = f"[Node(package='nowhere_cpp', executable='driver', name='d'), Node(executable={path!r}, name='bob')]"
    assert bench.run(nodes, allow_missing="true").ok
    bench.until(lambda: len(bench.info.processes) == 2, "both")
    missing, running = sorted(bench.info.processes, key=lambda each: each.state.value)
    assert (missing.label, missing.state, missing.group) == (
        "nowhere_cpp/driver",
        ProcessState.MISSING,
        ("system.launch.py",),
    )
    assert "package 'nowhere_cpp' not found" in missing.problem and "bot-console compiles nothing" in missing.problem
    assert running.state is ProcessState.RUNNING
    refused = bench.do("start", missing)
    assert not refused.ok and "nowhere_cpp/driver is not available here" in refused.text


def test_a_missing_package_ends_the_launch_by_default(bench):
    outcome = bench.run("[Node(package='nowhere_cpp', executable='driver', name='d')]")
    assert not outcome.ok and "nowhere_cpp" in outcome.text


def test_a_process_that_fails_is_restarted_as_the_settings_say_until_that_is_given_up(supervising_bench):
    path = supervising_bench.program(FAILS)
    supervising_bench.run(f"[Node(executable={path!r})]")
    supervising_bench.until(lambda: "given up" in supervising_bench.process().problem, "the end of the attempts")
    assert supervising_bench.process().restarts == 2 and supervising_bench.process().state is ProcessState.CRASHED
    assert "the fault" in supervising_bench.process().problem


def test_a_process_whose_failure_ends_its_launch_is_not_restarted(supervising_bench):
    path = supervising_bench.program(FAILS)
    supervising_bench.run(f"[Node(executable={path!r}, on_exit=Shutdown(reason='over'))]")
    supervising_bench.until(lambda: any("has ended" in each for each in supervising_bench.texts()), "the end")
    assert supervising_bench.process().restarts == 0 and "restarts" not in supervising_bench.process().problem


def test_a_person_decides_for_one_process(bench):
    path = bench.program(WAITS, "waits.py")
    bench.run(f"[Node(executable={path!r})]")
    bench.until(lambda: any(text == "up" for _, _, text in bench.printed), "its first line")
    assert not bench.process().restart_policy
    assert bench.do("restart_on_failure", bench.process()).ok
    assert bench.process().restart_policy.startswith("on failure")
    assert bench.do("leave_ended", bench.process()).ok and not bench.process().restart_policy
