"""Programs in the style of the public tutorials: what they print, and when."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from systems import Program, System, system

PROGRAMS = Path(__file__).parent / "programs"
START = 1_700_000_000


def start(running: System, name: str, *words: str) -> Program:
    """Start a program from the folder beside this file."""
    return running.python(str(PROGRAMS / f"{name}.py"), *words)


def message(program: Program) -> list[str]:
    """The messages that a program logged."""
    return [text for _, text in when(program)]


def when(program: Program) -> list[tuple[float, str]]:
    """The messages that a program logged, with the time (s) since the start of the run."""
    lines = re.findall(r"\[(?:INFO|WARN)\] \[(\d+)\.(\d)\d+\] \[[\w.]+\]: (.*)", program.stderr)
    return [(int(seconds) - START + int(tenths) / 10, text) for seconds, tenths, text in lines]


def test_listener_receives_messages_of_talker() -> None:
    with system() as running:
        talker, listener = start(running, "talker"), start(running, "listener")
        running.run(3.5)
        for program in (talker, listener):
            program.process.interrupt()
            running.finish(program)
    assert when(talker) == [(number + 1.0, f'Publishing: "Hello World: {number}"') for number in range(3)]
    assert when(listener) == [(number + 1.0, f"I heard: [Hello World: {number}]") for number in range(3)]
    assert (talker.exit, listener.exit) == (0, 0)


def test_command_line_remaps_topic_and_node() -> None:
    with system() as running:
        start(running, "talker", "--ros-args", "-r", "chatter:=news", "-r", "__node:=speaker")
        deaf, listener = (
            start(running, "listener"),
            start(running, "listener", "--ros-args", "-r", "__ns:=/there", "-r", "chatter:=/news"),
        )
        running.run(1.5)
        nodes = running.ask("node", "list").stdout.split()
    assert message(deaf) == []
    assert message(listener) == ["I heard: [Hello World: 0]"]
    assert nodes == ["/listener", "/speaker", "/there/listener"]


@pytest.mark.parametrize("way", ["async", "sync"])
def test_client_gets_response_of_service(way: str) -> None:
    with system() as running:
        server = start(running, "add_server")
        running.run(0.1)
        client = running.finish(start(running, "add_client", way, "2", "3"))
    assert message(client) == ["Result of add_two_ints: for 2 + 3 = 5"]
    assert message(server) == ["Incoming request a: 2 b: 3"]
    assert client.exit == 0


def test_client_waits_for_its_service() -> None:
    with system() as running:
        client = start(running, "add_client", "async", "1", "1")
        running.run(2.5)
        start(running, "add_server")
        running.finish(client)
    assert when(client) == [
        (1.0, "service not available, waiting again..."),
        (2.0, "service not available, waiting again..."),
        (2.5, "Result of add_two_ints: for 1 + 1 = 2"),
    ]


def test_client_can_be_awaited_in_a_callback() -> None:
    with system() as running:
        start(running, "add_server")
        client = running.finish(start(running, "client_in_callback"))
    assert when(client) == [(0.5, "0 + 40 = 40"), (1.0, "1 + 40 = 41"), (1.5, "2 + 40 = 42")]
    assert client.exit == 0


def test_rate_and_timer_periods_are_kept() -> None:
    with system() as running:
        program = running.finish(start(running, "rates"))
    assert when(program) == [(0.0, "tick 0"), (0.5, "tick 1"), (1.0, "tick 2"), (1.5, "tick 3")]
    assert program.exit == 0


def test_parameter_event_handler_reports_changes() -> None:
    with system() as running:
        start(running, "tunable")
        watcher = start(running, "parameter_watcher")
        running.run(0.1)
        running.ask("param", "set", "/robot", "speed", "2.5")
        running.ask("param", "set", "/robot", "speed", "99.0")
        running.ask("param", "set", "/node_with_parameters", "an_int_param", "43")
        running.run(0.1)
    assert message(watcher) == [
        "Received an update to remote parameter: 2.5",
        "Received an update to parameter: an_int_param: 43",
    ]


@pytest.mark.parametrize(
    ("groups", "lines"),
    [
        ("one", [(1.0, "a begins"), (1.4, "a ends"), (1.4, "b begins"), (1.8, "b ends")]),
        ("two", [(1.0, "a begins"), (1.0, "b begins"), (1.4, "a ends"), (1.4, "b ends")]),
        ("reentrant", [(1.0, "a begins"), (1.0, "b begins"), (1.4, "a ends"), (1.4, "b ends")]),
    ],
)
def test_callback_groups_allow_or_prevent_overlap(groups: str, lines: list[tuple[float, str]]) -> None:
    with system() as running:
        program = start(running, "callback_groups", groups)
        running.run(1.9)
    assert sorted(when(program)) == lines


@pytest.mark.parametrize(
    ("offered", "requested", "heard"),
    [
        ("reliable transient_local", "reliable transient_local", ["map 2", "map 3", "map 4"]),
        ("reliable transient_local", "best_effort transient_local", ["map 2", "map 3", "map 4"]),
        ("reliable transient_local", "reliable volatile", []),
        ("reliable volatile", "reliable volatile", []),
    ],
)
def test_late_joiner_receives_latched_message(offered: str, requested: str, heard: list[str]) -> None:
    with system() as running:
        start(running, "latched", "talker", *offered.split())
        running.run(1.0)
        late = start(running, "latched", "listener", *requested.split())
        running.run(1.0)
    assert message(late) == heard


@pytest.mark.parametrize(
    ("offered", "requested", "policy"),
    [
        ("best_effort volatile", "reliable volatile", "RELIABILITY"),
        ("reliable volatile", "reliable transient_local", "DURABILITY"),
    ],
)
def test_incompatible_qos_is_reported(offered: str, requested: str, policy: str) -> None:
    with system() as running:
        talker = start(running, "latched", "talker", *offered.split())
        late = start(running, "latched", "listener", *requested.split())
        running.run(1.0)
    assert message(talker) == [
        "New subscription discovered on topic 'map', requesting incompatible QoS. "
        f"No messages will be sent to it. Last incompatible policy: {policy}"
    ]
    assert message(late) == [
        "New publisher discovered on topic 'map', offering incompatible QoS. "
        f"No messages will be received from it. Last incompatible policy: {policy}"
    ]


def test_composed_nodes_run_in_one_process() -> None:
    with system() as running:
        program = start(running, "composed")
        running.run(2.5)
        nodes = running.ask("node", "list").stdout.split()
        program.process.interrupt()
        running.finish(program)
    assert nodes == ["/listener", "/talker"]
    assert message(program) == [
        'Publishing: "Hello World: 0"',
        "I heard: [Hello World: 0]",
        'Publishing: "Hello World: 1"',
        "I heard: [Hello World: 1]",
    ]


def test_guard_condition_wakes_the_executor() -> None:
    with system() as running:
        program = running.finish(start(running, "guarded"))
    assert when(program) == [(0.5, "nothing yet"), (1.0, "guard condition callback called")]


def test_wait_for_message_returns_message_or_times_out() -> None:
    with system() as running:
        start(running, "talker")
        program = running.finish(start(running, "waits_for_message"))
    assert when(program) == [(1.5, "(False, None)"), (2.0, "True: Hello World: 1")]


@pytest.mark.parametrize(("factor", "spoken"), [("1.0", 3), ("10.0", 39), ("0.1", 0)])
def test_simulated_clock_drives_timers(factor: str, spoken: int) -> None:
    with system() as running:
        start(running, "sim_clock", factor)
        talker = start(running, "talker", "--ros-args", "-p", "use_sim_time:=true")
        running.run(4.05)
    assert len(message(talker)) == pytest.approx(spoken, abs=1)


def test_two_executors_end_on_shutdown_in_a_callback() -> None:
    with system() as running:
        program = running.finish(start(running, "spins_in_threads"))
    assert message(program) == ["got [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]"]
    assert (program.stdout, program.exit) == ("joined\n", 0)


RAISES = """
import rclpy
rclpy.init()
node = rclpy.create_node("n")
node.create_timer(1.0, lambda: {}["x"])
rclpy.spin(node)
"""

SHUTS_DOWN = """
import rclpy
rclpy.init()
node = rclpy.create_node("n")
try:
    rclpy.spin(node)
except KeyboardInterrupt:
    print("interrupted")
finally:
    rclpy.shutdown()
"""


def test_exception_in_a_callback_ends_the_program() -> None:
    with system() as running:
        program = running.finish(running.python("-c", RAISES))
    assert program.exit == 1
    assert "KeyError: 'x'" in program.stderr


def test_shutdown_after_an_interrupt_is_refused_as_upstream_does() -> None:
    with system() as running:
        program = running.finish(running.python("-c", SHUTS_DOWN), stop_after=1.0)
    assert program.stdout == "interrupted\n"
    assert "failed to shutdown: rcl_shutdown already called on the given context" in program.stderr
    assert program.exit == 1
