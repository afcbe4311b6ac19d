"""Verbs in any order, in quick succession: each one is answered, and the last one decides."""

import itertools
import threading

import pytest
from bot_console.tui.console.launch import launcher
from bot_console.tui.console.launch.process import ENDED
from bot_console.tui.console.model import ProcessState
from domains import unused_domain
from launcher_bench import FAILS, TIMEOUT_S, WAITS, Bench, Spawned

VERBS = ("start", "stop", "restart", "kill")


class GatedBench(Bench):
    """A bench whose launches begin only while the gate is open."""

    def __init__(self, folder):
        self.gate = threading.Event()
        self.gate.set()
        super().__init__(folder)
        self.launcher._spawn = lambda target, file: Spawned(lambda: self._pass(target), self.launch_output)

    def _pass(self, target):
        assert self.gate.wait(TIMEOUT_S)
        target()


@pytest.fixture
def bench(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    made = GatedBench(tmp_path)
    yield made
    made.gate.set()
    made.launcher.close()


@pytest.fixture
def three(bench):
    """The keys of three waiting nodes of one launch."""
    path = bench.program(WAITS)
    nodes = ", ".join(f"Node(executable={path!r}, name='n{number}')" for number in range(3))
    assert bench.run(f"[{nodes}]").ok
    bench.until(lambda: states(bench) == [ProcessState.RUNNING] * 3, "three nodes")
    return [each.key for each in bench.info.processes]


def states(bench):
    return [each.state for each in bench.info.processes]


def ask(bench, verb, keys):
    return [getattr(bench.launcher, verb)(key) for key in keys]


def answers(futures):
    return [each.result(TIMEOUT_S) for each in futures]


def has_ended(bench):
    """Whether the bench's launch is over, so that the next start needs another one."""
    return not bench.launcher._runs


def test_a_stopped_launch_starts_again_with_all_its_processes(bench, three):
    answers(ask(bench, "stop", three))
    bench.until(lambda: has_ended(bench), "the end of the launch")
    bench.gate.clear()  # all three are requested before the launch that starts them runs
    starts = ask(bench, "start", three)
    bench.gate.set()
    assert all(each.ok for each in answers(starts))
    assert states(bench) == [ProcessState.RUNNING] * 3


def test_a_stop_before_the_launch_runs_again_keeps_that_process_ended(bench, three):
    answers(ask(bench, "stop", three))
    bench.until(lambda: has_ended(bench), "the end of the launch")
    bench.gate.clear()
    starts, stops = ask(bench, "start", three), ask(bench, "stop", three[1:])
    again = ask(bench, "start", three[2:])
    bench.gate.set()
    assert all(each.ok for each in answers([starts[0], *stops, *again]))
    assert [each.ok for each in answers(starts)][1:2] == [False]
    assert states(bench) == [ProcessState.RUNNING, ProcessState.EXITED, ProcessState.RUNNING]


def test_a_launch_that_cannot_begin_again_reports_that_for_each_process(bench, three, monkeypatch):
    import launch

    answers(ask(bench, "stop", three))
    bench.until(lambda: has_ended(bench), "the end of the launch")

    def refuse(**options):
        raise OSError("no room for a log")

    with monkeypatch.context() as broken:
        broken.setattr(launch, "LaunchService", refuse)
        reported = answers(ask(bench, "start", three))
    assert [each.ok for each in reported] == [False] * 3
    assert all("no room for a log" in each.text for each in reported)
    assert all(each.ok for each in answers(ask(bench, "start", three)))


def test_closing_before_the_launch_runs_again_starts_nothing(bench, three, monkeypatch):
    monkeypatch.setattr(launcher, "KILLED_TIMEOUT_S", 0.0)
    answers(ask(bench, "stop", three))
    bench.until(lambda: has_ended(bench), "the end of the launch")
    bench.gate.clear()
    starts = ask(bench, "start", three)
    bench.launcher.close(timeout_s=0.0)
    bench.gate.set()
    assert not any(each.ok for each in answers(starts))
    assert all(each in ENDED for each in states(bench))


@pytest.mark.parametrize("length", [1, 2, pytest.param(3, marks=pytest.mark.soak)])
def test_verbs_in_quick_succession_are_all_answered(bench, three, length):
    for verbs in itertools.product(VERBS, repeat=length):
        answers([future for verb in verbs for future in ask(bench, verb, three)])
        running = verbs[-1] in ("start", "restart")
        bench.until(
            lambda running=running: all(
                each is ProcessState.RUNNING if running else each in ENDED for each in states(bench)
            ),
            f"the end of {verbs}",
        )


@pytest.mark.parametrize("delay", [0.0, 600.0])
def test_a_respawning_process_that_crashes_at_start_can_be_stopped_and_started(bench, delay):
    path = bench.program(FAILS)
    bench.run(f"[Node(executable={path!r}, respawn=True, respawn_delay={delay})]")
    bench.until(lambda: bench.process().exit_code == 1, "the crash")
    key = bench.process().key
    for _ in range(2):
        answers(ask(bench, "stop", [key]))
        bench.until(lambda: states(bench)[0] in ENDED, "the end")
        bench.program(WAITS)
        assert answers(ask(bench, "start", [key]))[0].ok
        bench.until(lambda: states(bench) == [ProcessState.RUNNING], "the start")


def test_a_launch_that_shuts_itself_down_ends_a_respawning_process_without_an_error(bench):
    waits, ends = bench.program(WAITS, "waits.py"), bench.program("pass\n", "ends.py")
    bench.run(
        f"[Node(executable={waits!r}, respawn=True),"
        f" ExecuteProcess(cmd=['python3', {ends!r}], on_exit=Shutdown(reason='enough'))]"
    )
    bench.until(lambda: has_ended(bench), "the end of the launch")
    assert bench.process("waits").state is ProcessState.EXITED, bench.process("waits")
    assert answers(ask(bench, "start", [bench.process("waits").key]))[0].ok
