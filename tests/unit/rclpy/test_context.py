"""init, shutdown and contexts, and what nodes and entities can still do afterwards."""

from __future__ import annotations

import runpy
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
import rclpy
import rclpy.utilities
from bot_console.runtime.process.crashes import explanation
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError, UnknownROSArgsError
from rclpy.context import Context
from rclpy.exceptions import NotInitializedException
from rclpy.executors import ExternalShutdownException
from rclpy.signals import SignalHandlerOptions, get_current_signal_handlers_options
from rclpy.task import Future
from std_msgs.msg import Int32


@pytest.fixture
def default() -> Iterator[None]:
    """The default context, shut down after the test."""
    yield
    rclpy.try_shutdown()


def test_ok_follows_the_default_context(default: None) -> None:
    states = [rclpy.ok()]
    rclpy.init(args=[])
    states.append(rclpy.ok())
    rclpy.shutdown()
    assert [*states, rclpy.ok()] == [False, True, False]


def test_second_init_or_shutdown_is_an_error(default: None) -> None:
    rclpy.init(args=[])
    with pytest.raises(RuntimeError, match=r"^Context.init\(\) must only be called once$"):
        rclpy.init(args=[])
    rclpy.shutdown()
    with pytest.raises(RuntimeError, match=r"^Context must be initialized before it can be shutdown$"):
        rclpy.shutdown()
    rclpy.try_shutdown()


def test_init_works_again_after_a_shutdown(default: None) -> None:
    names = []
    for number in range(3):
        rclpy.init(args=[])
        with rclpy.create_node(f"n{number}") as node:
            names.append(node.get_name())
        rclpy.shutdown()
    assert names == ["n0", "n1", "n2"]


def test_init_returns_nothing_as_in_jazzy(default: None, tmp_path: Path) -> None:
    program = tmp_path / "later.py"
    program.write_text("import rclpy\nwith rclpy.init(args=[]):\n    pass\n")
    with pytest.raises((TypeError, AttributeError)) as refused:
        runpy.run_path(str(program))
    assert f"{program}:2: rclpy.init() returns nothing in ROS 2 Jazzy" in (explanation(refused.value) or "")


def test_context_is_shut_down_at_the_end_of_its_with_block() -> None:
    with Context() as context:
        assert context.ok()
    assert not context.ok()


def test_separate_context_has_its_own_state_and_domain(default: None) -> None:
    context = Context()
    assert not context.ok()
    rclpy.init(args=[], context=context, domain_id=77)
    assert (context.ok(), rclpy.ok(), context.get_domain_id()) == (True, False, 77)
    rclpy.shutdown(context=context)
    with pytest.raises(RCLError, match="failed to shutdown: rcl_shutdown already called on the given context"):
        rclpy.shutdown(context=context)
    with pytest.raises(RuntimeError, match="must only be called once"):
        context.init([])


def test_domain_id_may_be_a_numpy_integer() -> None:
    context, number = Context(), cast(Any, np.uint8(77))
    context.init([], domain_id=number)
    assert type(context.get_domain_id()) is int and context.get_domain_id() == 77
    context.shutdown()


def test_domain_id_beyond_64_bits_is_rejected() -> None:
    with pytest.raises(TypeError):
        Context().init([], domain_id=2**64)


def test_largest_domain_id_means_the_one_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", "0x4D")
    context = Context()
    context.init([], domain_id=2**64 - 1)
    assert context.get_domain_id() == 77
    context.shutdown()


def test_environment_whose_domain_id_is_not_a_number_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", "abc")
    with pytest.raises(RCLError, match=r"^failed to initialize rcl: ROS_DOMAIN_ID is not an integral number$"):
        Context().init([])


def test_negative_domain_id_is_rejected() -> None:
    with pytest.raises(RuntimeError, match=r"Domain id \(-5\) should not be lower than zero."):
        Context().init([], domain_id=-5)


@pytest.mark.parametrize(("value", "warns"), [("OFF", False), ("SUBNET", False), ("", False), ("off", True)])
def test_invalid_discovery_range_is_warned_about(
    value: str, warns: bool, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", value)
    with Context():
        pass
    message = "[rcl]: Invalid value 'off' specified for 'ROS_AUTOMATIC_DISCOVERY_RANGE', assuming localhost only"
    assert (message in capfd.readouterr().err) == warns


@pytest.mark.parametrize(
    ("words", "kind", "text"),
    [
        (["--ros-args", "--foo"], UnknownROSArgsError, "['--foo']"),
        (["--ros-args", "-r", "a"], RCLError, "failed to initialize rcl: Couldn't parse remap rule: '-r a'. "
         "Error: Expected lexeme type (19) not found, search ended at index 1"),
        (["--ros-args", "-r", "__foo:=bar"], RCLError, "failed to initialize rcl: Couldn't parse remap rule: "
         "'-r __foo:=bar'. Error: Expecting token or wildcard"),
    ],
)  # fmt: skip
def test_invalid_arguments_are_rejected(words: list[str], kind: type[Exception], text: str) -> None:
    with pytest.raises(kind) as caught:
        Context().init(words)
    assert str(caught.value) == text


def test_shutdown_callbacks_run_in_order_and_once(ros: Any) -> None:
    context, got = ros.init(), []
    for name in "ab":
        context.on_shutdown(lambda name=name: got.append(name))
    context.shutdown()
    context.on_shutdown(lambda: got.append("late"))
    assert got == ["a", "b", "late"]
    with pytest.raises(TypeError):
        context.on_shutdown("x")


def test_shutdown_by_signal_skips_the_callbacks(ros: Any) -> None:
    context, got = ros.init(), []
    context.on_shutdown(lambda: got.append("called"))
    executor = ros.node().executor
    context.shut_down_by_signal()
    context.try_shutdown()
    assert (context.ok(), got) == (False, [])
    with pytest.raises(ExternalShutdownException):
        executor.spin_once()


def test_signal_during_init_ends_the_context(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rclpy.context.remember_context", Context.shut_down_by_signal)
    context = Context()
    context.init([])
    assert context.ended_by_signal and not context.ok()


def test_shutdown_callback_registered_before_init_is_called() -> None:
    context, got = Context(), []
    context.on_shutdown(lambda: got.append("called"))
    context.init([])
    context.shutdown()
    assert got == ["called"]


@pytest.mark.parametrize(("signal", "outcome"), [(False, None), (True, ExternalShutdownException)])
def test_spin_returns_silently_except_after_signals(default: None, signal: bool, outcome: Any) -> None:
    rclpy.init(args=[])
    node, executor = rclpy.create_node("n"), rclpy.get_global_executor()
    end = rclpy.get_default_context().shut_down_by_signal if signal else rclpy.shutdown

    def end_while_it_waits() -> None:
        while not executor._waiting:
            threading.Event().wait(0.001)
        end()

    threading.Thread(target=end_while_it_waits).start()
    with node:
        if outcome is None:
            assert rclpy.spin(node) is None
        else:
            with pytest.raises(outcome):
                rclpy.spin(node)


def test_context_holds_methods_weakly(ros: Any) -> None:
    got = []

    class Listener:
        def hear(self) -> None:
            got.append(1)

    context, listener = ros.init(), Listener()
    context.on_shutdown(listener.hear)
    del listener
    context.shutdown()
    assert got == []


def test_ok_is_false_within_a_shutdown_callback(ros: Any) -> None:
    context, got = ros.init(), []
    context.on_shutdown(lambda: got.append(context.ok()))
    context.shutdown()
    assert got == [False]


def test_nodes_need_an_initialized_context(ros: Any) -> None:
    with pytest.raises(NotInitializedException) as caught:
        rclpy.create_node("n", context=Context())
    assert str(caught.value) == "rclpy.init() has not been called. msg:cannot create node"
    ros.init().shutdown()
    with pytest.raises(NotInitializedException):
        ros.node()


def test_signal_handlers_are_installed_while_initialized(default: None) -> None:
    states = [get_current_signal_handlers_options()]
    rclpy.init(args=[])
    states.append(get_current_signal_handlers_options())
    rclpy.shutdown()
    states.append(get_current_signal_handlers_options())
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.SIGINT)
    states.append(get_current_signal_handlers_options())
    assert [state.name for state in states] == ["NO", "ALL", "NO", "SIGINT"]


def test_destroyed_node_refuses_most_calls(ros: Any) -> None:
    node = ros.node()
    node.declare_parameter("p", 1)
    assert node.destroy_node() is None
    node.destroy_node()
    for use in (
        node.get_name,
        node.get_namespace,
        node.get_fully_qualified_name,
        node.get_node_names,
        lambda: node.create_publisher(Int32, "t", 1),
        lambda: node.set_parameters([rclpy.Parameter("p", value=2)]),
        lambda: node.count_publishers("t"),
        lambda: node.resolve_topic_name("t"),
    ):
        with pytest.raises(InvalidHandle, match="cannot use Destroyable because destruction was requested"):
            use()
    assert node.get_parameter("p").value == 1
    assert node.get_logger().info("still heard")
    assert node.get_clock().now().nanoseconds > 0
    assert [*node.publishers, *node.subscriptions, *node.services, *node.timers] == []


def test_local_calls_still_work_after_shutdown(ros: Any) -> None:
    node = ros.node()
    node.declare_parameter("p", 1)
    ros.context.shutdown()
    assert node.get_parameter("p").value == 1
    assert node.get_name() == "n"
    assert node.get_logger().info("still heard")
    for make in (lambda: node.create_timer(1.0, None), lambda: node.create_guard_condition(None)):
        with pytest.raises(RCLError, match="the given context is not valid, either rcl_init"):
            make()
    node.destroy_node()


@pytest.mark.parametrize("way", ["spin_once", "spin_until_future_complete"])
def test_callback_spinning_its_own_node_leaves_it_in_its_executor(default: None, way: str) -> None:
    rclpy.init(args=[])
    node, calls = rclpy.create_node("n"), []
    answered: Future[None] = Future()
    answered.set_result(None)

    def callback() -> None:
        calls.append(node in rclpy.get_global_executor().get_nodes())
        if way == "spin_once":
            rclpy.spin_once(node, timeout_sec=0)
        else:
            rclpy.spin_until_future_complete(node, answered)
        calls.append(node in rclpy.get_global_executor().get_nodes())
        rclpy.shutdown()

    node.create_timer(0.0, callback)
    with node:
        rclpy.spin(node)
    assert calls == [True, True]


def test_global_executor_ends_with_its_context(default: None) -> None:
    rclpy.init(args=[])
    node = rclpy.create_node("n")
    first = rclpy.get_global_executor()
    assert rclpy.get_global_executor() is first
    node.create_guard_condition(lambda: threading.Thread(target=rclpy.shutdown).start()).trigger()
    with node:
        rclpy.spin(node)
        with pytest.raises(TypeError):
            rclpy.spin_once(node, timeout_sec=0)
    rclpy.init(args=[])
    assert rclpy.get_global_executor() is not first


def test_spin_removes_the_node_afterwards(default: None) -> None:
    rclpy.init(args=[])
    with rclpy.create_node("n") as node:
        rclpy.spin_once(node, timeout_sec=0)
        assert rclpy.get_global_executor().get_nodes() == []
        assert node.executor is rclpy.get_global_executor()


def test_spinning_without_a_node_is_an_error() -> None:
    node: Any = None
    for spin in (rclpy.spin, rclpy.spin_once):
        with pytest.raises(TypeError):
            spin(node)


def test_remove_ros_args_rejects_unknown_ros_arguments() -> None:
    assert rclpy.utilities.remove_ros_args(["p", "--ros-args", "-r", "a:=b", "--", "x"]) == ["p", "x"]
    with pytest.raises(UnknownROSArgsError, match="--nope"):
        rclpy.utilities.remove_ros_args(["p", "--ros-args", "--nope"])


def test_invalid_enclave_is_refused_for_a_context_alone(capfd):
    words = ["p", "--ros-args", "-e", "x"]
    problem = "'context name must be absolute, it must lead with a '/''"
    with pytest.raises(RCLError) as refused:
        rclpy.init(args=words, context=Context())
    assert str(refused.value) == f"failed to initialize rcl: Enclave name is not valid: {problem}. Invalid index: 0"
    assert capfd.readouterr().err == ""
    assert rclpy.utilities.remove_ros_args(words) == ["p"]


def test_refused_parameter_file_gets_an_explanation_at_a_terminal(tmp_path, monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    path = tmp_path / "p.yaml"
    path.write_text("n:\n\tros__parameters:\n")
    with pytest.raises(RCLError) as refused:
        rclpy.init(args=["--ros-args", "--params-file", str(path)], context=Context())
    assert explanation(refused.value) == f"{path}:2: it is indented by a tab, and YAML takes spaces alone"


def test_parameter_before_ros_args_is_reported_at_a_terminal(capfd, monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    context = Context()
    rclpy.init(args=["node", "-p", "speed:=2.5", "file", "--ros-args", "-p", "rate:=1.0"], context=context)
    context.shutdown()
    reported = [line for line in capfd.readouterr().err.splitlines() if "[rcl]" in line]
    assert len(reported) == 1
    assert "'speed:=2.5' is outside of --ros-args" in reported[0] and "--ros-args -p speed:=2.5" in reported[0]
