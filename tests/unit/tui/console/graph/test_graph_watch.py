"""The console's view of the graph: polled only after an event, each topic queried once, nothing described twice."""

import pytest
import rclpy
from bot_console.tui.console.graph.watch import GraphWatch
from bot_console.tui.session.embedded.hooks import graph_events
from domains import unused_domain
from rclpy.context import Context
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float64


class Events:
    """Replaces a system that reports changes of its graph."""

    def __init__(self):
        self.changed, self.ended = None, False

    def __call__(self, domain, changed):
        self.domain, self.changed = domain, changed
        return self.end

    def end(self):
        self.ended = True


@pytest.fixture
def context():
    made = Context()
    rclpy.init(args=[], context=made, domain_id=unused_domain())
    yield made
    made.shutdown()


@pytest.fixture
def node(context):
    made = rclpy.create_node("_watcher", context=context)
    yield made
    made.destroy_node()


def test_graph_is_polled_only_after_an_event(context, node):
    events, polls = Events(), []
    watch = GraphWatch(node, lambda graph: None, events)
    assert events.domain == context.get_domain_id()
    watch.poll = lambda watching=watch.poll: polls.append(1) or watching()
    for _ in range(3):
        watch._tick()
    assert len(polls) == 1  # the first
    events.changed(("n", "/"))
    watch._tick()
    watch._tick()
    assert len(polls) == 2
    watch.close()
    assert events.ended


def test_graph_is_polled_at_every_tick_without_events(node):
    watch, polls = GraphWatch(node, lambda graph: None), []
    watch.poll = lambda: polls.append(1)
    for _ in range(3):
        watch._tick()
    assert len(polls) == 3


def test_nodes_and_topics_are_in_natural_order(context, node):
    for name in ("robot10", "robot9"):
        rclpy.create_node(name, context=context).create_publisher(Float64, f"{name}/moves", 1)
    watch = GraphWatch(node, lambda graph: None)
    watch.poll()
    robots = [each.name for each in watch.info.nodes if each.name.startswith("/robot")]
    assert robots == ["/robot9", "/robot10"]
    assert [each.name for each in watch.info.topics if "moves" in each.name] == ["/robot9/moves", "/robot10/moves"]


def test_polling_pauses_after_a_long_poll(node, monkeypatch):
    now, spent, polls = [0.0], [0.0], []
    monkeypatch.setattr("bot_console.tui.console.graph.watch.monotonic", lambda: now[0])
    monkeypatch.setattr("bot_console.tui.console.graph.watch.thread_time", lambda: spent[0])
    watch = GraphWatch(node, lambda graph: None)

    def poll():
        polls.append(now[0])
        spent[0] += 0.3

    watch.poll = poll
    for tick in range(10):
        now[0] = tick * 0.5
        watch._tick()
    assert polls == [0.0, 1.5, 3.0, 4.5], "a fifth of the time at most"


def test_only_changed_nodes_are_described_again(context, node):
    others = [rclpy.create_node(f"n{number}", context=context) for number in range(3)]
    seen = []
    watch = GraphWatch(node, seen.append)
    watch.poll()
    watch.poll()
    assert len(seen) == 1
    publisher = others[1].create_publisher(Float64, "speed", 7)
    watch.poll()
    before, after = ({each.name: each for each in graph.nodes} for graph in seen)
    assert [name for name in after if after[name] is not before[name]] == ["/n1"]
    assert [(each.name, each.qos) for each in after["/n1"].publishers if each not in before["/n1"].publishers] == [
        ("/speed", "reliable volatile 7")
    ]
    assert seen[1].services is seen[0].services
    others[1].destroy_publisher(publisher)
    others[2].destroy_node()
    watch.poll()
    assert [each.name for each in seen[2].nodes] == ["/_watcher", "/n0", "/n1"]
    assert "/speed" not in {each.name for each in seen[2].topics}


def test_each_topic_is_queried_once(context, node):
    others = [rclpy.create_node(f"n{number}", context=context) for number in range(8)]
    asked, ask = [], node.get_publishers_info_by_topic
    node.get_publishers_info_by_topic = lambda topic: asked.append(topic) or ask(topic)
    watch = GraphWatch(node, lambda graph: None)
    watch.poll()
    assert sorted(asked) == ["/parameter_events", "/rosout"]
    del asked[:]
    others[0].create_publisher(Float64, "speed", 7)
    watch.poll()
    assert asked == ["/speed"]


def test_only_the_node_named_by_an_event_is_queried(context, node):
    others = [rclpy.create_node(f"n{number}", context=context) for number in range(3)]
    watch = GraphWatch(node, lambda graph: None, graph_events)
    watch.poll()
    asked, ask = [], watch._ask
    watch._ask = lambda name, space: asked.append(name) or ask(name, space)
    services = watch.info.services
    publisher = others[1].create_publisher(Float64, "speed", 7)
    watch.poll()
    assert asked == ["n1"] and "/speed" in {each.name for each in watch.info.topics}
    assert watch.info.services is services
    others[1].destroy_publisher(publisher)
    others[2].destroy_node()
    watch.poll()
    assert asked == ["n1", "n1"] and "/speed" not in {each.name for each in watch.info.topics}
    assert "/n2" not in {each.name for each in watch.info.nodes}
    assert "/n2/set_parameters" not in {each.name for each in watch.info.services}
    watch.close()


def test_endpoint_that_was_replaced_between_two_polls_has_its_new_qos(context, node):
    other = rclpy.create_node("other", context=context)
    publisher = other.create_publisher(Float64, "speed", 7)
    seen = []
    watch = GraphWatch(node, seen.append, graph_events)
    watch.poll()
    other.destroy_publisher(publisher)
    other.create_publisher(Float64, "speed", QoSProfile(depth=3, reliability=ReliabilityPolicy.BEST_EFFORT))
    watch.poll()
    (info,) = (each for each in watch.info.nodes if each.name == "/other")
    assert [each.qos for each in info.publishers if each.name == "/speed"] == ["best effort volatile 3"]
    other.create_publisher(Float64, "speed", 9)
    known = seen[-1]
    watch.poll()
    assert seen[-1] is known, "a second publisher of the same topic: the first one counts"
    watch.close()


def test_runtime_events_trigger_a_poll(context, node):
    watch = GraphWatch(node, lambda graph: None, graph_events)
    watch.poll()
    other = rclpy.create_node("late", context=context)
    watch._tick()
    assert "/late" in {each.name for each in watch.info.nodes}
    other.destroy_node()
    watch._tick()
    assert "/late" not in {each.name for each in watch.info.nodes}
    watch.close()


def test_nodes_of_a_stopped_process_are_reported_until_it_continues(context, node):
    stopped, seen = {}, []
    watch = GraphWatch(node, seen.append, graph_events, lambda domain: (stopped, {}))
    watch._tick()
    stopped[42] = ["/b", "/a"]
    watch._tick()
    watch._tick()
    assert [each.frozen for each in seen] == [(), (("/a", 42), ("/b", 42))]
    other = rclpy.create_node("late", context=context)
    watch._tick()
    assert seen[-1].frozen == (("/a", 42), ("/b", 42)) and "/late" in {each.name for each in seen[-1].nodes}
    stopped.clear()
    watch._tick()
    assert seen[-1].frozen == ()
    other.destroy_node()
    watch.close()


def test_nodes_in_a_debugger_are_reported_with_the_line_until_they_continue(context, node):
    lines, seen = {"/b": "b.py:7, in tick", "/a": ""}, []
    watch = GraphWatch(node, seen.append, graph_events, lambda domain: ({}, lines.copy()))
    watch._tick()
    watch._tick()
    assert seen[-1].debugged == (("/a", ""), ("/b", "b.py:7, in tick")) and len(seen) == 2
    del lines["/a"]
    watch._tick()
    assert seen[-1].debugged == (("/b", "b.py:7, in tick"),)
    watch.close()


def test_nodes_with_the_same_name_are_counted(context, node):
    first = rclpy.create_node("twin", context=context)
    watch = GraphWatch(node, lambda graph: None, graph_events)
    copies = []
    for _ in range(2):
        watch._tick()
        copies.append({each.name: each.copies for each in watch.info.nodes}["/twin"])
        second = rclpy.create_node("twin", context=context)
        watch._tick()
        copies.append({each.name: each.copies for each in watch.info.nodes}["/twin"])
        second.destroy_node()
    assert copies == [1, 2, 1, 2]
    first.destroy_node()
    watch.close()


@pytest.mark.parametrize(
    ("events", "foreign", "asks"), [(None, False, 1), (graph_events, False, 0), (graph_events, True, 1)]
)
def test_nodes_are_asked_for_a_sign_of_life_unless_this_machines_system_reports_it(
    context, node, events, foreign, asks
):
    watch, timers = GraphWatch(node, lambda graph: None, events, foreign=foreign), []
    node.create_timer = lambda period, tick: timers.append(tick)
    watch.watch_nodes(True)
    assert len(timers) == asks
    watch.close()
