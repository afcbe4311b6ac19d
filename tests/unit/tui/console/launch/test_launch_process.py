"""The state machine of one launched process, without launch."""

import pytest
from bot_console.tui.console.launch.process import ENDED, LaunchedProcess, Order
from bot_console.tui.console.launch.restart_policy import STEADY_S, RestartPolicy
from bot_console.tui.console.model import ProcessState, Program
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

VERBS = ("start", "stop", "kill", "restart")


class Clock:
    """Seconds, stepped by the test."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def running():
    process = LaunchedProcess("key", "node-1")
    process.started("node-1", 7)
    return process


def test_a_process_begins_in_the_starting_state():
    process = LaunchedProcess("key", "node-1", ("a.launch.py",))
    assert (process.info.state, process.info.group) == (ProcessState.STARTING, ("a.launch.py",))


@pytest.mark.parametrize(
    ("code", "state"),
    [(0, ProcessState.EXITED), (1, ProcessState.CRASHED), (-2, ProcessState.CRASHED), (-9, ProcessState.CRASHED)],
)
def test_exit_code_decides_the_state_after_an_unrequested_end(code, state):
    process = running()
    assert process.exited(code, respawns=False) is Order.NOTHING
    assert (process.info.state, process.info.exit_code, bool(process.info.problem)) == (state, code, code != 0)


@pytest.mark.parametrize(
    ("code", "state"),
    [(0, ProcessState.EXITED), (-2, ProcessState.EXITED), (-15, ProcessState.EXITED), (1, ProcessState.CRASHED)],
)
def test_a_stop_is_answered_when_the_process_has_ended(code, state):
    process = running()
    order, answer = process.want("stop")
    assert (order, process.info.state, answer.done()) == (Order.SHUT_DOWN, ProcessState.STOPPING, False)
    process.exited(code, respawns=False)
    assert (process.info.state, answer.result().ok) == (state, True)


def test_restart_starts_after_the_end_and_answers_when_running():
    process = running()
    order, answer = process.want("restart")
    assert order is Order.SHUT_DOWN
    assert process.exited(0, respawns=False) is Order.START
    assert (process.info.state, answer.done()) == (ProcessState.STARTING, False)
    process.started("node-2", 8)
    assert (process.info.label, process.info.restarts, answer.result().ok) == ("node-2", 1, True)


def test_a_stop_requested_before_it_runs_takes_effect_as_soon_as_it_does():
    process = LaunchedProcess("key", "node-1")
    order, answer = process.want("stop")
    assert order is Order.SHUT_DOWN
    assert process.started("node-1", 7) is Order.SHUT_DOWN
    process.exited(-2, respawns=False)
    assert answer.result().ok


def test_a_failed_start_is_answered_with_the_reason():
    process = running()
    process.exited(0, respawns=False)
    order, answer = process.want("start")
    assert order is Order.START
    process.over("no such file")
    assert (process.info.state, process.info.problem) == (ProcessState.CRASHED, "no such file")
    assert (answer.result().ok, answer.result().text) == (False, "node-1: no such file")


def test_end_of_the_action_before_the_exit_leaves_the_process_running():
    process = running()
    assert process.over() is Order.NOTHING
    assert process.info.state is ProcessState.RUNNING
    process.exited(0, respawns=False)
    assert process.info.state is ProcessState.EXITED


class ProcessLife(RuleBasedStateMachine):
    """Any order of requests and events: each request is answered in the end, and the displayed state is correct."""

    def __init__(self):
        super().__init__()
        self.process = LaunchedProcess("key", "node-1")
        self.due = True
        self.killed = False
        self.reported = False
        self.answers = []

    def obey(self, order):
        self.due |= order is Order.START
        self.reported |= order in (Order.SHUT_DOWN, Order.KILL)

    @rule(verb=st.sampled_from(VERBS))
    def want(self, verb):
        order, answer = self.process.want(verb)
        self.answers.append(answer)
        self.obey(order)

    @precondition(lambda self: self.due and not self.process.alive)
    @rule(works=st.booleans())
    def launch_starts(self, works):
        self.due, self.reported = False, False
        self.obey(self.process.started("node-1", 7) if works else self.process.over("why"))

    @precondition(lambda self: self.process.alive)
    @rule(code=st.sampled_from([0, 1, -2, -9, -15]), respawns=st.booleans())
    def ends(self, code, respawns):
        respawns = respawns and not self.reported
        self.due = respawns
        order = self.process.exited(code, respawns)
        self.obey(order)
        if not respawns and order is not Order.START:
            self.obey(self.process.over())

    @invariant()
    def the_state_is_true(self):
        state = self.process.info.state
        assert not (self.process.alive and (state in ENDED or state is ProcessState.STARTING))
        assert (self.process.info.pid is not None) == self.process.alive
        if state in ENDED:
            assert all(answer.done() for answer in self.answers)
            assert not self.due


TestLife = ProcessLife.TestCase
TestLife.settings = settings(stateful_step_count=20, deadline=None)


@given(st.lists(st.sampled_from(VERBS), max_size=6))
def test_requests_while_running_lead_to_a_single_end(verbs):
    process = running()
    answers = [process.want(verb)[1] for verb in verbs]
    for _ in range(3):
        if process.alive:
            if process.info.state is ProcessState.RUNNING:
                process.exit_requested()
            if process.exited(0, respawns=False) is Order.START:
                process.started("node-1", 8)
    assert all(answer.done() for answer in answers)


def test_a_stop_just_after_a_crash_is_done_when_launch_gives_up_the_respawn():
    process = LaunchedProcess("k", "n-1")
    process.started("n-1", 1)
    order, stop = process.want("stop")
    assert order is Order.SHUT_DOWN
    assert process.exited(1, respawns=True) is Order.NOTHING
    assert not stop.done() and process.info.state is ProcessState.STOPPING
    process.over()
    assert stop.result(0).ok and process.info.state is ProcessState.CRASHED


def test_placeholder_of_a_composed_node_is_not_shown_as_a_process_id():
    process = LaunchedProcess("key", "node-1")
    process.started("node-1", (1 << 22) + 1)
    assert process.info.pid is None and process.info.state is ProcessState.RUNNING
    process.started("node-1", 1 << 22)
    assert process.info.pid == 1 << 22


def supervised_process(clock, *, attempts=3, delay=1.0, max_delay=3.0, program=None):
    """A running process that is restarted on failure."""
    policy = RestartPolicy(attempts, delay, max_delay)
    process = LaunchedProcess("key", "node-1", program=program, policy=policy, clock=clock)
    process.started("node-1", 7)
    assert process.want("restart_on_failure")[1].result().ok
    return process


def fail(process):
    """Start the process if necessary, and let it end with an error."""
    if not process.alive:
        process.started("node-1", 8)
    assert process.exited(1, respawns=False) is Order.NOTHING


def test_a_failed_process_is_restarted_after_growing_delays_until_the_attempts_are_used_up():
    clock = Clock()
    process = supervised_process(clock)
    assert process.info.restart_policy == "on failure, up to 3 times, after 1 to 3 s"
    for number, delay in enumerate((1.0, 2.0, 3.0), 1):
        fail(process)
        assert process.info.state is ProcessState.CRASHED
        assert process.info.problem.startswith(f"restarts after {delay:g} s ({number} of 3): ended with exit code 1")
        clock.now += delay - 0.01
        assert process.due() is Order.NOTHING
        clock.now += 0.02
        assert process.due() is Order.START and process.info.state is ProcessState.STARTING
        assert process.due() is Order.NOTHING, "once"
    fail(process)
    clock.now += 100
    assert process.due() is Order.NOTHING and "given up after it was restarted 3 times" in process.info.problem


def test_a_process_that_ran_long_enough_has_all_attempts_again():
    clock = Clock()
    process = supervised_process(clock, attempts=1)
    fail(process)
    clock.now += 1
    assert process.due() is Order.START
    process.started("node-1", 8)
    clock.now += STEADY_S
    fail(process)
    clock.now += 1
    assert process.due() is Order.START


@pytest.mark.parametrize("code", [0, -2])
def test_only_failures_are_followed_by_a_restart(code):
    clock = Clock()
    process = supervised_process(clock)
    if code:
        process.want("stop")
    process.exited(code, respawns=False)
    clock.now += 100
    assert process.due() is Order.NOTHING and process.info.state is ProcessState.EXITED


@pytest.mark.parametrize("verb", ["stop", "kill", "leave_ended"])
def test_a_pending_restart_can_be_called_off(verb):
    clock = Clock()
    process = supervised_process(clock)
    fail(process)
    order, answer = process.want(verb)
    assert order is Order.NOTHING and answer.result().ok
    clock.now += 100
    assert process.due() is Order.NOTHING and "restarts" not in process.info.problem
    assert bool(process.info.restart_policy) is (verb != "leave_ended")


def test_a_start_by_hand_replaces_the_pending_one():
    clock = Clock()
    process = supervised_process(clock)
    fail(process)
    assert process.want("start")[0] is Order.START
    clock.now += 100
    assert process.due() is Order.NOTHING


def test_processes_respawned_by_a_launch_file_are_left_to_it():
    process = LaunchedProcess("key", "node-1", program=Program(("x",), respawn=True), restarts=True)
    answer = process.want("restart_on_failure")[1].result()
    assert not answer.ok and "respawn" in answer.text and not process.info.restart_policy


def test_the_policy_of_the_settings_applies_from_the_beginning():
    process = LaunchedProcess("key", "node-1", restarts=True)
    assert process.info.restart_policy == RestartPolicy().text
    assert RestartPolicy(2000, 1.0, 5.0).delay_before(2000) == 5.0
