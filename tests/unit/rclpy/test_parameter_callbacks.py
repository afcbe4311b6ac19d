"""Setting parameters: the order of callbacks, refusals, exceptions, nesting, events."""

import gc
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from rcl_interfaces.msg import ParameterDescriptor, ParameterEvent, SetParametersResult
from rclpy.exceptions import InvalidParameterValueException, ParameterNotDeclaredException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_parameter_events

Log = list[Any]


def new_parameter(name: str, value: Any) -> Parameter:
    return Parameter(name, value=value)


def accept_all(parameters: Any) -> SetParametersResult:
    return SetParametersResult(successful=True, reason="never seen")


def no(reason: str) -> Callable[[Any], SetParametersResult]:
    return lambda parameters: SetParametersResult(successful=False, reason=reason)


def node_of(ros: Any) -> Node:
    node = ros.node()
    node.declare_parameters("", [("a", 0), ("b", 1), ("c", 2)])
    return node


def values(node: Node) -> list[Any]:
    return [node.get_parameter(name).value for name in "abc"]


def trace(node: Node, log: Log, label: str = "") -> None:
    """Record every call of one callback of each kind, with the node's values at that time."""

    def note(stage: str, answer: Callable[[Any], Any]) -> Callable[[Any], Any]:
        def callback(parameters: Any) -> Any:
            log.append((stage + label, [(each.name, each.value) for each in parameters], values(node)))
            return answer(parameters)

        return callback

    node.add_pre_set_parameters_callback(note("pre", lambda parameters: parameters))
    node.add_on_set_parameters_callback(note("on", accept_all))
    node.add_post_set_parameters_callback(note("post", lambda parameters: None))


def test_callbacks_of_each_stage_see_the_expected_values(ros: Any) -> None:
    node, log = node_of(ros), []
    trace(node, log)
    assert node.set_parameters([new_parameter("a", 5)]) == [SetParametersResult(successful=True)]
    new = [("a", 5)]
    assert log == [("pre", new, [0, 1, 2]), ("on", new, [0, 1, 2]), ("post", new, [5, 1, 2])]


def test_set_parameters_sets_singly_and_atomically_sets_together(ros: Any) -> None:
    node, log = node_of(ros), []
    trace(node, log)
    node.set_parameters([new_parameter("a", 5), new_parameter("b", 6)])
    assert [(stage, len(parameters)) for stage, parameters, _ in log] == [("pre", 1), ("on", 1), ("post", 1)] * 2
    log.clear()
    node.set_parameters_atomically([new_parameter("a", 7), new_parameter("b", 8)])
    assert [(stage, len(parameters)) for stage, parameters, _ in log] == [("pre", 2), ("on", 2), ("post", 2)]


def test_newest_callback_runs_first_and_a_refusal_ends_the_chain(ros: Any) -> None:
    node, log = node_of(ros), []
    trace(node, log, "1")
    trace(node, log, "2")
    node.set_parameters_atomically([new_parameter("a", 5)])
    assert [stage for stage, *_ in log] == ["pre2", "pre1", "on2", "on1", "post2", "post1"]
    log.clear()
    node.add_on_set_parameters_callback(no("too fast"))
    [result] = node.set_parameters([new_parameter("a", 6)])
    assert (result.successful, result.reason) == (False, "too fast")
    assert [stage for stage, *_ in log] == ["pre2", "pre1"]
    assert values(node) == [5, 1, 2]


def test_one_refusal_of_three_keeps_the_others(ros: Any) -> None:
    node = node_of(ros)
    refuse = no("not b")
    node.add_on_set_parameters_callback(lambda ps: refuse(ps) if any(p.name == "b" for p in ps) else accept_all(ps))
    wanted = [new_parameter("a", 5), new_parameter("b", 6), new_parameter("c", 7)]
    assert [each.successful for each in node.set_parameters(wanted)] == [True, False, True]
    assert values(node) == [5, 1, 7]
    assert node.set_parameters_atomically([new_parameter("a", 8), new_parameter("b", 8)]).reason == "not b"
    assert values(node) == [5, 1, 7]


def test_refusing_result_object_is_returned_unchanged(ros: Any) -> None:
    node, answer = node_of(ros), SetParametersResult(successful=False)
    node.add_on_set_parameters_callback(lambda parameters: answer)
    [result] = node.set_parameters([new_parameter("a", 5)])
    assert result is answer


def test_lists_and_parameters_are_passed_uncopied(ros: Any) -> None:
    node, seen = node_of(ros), []

    def extend(parameters: Any) -> Any:
        seen.append(parameters)
        parameters.append(new_parameter("b", 9))
        return accept_all(parameters)

    node.add_on_set_parameters_callback(extend)
    wanted = new_parameter("a", 5)
    node.set_parameters([wanted])
    assert values(node) == [5, 9, 2]
    assert node.get_parameter("a") is wanted is seen[0][0]
    node.remove_on_set_parameters_callback(extend)
    node.add_on_set_parameters_callback(lambda parameters: accept_all(parameters.pop()))
    assert node.set_parameters_atomically([new_parameter("a", 7), new_parameter("b", 7)]).successful
    assert values(node) == [7, 9, 2]


def test_pre_set_callback_may_change_the_list(ros: Any) -> None:
    node, log = node_of(ros), []
    node.add_pre_set_parameters_callback(lambda ps: [new_parameter(p.name, min(p.value, 3)) for p in ps])
    trace(node, log)
    node.set_parameters([new_parameter("a", 5)])
    assert values(node)[0] == 3
    assert log[1][:2] == ("on", [("a", 5), ("a", 3)])


def test_pre_set_callback_emptying_the_list_refuses_the_set(ros: Any) -> None:
    node = node_of(ros)
    node.add_pre_set_parameters_callback(lambda parameters: [])
    reason = (
        "parameter list cannot be empty, this might be due to pre_set_parameters_callback "
        "modifying the original parameters list."
    )
    assert node.set_parameters([new_parameter("a", 5)])[0].reason == reason
    assert node.set_parameters_atomically([]).reason == reason


def test_type_checks_run_between_pre_set_and_on_set(ros: Any) -> None:
    node, log = node_of(ros), []
    trace(node, log)
    assert "Wrong parameter type" in node.set_parameters([new_parameter("a", "x")])[0].reason
    with pytest.raises(ParameterNotDeclaredException):
        node.set_parameters([new_parameter("b", 6), new_parameter("zz", 1), new_parameter("c", 7)])
    assert [stage for stage, *_ in log] == ["pre", "pre", "on", "post", "pre"]
    assert values(node) == [0, 6, 2]


def test_declaring_calls_on_set_and_post_set_for_each_parameter(ros: Any) -> None:
    node, log = node_of(ros), []
    trace(node, log)
    node.declare_parameters("", [("x", 1), ("y", Parameter.Type.INTEGER)])
    assert [(stage, parameters) for stage, parameters, _ in log] == [
        ("on", [("x", 1)]),
        ("post", [("x", 1)]),
        ("on", [("y", None)]),
        ("post", [("y", None)]),
    ]
    log.clear()
    node.undeclare_parameter("x")
    assert not log


def test_exceptions_reach_the_caller(ros: Any) -> None:
    node = node_of(ros)

    def fail(parameters: Any) -> Any:
        raise RuntimeError("fails")

    node.add_post_set_parameters_callback(fail)
    with pytest.raises(RuntimeError, match="fails"):
        node.set_parameters([new_parameter("a", 5)])
    assert values(node)[0] == 5
    node.add_on_set_parameters_callback(fail)
    with pytest.raises(RuntimeError, match="fails"):
        node.set_parameters([new_parameter("a", 6)])
    assert values(node)[0] == 5


class LooksLikeAResult:
    successful = True
    reason = ""


@pytest.mark.parametrize(
    "result", [None, True, [accept_all(None)], LooksLikeAResult()], ids=["None", "bool", "list", "other"]
)
def test_invalid_callback_result_is_a_refusal_with_a_warning(ros: Any, result: Any) -> None:
    node = node_of(ros)
    node.add_on_set_parameters_callback(lambda parameters: result)
    with pytest.warns(UserWarning, match=r"^Callback returned an invalid type, it should return SetParameterResult\.$"):
        [answer] = node.set_parameters([new_parameter("a", 7)])
    assert answer == SetParametersResult(successful=False, reason="Callback returned an invalid type")
    assert values(node)[0] == 0
    with pytest.warns(UserWarning), pytest.raises(InvalidParameterValueException, match="returned an invalid type"):
        node.declare_parameter("new", 1)


def test_callbacks_must_be_callable(ros: Any) -> None:
    node = node_of(ros)
    for add in (node.add_on_set_parameters_callback, node.add_post_set_parameters_callback):
        with pytest.raises(TypeError) as refused:
            add(5)  # type: ignore[arg-type]
        assert refused.value.args == ("Callback must be callable, got {}", int)


def test_nested_set_takes_effect_first(ros: Any) -> None:
    node, log = node_of(ros), []

    def nested(parameters: Any) -> Any:
        if (parameters[0].name, parameters[0].value) == ("a", 5):
            node.set_parameters([new_parameter("b", 50), new_parameter("a", 99)])
            log.append(values(node))
        return accept_all(parameters)

    node.add_on_set_parameters_callback(nested)
    node.set_parameters([new_parameter("a", 5)])
    assert log == [[99, 50, 2]]
    assert values(node) == [5, 50, 2]


def test_nested_set_persists_if_the_outer_one_is_refused(ros: Any) -> None:
    node = node_of(ros)
    refuse = no("outer")

    def nested(parameters: Any) -> Any:
        if parameters[0].name == "b":
            return accept_all(parameters)
        node.set_parameters([new_parameter("b", 50)])
        return refuse(parameters)

    node.add_on_set_parameters_callback(nested)
    assert node.set_parameters([new_parameter("a", 5)])[0].reason == "outer"
    assert values(node) == [0, 50, 2]


def test_callback_added_twice_runs_twice_and_can_be_removed(ros: Any) -> None:
    node, log = node_of(ros), []

    def note(parameters: Any) -> Any:
        log.append("called")
        return accept_all(parameters)

    node.add_on_set_parameters_callback(note)
    node.add_on_set_parameters_callback(note)
    node.set_parameters([new_parameter("a", 1)])
    node.remove_on_set_parameters_callback(note)
    node.set_parameters([new_parameter("a", 2)])
    assert log == ["called"] * 3
    for kind in ("pre", "on", "post"):
        with pytest.raises(ValueError, match="not in list"):
            getattr(node, f"remove_{kind}_set_parameters_callback")(print)


def test_callback_removing_itself_skips_the_next(ros: Any) -> None:
    node, log = node_of(ros), []

    def once(parameters: Any) -> Any:
        log.append("once")
        node.remove_on_set_parameters_callback(once)
        return accept_all(parameters)

    trace(node, log)
    node.add_on_set_parameters_callback(once)
    node.set_parameters([new_parameter("a", 1)])
    assert [each if isinstance(each, str) else each[0] for each in log] == ["pre", "once", "post"]


class Listener:
    """The events of a node on `/parameter_events`."""

    def __init__(self, ros: Any) -> None:
        self.events: list[ParameterEvent] = []
        self.ros = ros
        watcher = ros.node("watcher")
        watcher.create_subscription(
            ParameterEvent, "/parameter_events", self.events.append, qos_profile_parameter_events
        )

    def heard(self) -> list[Any]:
        """Return node, new, changed and deleted of each event since the last call."""
        self.ros.settle()
        found = [
            (each.node, *([(p.name, p.value.type) for p in group] for group in _groups(each))) for each in self.events
        ]
        self.events.clear()
        return found


def _groups(event: ParameterEvent) -> tuple[Any, Any, Any]:
    return event.new_parameters, event.changed_parameters, event.deleted_parameters


def test_events_list_new_changed_and_deleted_parameters(ros: Any) -> None:
    listener = Listener(ros)
    node = ros.node("n", namespace="/ns")
    name = "/ns/n"
    assert listener.heard() == [
        (name, [("use_sim_time", 1)], [], []),
        (name, [("start_type_description_service", 1)], [], []),
    ]
    dynamic = ParameterDescriptor(dynamic_typing=True)
    node.declare_parameters("", [("a", 1), ("e", Parameter.Type.DOUBLE), ("d", "x", dynamic)])
    assert listener.heard() == [(name, [("a", 2)], [], []), (name, [("e", 0)], [], []), (name, [("d", 4)], [], [])]
    node.set_parameters(
        [new_parameter("a", 1), new_parameter("a", "refused"), new_parameter("e", 2.5), new_parameter("e", 2.5)]
    )
    changed = (name, [], [("a", 2)], []), (name, [("e", 3)], [], []), (name, [], [("e", 3)], [])
    assert listener.heard() == [*changed]
    node.set_parameters_atomically([new_parameter("a", 2), new_parameter("d", None)])
    assert listener.heard() == [(name, [], [("a", 2)], [("d", 0)])]
    node.undeclare_parameter("a")
    assert listener.heard() == []
    node.set_parameters_atomically([])
    assert listener.heard() == [(name, [], [], [])]


def test_deleting_an_undeclared_parameter_succeeds_without_event(ros: Any) -> None:
    listener = Listener(ros)
    node = ros.node(allow_undeclared_parameters=True)
    listener.heard()
    assert (
        node.set_parameters([new_parameter("a", None), new_parameter("a", None)])
        == [SetParametersResult(successful=True)] * 2
    )
    assert listener.heard() == [("/n", [], [], [("a", 0)])] * 2


def test_event_is_stamped_with_the_nodes_time(ros: Any) -> None:
    listener = Listener(ros)
    node = ros.node(parameter_overrides=[new_parameter("use_sim_time", True)])
    listener.heard()
    node.declare_parameter("a", 1)
    ros.settle()
    assert [(each.stamp.sec, each.stamp.nanosec) for each in listener.events] == [(0, 0)]


def test_value_that_does_not_fit_the_event_raises_type_error(ros: Any) -> None:
    node = node_of(ros)
    with pytest.raises(TypeError, match="integer_value"):
        node.set_parameters([new_parameter("a", 2**63)])


def test_event_holds_copies_of_values(ros: Any) -> None:
    listener, node, words, number = Listener(ros), ros.node(), ["a", "b"], type("Number", (int,), {})(3)
    node.declare_parameters("", [("words", ["x"]), ("number", 1)])
    listener.heard()
    node.set_parameters_atomically([new_parameter("words", words), new_parameter("number", number)])
    words[0] = "changed"
    ros.settle()
    (event,) = listener.events
    assert event.changed_parameters[0].value.string_array_value == ["a", "b"]
    assert type(event.changed_parameters[1].value.integer_value) is int


@pytest.fixture
def collections() -> Iterator[list[str]]:
    """The phases of garbage collector runs; the collector is enabled."""
    phases: list[str] = []

    def note(phase: str, info: dict[str, int]) -> None:
        phases.append(phase)

    before, threshold = gc.isenabled(), gc.get_threshold()
    gc.enable()
    gc.set_threshold(700)
    gc.callbacks.append(note)
    yield phases
    gc.callbacks.remove(note)
    gc.set_threshold(*threshold)
    if not before:
        gc.disable()


def test_event_of_many_parameters_is_created_without_garbage_collection(ros: Any, collections: list[str]) -> None:
    node, got = ros.node(), []
    many = [f"p{number}" for number in range(2_000)]
    node.declare_parameters("", [(name, 0) for name in many])
    ros.settle()
    node.create_subscription(ParameterEvent, "/parameter_events", got.append, 10)
    changes = [new_parameter(name, 1) for name in many]
    gc.collect()
    collections.clear()
    node.set_parameters_atomically(changes)
    assert collections.count("start") <= 1  # one may have been due while they were created
    assert gc.isenabled()
    ros.spin(lambda: bool(got))
    assert len(got[0].changed_parameters) == len(many)


def test_failed_event_of_many_parameters_leaves_the_collector_enabled(ros: Any, collections: list[str]) -> None:
    node = ros.node()
    many = [f"p{number}" for number in range(500)]
    node.declare_parameters("", [(name, 0) for name in many])
    node.create_subscription(ParameterEvent, "/parameter_events", lambda event: None, 10)
    with pytest.raises(TypeError):
        node.set_parameters_atomically([new_parameter(name, 1 << 70) for name in many])
    assert gc.isenabled()


def test_events_are_counted_without_subscribers(ros: Any) -> None:
    node, heard = node_of(ros), []
    before = node._parameter_event_publisher._endpoint.published
    node.set_parameters([new_parameter("a", 1), new_parameter("b", 2)])
    node.set_parameters_atomically([new_parameter("a", 3), new_parameter("b", 4)])

    def hear(event: ParameterEvent, info: Any) -> None:
        heard.append(([each.name for each in event.changed_parameters], info["publication_sequence_number"]))

    node.create_subscription(ParameterEvent, "/parameter_events", hear, qos_profile_parameter_events)
    node.set_parameters_atomically([new_parameter("a", 5), new_parameter("c", 6)])
    ros.settle()
    assert heard == [(["a", "c"], before + 4)]


@pytest.mark.parametrize("listens", [False, True])
def test_value_out_of_int64_range_is_refused_with_and_without_subscribers(ros: Any, listens: bool) -> None:
    node = node_of(ros)
    if listens:
        node.create_subscription(ParameterEvent, "/parameter_events", lambda event: None, qos_profile_parameter_events)
    for value in (1 << 63, -(1 << 63) - 1):
        with pytest.raises(TypeError, match="integer_value"):
            node.set_parameters([new_parameter("a", value)])
    assert node.set_parameters([new_parameter("a", (1 << 63) - 1), new_parameter("b", -(1 << 63))])[0].successful


def test_latched_events_are_created_without_subscribers(ros: Any) -> None:
    node, heard = node_of(ros), []
    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node._parameter_event_publisher = node.create_publisher(ParameterEvent, "/kept_events", latched)
    node.set_parameters_atomically([new_parameter("a", 3), new_parameter("b", 4)])
    node.create_subscription(ParameterEvent, "/kept_events", heard.append, latched)
    ros.settle()
    assert [[each.name for each in event.changed_parameters] for event in heard] == [["a", "b"]]
