"""Means of stopping robots without an emergency stop: tried in order, without waiting, and undone by a release."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import pytest
from bot_console.tui.console.model import ConsoleSnapshot, Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.robot.drive_link import HOLD_PERIOD_S, DriveLink
from bot_console.tui.console.robot.robot_model import DriveInfo, WorldInfo
from bot_console.tui.console.robot.stop_link import LATCHED
from bot_console.tui.console.robot.stop_means import means as means_module
from bot_console.tui.console.robot.stop_means.configured import ConfiguredMeans, configured_means
from bot_console.tui.console.robot.stop_means.sequence import NEXT_AFTER_S
from bot_console.tui.widgets.status_bar import status_text
from controller_manager_msgs.srv import SwitchController
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from domains import unused_domain
from geometry_msgs.msg import Twist
from lifecycle_msgs.msg import State
from lifecycle_msgs.srv import ChangeState, GetState
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

TWIST, STATUS = "geometry_msgs/msg/Twist", "diagnostic_msgs/msg/DiagnosticStatus"
LOCK = "/emergency_stop/base"
EVERY_KIND = (
    {"lock": "/e_stop", "state": "/e_stop_active"},
    {"set_bool": "/motors/hold"},
    {"set_bool": "/motors/enable", "hold": False},
    {"trigger": "/base/stop", "release": "/base/clear_stop"},
    {"deactivate": "/base_driver"},
    {"switch": "/controller_manager", "controllers": ["diff", "arm"]},
)


class Robot:
    """A base without our emergency stop, with one or more means of stopping it."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self.calls: list[object] = []
        self.refuses = False
        self.stands = False
        self.velocities: list[float] = []
        node.create_subscription(Twist, "/cmd_vel", lambda message: self.velocities.append(message.linear.x), 10)

    def offer(self, entry: dict[str, Any]) -> None:
        """Offer the interface that an entry of the settings names."""
        add: dict[str, Callable[[], object]] = {
            "lock": self._lock,
            "set_bool": lambda: self.node.create_service(SetBool, entry["set_bool"], self._on_bool(entry)),
            "trigger": lambda: self._trigger(entry),
            "deactivate": self._lifecycle,
            "switch": lambda: self.node.create_service(
                SwitchController, "/controller_manager/switch_controller", self._on_switch
            ),
        }
        add[next(iter(entry))]()

    def _answer(self, stands: bool, call: object, response: Any) -> Any:
        self.calls.append(call)
        done = not self.refuses
        self.stands = stands if done else self.stands
        setattr(response, "ok" if hasattr(response, "ok") else "success", done)
        if hasattr(response, "message"):
            response.message = "" if done else "the brake is stuck"
        return response

    def _lock(self) -> None:
        state = self.node.create_publisher(Bool, "/e_stop_active", 10)

        def locked(message: Bool) -> None:
            self.calls.append(message.data)
            self.stands = message.data and not self.refuses
            state.publish(Bool(data=self.stands))

        self.node.create_subscription(Bool, "/e_stop", locked, 10)

    def _on_bool(self, entry: dict[str, Any]) -> Callable[..., Any]:
        held = entry.get("hold", True)
        return lambda request, response: self._answer(request.data is held, request.data, response)

    def _trigger(self, entry: dict[str, Any]) -> None:
        for service, stands in ((entry["trigger"], True), (entry.get("release"), False)):
            if service:
                self.node.create_service(
                    Trigger, service, lambda _, response, s=stands: self._answer(s, "stop" if s else "clear", response)
                )

    def _lifecycle(self) -> None:
        def change(request: Any, response: Any) -> Any:
            return self._answer(request.transition.id == 4, request.transition.id, response)

        def state(_: Any, response: Any) -> Any:
            response.current_state = State(id=2 if self.stands else 3, label="inactive" if self.stands else "active")
            return response

        self.node.create_service(ChangeState, "/base_driver/change_state", change)
        self.node.create_service(GetState, "/base_driver/get_state", state)

    def _on_switch(self, request: Any, response: Any) -> Any:
        call = (list(request.deactivate_controllers), list(request.activate_controllers))
        return self._answer(bool(request.deactivate_controllers), call, response)


class Bench:
    """A console's link with configured means, and a robot."""

    def __init__(self) -> None:
        self.context = Context()
        self.context.init([], domain_id=unused_domain())
        self.executor = SingleThreadedExecutor(context=self.context)
        self.nodes = [Node(name, context=self.context) for name in ("console", "robot")]
        for each in self.nodes:
            self.executor.add_node(each)
        self.robot = Robot(self.nodes[1])
        self.clock = 100.0
        self.link: DriveLink

    def link_with(self, *entries: dict[str, Any], locks: Sequence[str] = ()) -> None:
        means, wrong = configured_means(list(entries))
        assert not wrong
        self.link = DriveLink(self.nodes[0], lambda: self.clock, means)
        listened = (Endpoint("/cmd_vel", (TWIST,)),)
        published = tuple(Endpoint(each, (STATUS,)) for each in locks)
        self.link.follow(GraphInfo(nodes=(NodeInfo("/robot", subscriptions=listened, publishers=published),)))
        self.settle()

    def settle(self) -> None:
        for _ in range(30):
            self.executor.spin_once(timeout_sec=0)

    def pass_time(self, seconds: float) -> None:
        for _ in range(round(seconds / HOLD_PERIOD_S)):
            self.clock += HOLD_PERIOD_S
            self.link._repeat()
            self.settle()

    @property
    def info(self) -> DriveInfo:
        return self.link.info(WorldInfo())

    @property
    def status(self) -> str:
        return status_text(ConsoleSnapshot(drive=self.info))


@pytest.fixture
def bench() -> Iterator[Bench]:
    made = Bench()
    yield made
    for each in made.nodes:
        each.destroy_node()
    made.context.try_shutdown()


def kind_of(entry: dict[str, Any]) -> str:
    return "-".join(str(each) for each in entry if each != "controllers")


@pytest.mark.parametrize("entry", EVERY_KIND, ids=kind_of)
def test_a_means_confirms_that_it_holds_and_a_release_undoes_it(bench: Bench, entry: dict[str, Any]) -> None:
    bench.robot.offer(entry)
    bench.link_with(entry)
    bench.pass_time(1.0)
    assert not bench.robot.calls, "nothing is done without a request"
    bench.link.stop(True, "ALL STOP")
    assert not bench.info.stop_confirmed and "THE ROBOT MAY MOVE" in bench.status
    bench.settle()
    bench.pass_time(HOLD_PERIOD_S)
    assert bench.robot.stands and bench.info.stop_confirmed
    assert bench.status.startswith(f"ALL STOP held by {next(iter(entry))} /") and "MAY MOVE" not in bench.status
    held = len(bench.robot.calls)
    bench.pass_time(2.0)
    assert "lock" in entry or len(bench.robot.calls) == held, "a means that holds is not asked again"
    bench.link.stop(False, "")
    bench.settle()
    assert not bench.robot.stands and not bench.info.stopped
    released = len(bench.robot.calls)
    bench.pass_time(2.0)
    assert len(bench.robot.calls) == released and not bench.info.means_news


@pytest.mark.parametrize("entry", EVERY_KIND, ids=kind_of)
def test_a_means_that_refuses_is_not_a_confirmation(bench: Bench, entry: dict[str, Any]) -> None:
    bench.robot.offer(entry)
    bench.robot.refuses = True
    bench.link_with(entry)
    bench.link.stop(True, "ALL STOP")
    bench.pass_time(0.5)
    assert not bench.info.stop_confirmed and "THE ROBOT MAY MOVE" in bench.status and "(! ends it)" in bench.status
    bench.robot.refuses = False
    bench.pass_time(2.0)
    assert bench.robot.stands and bench.info.stop_confirmed, "it is tried again"


@pytest.mark.parametrize("entry", EVERY_KIND, ids=kind_of)
def test_an_unavailable_means_is_named_and_used_when_it_appears(bench: Bench, entry: dict[str, Any]) -> None:
    bench.link_with(entry)
    bench.link.stop(True, "ALL STOP")
    bench.pass_time(0.5)
    assert not bench.info.stop_confirmed and next(iter(entry)) in bench.status
    bench.robot.offer(entry)
    bench.pass_time(2.0)
    assert bench.robot.stands and bench.info.stop_confirmed


def test_zeros_are_sent_at_once_and_the_next_means_does_not_wait_for_the_last(bench: Bench) -> None:
    frozen = Node("frozen", context=bench.context)  # in the graph, but never responds
    bench.nodes.append(frozen)
    for name in ("/one", "/two"):
        frozen.create_service(Trigger, name, lambda _, response: response)
    bench.robot.offer({"trigger": "/base/stop"})
    bench.link_with({"trigger": "/one"}, {"trigger": "/two"}, {"trigger": "/base/stop"})
    bench.link.stop(True, "ALL STOP")
    bench.settle()
    assert bench.robot.velocities[:1] == [0.0] and "MAY MOVE, trigger /one has not answered yet" in bench.status
    bench.pass_time(NEXT_AFTER_S - HOLD_PERIOD_S)
    assert "trigger /one" in bench.status
    bench.pass_time(HOLD_PERIOD_S)
    assert "trigger /two has not answered yet" in bench.status
    bench.pass_time(NEXT_AFTER_S)
    assert bench.robot.calls == ["stop"] and bench.info.held_by_means == "trigger /base/stop"
    assert set(bench.robot.velocities) == {0.0} and len(bench.robot.velocities) >= 6, "and the zeros continue"


def test_the_next_means_is_not_tried_once_one_holds(bench: Bench) -> None:
    entries = ({"trigger": "/base/stop", "release": "/base/clear_stop"}, {"set_bool": "/motors/hold"})
    for each in entries:
        bench.robot.offer(each)
    bench.link_with(*entries)
    bench.link.stop(True, "ALL STOP")
    bench.pass_time(3.0)
    assert bench.robot.calls == ["stop"]
    bench.link.stop(False, "")
    bench.pass_time(1.0)
    assert bench.robot.calls == ["stop", "clear"], "a means that was not used is not released"


def test_all_means_tried_are_undone(bench: Bench) -> None:
    entries = ({"lock": "/e_stop"}, {"set_bool": "/motors/hold"})
    for each in entries:
        bench.robot.offer(each)
    bench.link_with(*entries)
    bench.link.stop(True, "ALL STOP")
    bench.pass_time(1.0)
    assert bench.info.held_by_means == "set_bool /motors/hold"
    bench.robot.calls.clear()
    bench.link.stop(False, "")
    bench.settle()
    assert bench.robot.calls.count(False) == 2


def test_without_configuration_only_zeros_are_sent(bench: Bench) -> None:
    for each in EVERY_KIND:
        bench.robot.offer(each)
    bench.link_with()
    bench.link.stop(True, "ALL STOP")
    bench.pass_time(3.0)
    assert not bench.robot.calls and set(bench.robot.velocities) == {0.0}
    assert "THE ROBOT MAY MOVE, zeros only (! ends it)" in bench.status


def test_a_robot_with_a_lock_is_not_stopped_by_other_means(bench: Bench) -> None:
    bench.robot.offer({"set_bool": "/motors/hold"})
    states = bench.nodes[1].create_publisher(DiagnosticStatus, LOCK, LATCHED)
    bench.link_with({"set_bool": "/motors/hold"}, locks=[LOCK])
    bench.link.stop(True, "ALL STOP")
    bench.pass_time(1.0)
    states.publish(DiagnosticStatus(values=[KeyValue(key="locked", value="true")]))
    bench.pass_time(1.0)
    assert bench.info.stop_confirmed and not bench.robot.calls and not bench.info.unlocked


def test_a_response_from_before_the_release_does_not_confirm_the_next_stop(bench: Bench) -> None:
    bench.robot.offer({"set_bool": "/motors/hold"})
    bench.link_with({"set_bool": "/motors/hold"})
    bench.link.stop(True, "ALL STOP")
    bench.link.stop(False, "")
    bench.robot.refuses = True
    bench.link.stop(True, "ALL STOP")
    bench.settle()
    assert bench.robot.calls == [True, False, True] and not bench.info.stop_confirmed


def test_a_means_whose_node_has_left_no_longer_confirms(bench: Bench) -> None:
    bench.robot.offer({"set_bool": "/motors/hold"})
    bench.link_with({"set_bool": "/motors/hold"})
    bench.link.stop(True, "ALL STOP")
    bench.pass_time(0.2)
    assert bench.info.stop_confirmed
    bench.executor.remove_node(bench.nodes[1])
    bench.nodes[1].destroy_node()
    bench.pass_time(0.2)
    assert not bench.info.stop_confirmed and "THE ROBOT MAY MOVE" in bench.status


def test_a_node_that_was_inactive_is_not_activated_by_a_release(bench: Bench) -> None:
    bench.robot.offer({"deactivate": "/base_driver"})
    bench.robot.stands, bench.robot.refuses = True, True
    bench.link_with({"deactivate": "/base_driver"})
    bench.link.stop(True, "ALL STOP")
    bench.pass_time(0.5)
    assert bench.info.stop_confirmed
    bench.robot.refuses = False
    bench.link.stop(False, "")
    bench.settle()
    assert bench.robot.stands and bench.robot.calls == [4]


def test_a_means_that_cannot_be_released_is_reported(bench: Bench) -> None:
    bench.robot.offer({"trigger": "/base/stop"})
    bench.link_with({"trigger": "/base/stop"})
    bench.link.stop(True, "ALL STOP")
    bench.settle()
    bench.link.stop(False, "")
    bench.settle()
    assert "NOT RELEASED: trigger /base/stop has no `release` in the settings" in bench.status


def test_an_unknown_message_type_gives_one_clear_message(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(name: str) -> None:
        raise ModuleNotFoundError(name)

    monkeypatch.setattr(means_module.importlib, "import_module", unknown)
    bench.link_with({"switch": "/controller_manager", "controllers": ["diff"]})
    bench.link.stop(True, "ALL STOP")
    bench.pass_time(0.1)
    assert "controller_manager_msgs is not available here" in bench.status


def robots_with(*spaces: str, locked: str) -> GraphInfo:
    def node(space: str) -> NodeInfo:
        lock = (Endpoint(f"{space}{LOCK}", (STATUS,)),) if space == locked else ()
        return NodeInfo(f"{space}/base", subscriptions=(Endpoint(f"{space}/cmd_vel", (TWIST,)),), publishers=lock)

    return GraphInfo(nodes=tuple(node(each) for each in spaces))


def test_a_robot_without_lock_beside_one_with_a_lock_is_held_by_zeros_and_named(bench: Bench) -> None:
    states = bench.nodes[1].create_publisher(DiagnosticStatus, f"/robot2{LOCK}", LATCHED)
    bench.link_with()
    bench.link.follow(robots_with("", "/robot2", locked="/robot2"))
    bench.settle()
    bench.link.stop(True, "ALL STOP")
    bench.settle()
    states.publish(DiagnosticStatus(values=[KeyValue(key="locked", value="true")]))
    bench.settle()
    bench.robot.velocities.clear()
    bench.pass_time(1.0)
    assert bench.info.stop_confirmed and bench.info.unlocked == ("/",)
    assert bench.robot.velocities and set(bench.robot.velocities) == {0.0}
    assert "/ MAY MOVE, zeros only" in bench.status


def test_a_robot_whose_lock_has_left_is_held_by_zeros_and_other_means(bench: Bench) -> None:
    states = bench.nodes[1].create_publisher(DiagnosticStatus, LOCK, LATCHED)
    bench.robot.offer({"set_bool": "/motors/hold"})
    bench.link_with({"set_bool": "/motors/hold"}, locks=[LOCK])
    bench.link.stop(True, "ALL STOP")
    states.publish(DiagnosticStatus(values=[KeyValue(key="locked", value="true")]))
    bench.pass_time(1.0)
    bench.robot.velocities.clear()
    assert bench.info.stop_confirmed and not bench.robot.calls
    bench.link.follow(robots_with("", locked="none"))
    bench.pass_time(1.0)
    assert bench.robot.stands and set(bench.robot.velocities) == {0.0}
    bench.link.stop(False, "")
    bench.pass_time(1.0)
    assert not bench.robot.stands


def test_a_means_holds_a_robot_without_lock_while_its_driver_is_gone(bench: Bench) -> None:
    states = bench.nodes[1].create_publisher(DiagnosticStatus, f"/robot2{LOCK}", LATCHED)
    bench.robot.offer({"set_bool": "/motors/hold"})
    bench.link_with({"set_bool": "/motors/hold"})
    both, other = robots_with("", "/robot2", locked="/robot2"), robots_with("/robot2", locked="/robot2")
    bench.link.follow(both)
    bench.settle()
    bench.link.stop(True, "ALL STOP")
    bench.settle()
    states.publish(DiagnosticStatus(values=[KeyValue(key="locked", value="true")]))
    for graph in (both, other, both):
        bench.link.follow(graph)
        bench.pass_time(1.0)
        assert bench.info.stop_confirmed and bench.robot.stands
    bench.link.stop(False, "")
    bench.pass_time(1.0)
    assert not bench.robot.stands


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        ("lock", "a list with entries"),
        (["/e_stop"], "exactly one of lock, set_bool"),
        ([{}], "exactly one of"),
        ([{"lock": "/a", "trigger": "/b"}], "exactly one of"),
        ([{"lock": ""}], "not a valid ROS name"),
        ([{"trigger": "/a b"}], "not a valid ROS name"),
        ([{"trigger": ["/a"]}], "not a valid ROS name"),
        ([{"trigger": "/a", "release": 3}], "release: '3' is not a valid"),
        ([{"set_bool": "/a", "hold": "yes"}], "hold is true or false"),
        ([{"set_bool": "/a", "release": "/b"}], "takes only hold, not 'release'"),
        ([{"deactivate": "/a", "hold": True}], "takes nothing else, not 'hold'"),
        ([{"switch": "/a"}], "controllers lists the controllers"),
        ([{"switch": "/a", "controllers": "diff"}], "controllers lists the controllers"),
        ([{"switch": "/a", "controllers": [1]}], "controllers lists the controllers"),
        ([{"lock": f"/a{number}"} for number in range(30)], "more than 20 entries"),
        ({"lock": "/a"}, "a list with entries"),
        (3, "a list with entries"),
    ],
)
def test_an_invalid_entry_is_named_and_the_others_are_kept(data: object, problem: str) -> None:
    entries = [*data, {"lock": "good"}] if isinstance(data, list) else data
    found, wrong = configured_means(entries)
    assert any(problem in each for each in wrong), wrong
    if isinstance(data, list) and len(data) == 1:
        assert found == (ConfiguredMeans("lock", "/good"),) and wrong[0].startswith("entry 1: ")


def test_an_exception_in_one_means_does_not_prevent_the_next(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    def fault(self: object) -> None:
        raise ValueError("this means is broken")

    monkeypatch.setattr(means_module.LockTopic, "hold", fault)
    bench.robot.offer({"set_bool": "/motors/hold"})
    bench.link_with({"lock": "/e_stop"}, {"set_bool": "/motors/hold"})
    bench.link.stop(True, "ALL STOP")
    assert "lock /e_stop this means is broken" in bench.status
    bench.pass_time(0.2)
    assert bench.robot.stands and bench.info.stop_confirmed
