"""`ros2 topic` with nodes written in the test."""

from __future__ import annotations

import math
import re

import pytest
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration

COUNTER = """
from std_msgs.msg import Int32
node = Node('counter')
publisher = node.create_publisher(Int32, 'count', 10)
count = iter(range(100000))
node.create_timer(0.25, lambda: publisher.publish(Int32(data=next(count))))
"""
LISTENER = """
from std_msgs.msg import String
node = Node('listener')
node.create_subscription(String, 'chatter', lambda message: print('heard', message.data), 10)
"""


def test_list_hides_hidden_topics_and_shows_types(ros) -> None:
    ros.node(COUNTER)
    ros.node(LISTENER)
    ros.node("from std_msgs.msg import Empty\nnode = Node('h')\nhidden = node.create_publisher(Empty, '_hidden', 1)")
    assert ros.ask("topic", "list").stdout.split() == ["/chatter", "/count", "/parameter_events", "/rosout"]
    for words in (("list", "--include-hidden-topics"), ("--include-hidden-topics", "list")):
        assert "/_hidden" in ros.ask("topic", *words).stdout.split()
    assert "/count [std_msgs/msg/Int32]\n" in ros.ask("topic", "list", "-t").stdout
    assert ros.ask("topic", "list", "-c").stdout == "4\n"
    published, subscribed = ros.ask("topic", "list", "-v").stdout.split("Subscribed topics:\n")
    assert " * /count [std_msgs/msg/Int32] 1 publisher\n" in published
    assert subscribed == " * /chatter [std_msgs/msg/String] 1 subscriber\n\n"


def test_info_prints_counts_and_endpoints(ros) -> None:
    ros.node(COUNTER)
    assert ros.ask("topic", "info", "/count").stdout == (
        "Type: std_msgs/msg/Int32\nPublisher count: 1\nSubscription count: 0\n"
    )
    full = ros.ask("topic", "info", "/count", "-v").stdout
    assert full.startswith("Type: std_msgs/msg/Int32\n\nPublisher count: 1\n\nNode name: counter\nNode namespace: /\n")
    assert "Endpoint type: PUBLISHER\n" in full
    assert "  Reliability: RELIABLE\n  History (Depth): KEEP_LAST (10)\n  Durability: VOLATILE\n" in full
    assert full.endswith("\n\nSubscription count: 0\n\n")


def test_type_and_find_print_topics_and_types(ros) -> None:
    ros.node(COUNTER)
    assert ros.ask("topic", "type", "/count").stdout == "std_msgs/msg/Int32\n"
    assert ros.ask("topic", "type", "count").exit == 1
    assert ros.ask("topic", "find", "std_msgs/msg/Int32").stdout == "/count\n"
    assert ros.ask("topic", "find", "std_msgs/msg/Int32", "-c").stdout == "1\n"


def test_echo_continues_until_interrupted(ros) -> None:
    ros.node(COUNTER)
    echo = ros.ask("topic", "echo", "/count", stop_after=1.0)
    assert (echo.stdout, echo.stderr, echo.exit) == ("".join(f"data: {each}\n---\n" for each in range(4)), "", 2)


def test_echo_filters_messages_and_times_out(ros) -> None:
    ros.node(COUNTER)
    even = ros.ask("topic", "echo", "/count", "--filter", "m.data % 2 == 0", "--csv", "--timeout", "1.6")
    assert even.stdout.split() == ["0", "2", "4"]
    assert ros.clock.steady_ns() == pytest.approx(1.7e9, abs=1e8)


def test_echo_truncates_long_arrays(ros) -> None:
    ros.node("""
from std_msgs.msg import Int8MultiArray
node = Node('long')
publisher = node.create_publisher(Int8MultiArray, 'long', 10)
node.create_timer(0.1, lambda: publisher.publish(Int8MultiArray(data=[7] * 200)))
""")
    assert ros.ask("topic", "echo", "/long", "--once").stdout.count("- 7\n") == 128
    assert "- '...'\n---\n" in ros.ask("topic", "echo", "/long", "--once").stdout
    assert ros.ask("topic", "echo", "/long", "--once", "-f").stdout.count("- 7\n") == 200
    assert ros.ask("topic", "echo", "/long", "--once", "-l", "3").stdout.count("- 7\n") == 3


def test_echo_adopts_the_publishers_qos(ros) -> None:
    """A late subscriber with matching durability gets the last message of a publisher that keeps it."""
    ros.node("""
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
node = Node('latched')
publisher = node.create_publisher(String, 'map', QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))
publisher.publish(String(data='kept'))
""")
    assert ros.ask("topic", "echo", "/map", "--once").stdout == "data: kept\n---\n"
    assert ros.ask("topic", "echo", "/map", "--once", "--qos-durability", "volatile", "--timeout", "1").stdout == ""


def test_echo_refuses_a_topic_with_two_types(ros) -> None:
    ros.node("from std_msgs.msg import Int32, String\nnode = Node('two')\n"
             "a, b = node.create_publisher(Int32, 't', 1), node.create_publisher(String, 't', 1)")  # fmt: skip
    assert ros.ask("topic", "echo", "/t").stderr == (
        "Cannot echo topic '/t', as it contains more than one type: [std_msgs/msg/Int32, std_msgs/msg/String]\n"
    )


def test_pub_reaches_a_subscriber(ros) -> None:
    listener = ros.node(LISTENER)
    published = ros.ask("topic", "pub", "--once", "/chatter", "std_msgs/msg/String", "{data: hello}")
    assert published.stdout == "publisher: beginning loop\npublishing #1: std_msgs.msg.String(data='hello')\n\n"
    assert listener.stdout == "heard hello\n"


def test_pub_waits_for_a_subscriber(ros) -> None:
    waiting = ros.ros2("topic", "pub", "--once", "/chatter", "std_msgs/msg/String", "{data: hello}")
    ros.run(2.5)
    assert waiting.stdout == "Waiting for at least 1 matching subscription(s)...\n" * 3
    listener = ros.node(LISTENER)
    assert ros.finish(waiting).exit == 0
    assert listener.stdout == "heard hello\n"


def test_pub_stops_waiting_after_max_wait_time(ros) -> None:
    given_up = ros.ask("topic", "pub", "-t", "2", "--max-wait-time-secs", "1.5", "/x", "std_msgs/msg/Empty")
    assert given_up.exit == 1
    assert given_up.stdout == "Waiting for at least 1 matching subscription(s)...\n" * 2
    assert given_up.stderr == "Timed out waiting for subscribers: Expected 1 subcribers but only got 0 subscribers\n"
    assert ros.clock.steady_ns() == pytest.approx(1.5e9, abs=1e8)


def test_pub_publishes_at_a_rate(ros) -> None:
    listener = ros.node(LISTENER)
    published = ros.ask("topic", "pub", "-r", "4", "-p", "3", "/chatter", "std_msgs/msg/String", stop_after=1.9)
    assert listener.stdout.count("heard") == 8
    assert [line for line in published.stdout.splitlines() if line.startswith("publishing")] == [
        "publishing #3: std_msgs.msg.String(data='')",
        "publishing #6: std_msgs.msg.String(data='')",
    ]
    assert published.exit == 2


def test_pub_fills_in_the_time(ros) -> None:
    stamped = ros.ask("topic", "pub", "-w", "0", "--once", "/p", "geometry_msgs/msg/PointStamped", "{header: auto}")
    assert "stamp=builtin_interfaces.msg.Time(sec=1700000000, nanosec=" in stamped.stdout
    now = ros.ask("topic", "pub", "-w", "0", "--once", "/p", "builtin_interfaces/msg/Time", "{sec: now}")
    assert now.exit == 1


def test_hz_prints_the_average_rate(ros) -> None:
    ros.node(COUNTER)
    measured = ros.ask("topic", "hz", "/count", stop_after=3.6)
    line = "average rate: 4.000\n\tmin: 0.250s max: 0.250s std dev: 0.00000s window: {}\n"
    assert measured.stdout == "".join(line.format(window) for window in (5, 9, 13))
    assert ros.ask("topic", "hz", "/count", "-w", "2", stop_after=1.6).stdout == line.format(2)


def test_hz_counts_filtered_messages_only(ros) -> None:
    ros.node(COUNTER)
    assert "average rate: 2.000\n" in ros.ask("topic", "hz", "/count", "--filter", "m.data % 2", stop_after=3.0).stdout


def test_hz_measures_arrivals_when_messages_waited_to_be_taken(ros, monkeypatch) -> None:
    from ros2cli.verbs import topic_rate

    def busy_at_first(node, topic, take, **how):
        def delayed(message, info):
            if not held:  # messages that arrive within a second wait, as while a type is being imported
                Clock(clock_type=ClockType.SYSTEM_TIME).sleep_for(Duration(seconds=1))
            held.append(message)
            take(message, info)

        held = []
        return subscribe(node, topic, delayed, **how)

    subscribe = topic_rate._subscribe
    monkeypatch.setattr(topic_rate, "_subscribe", busy_at_first)
    ros.node(COUNTER)
    measured = ros.ask("topic", "hz", "/count", stop_after=3.6).stdout
    assert set(re.findall("average rate: (.*)", measured)) == {"4.000"}


def test_bw_prints_bandwidth_and_message_sizes(ros) -> None:
    ros.node(COUNTER)
    reported = ros.ask("topic", "bw", "/count", stop_after=2.1).stdout.splitlines()
    assert reported[0] == "Subscribed to [/count]"
    assert reported[1].endswith(" B/s from 4 messages")
    assert reported[2] == "\tMessage size mean: 8 B min: 8 B max: 8 B"
    assert len(reported) == 5


def test_delay_prints_the_age_of_messages(ros) -> None:
    ros.node("""
from geometry_msgs.msg import PointStamped
node = Node('old')
publisher = node.create_publisher(PointStamped, 'p', 10)
def publish():
    point = PointStamped()
    stamp = node.get_clock().now() - rclpy.duration.Duration(seconds=0.125)
    point.header.stamp = stamp.to_msg()
    publisher.publish(point)
node.create_timer(0.5, publish)
""")
    reported = ros.ask("topic", "delay", "/p", stop_after=1.2).stdout
    assert reported.startswith("average delay: 0.125\n\tmin: 0.125s max: 0.125s std dev: 0.00000s window: ")
    assert ros.ask("topic", "delay", "/rosout", stop_after=1.0).exit in (1, 2)


def test_hz_waits_for_a_topic_to_appear(ros) -> None:
    waiting = ros.ros2("topic", "hz", "/count")
    ros.run(1.0)
    assert waiting.stdout == "WARNING: topic [/count] does not appear to be published yet\n"
    ros.node(COUNTER)
    assert "average rate: 4.000\n" in ros.finish(waiting, 3.0).stdout


def test_spread_returns_mean_extremes_and_deviation() -> None:
    from ros2cli.verbs.topic_rate import spread

    assert spread([1, 2, 3, 4]) == (2.5, 1, 4, math.sqrt(1.25))


JOINTS = """
from sensor_msgs.msg import JointState
node = Node('joints')
publisher = node.create_publisher(JointState, 'joints', 10)
def tell():
    message = JointState(name=['a', 'b'])
    message.header.stamp = node.get_clock().now().to_msg()
    publisher.publish(message)
node.create_timer(0.25, tell)
"""


def test_echo_filters_by_the_selected_field(ros) -> None:
    ros.node(JOINTS)
    words = ("topic", "echo", "/joints", "--once", "--field", "name")
    assert ros.ask(*words, "--filter", "len(m) == 2").stdout == "['a', 'b']\n---\n"
    assert ros.ask(*words, "--csv").stdout == "['a', 'b']\n---\n"


@pytest.mark.parametrize(
    ("field", "stdout", "stderr"),
    [
        ("header..frame_id.", "\n---\n", ""),  # empty parts are ignored
        ("header.nope", "", "Invalid field 'header.nope': 'Header' object has no attribute 'nope'\n"),
        (".", "", "Invalid field value '.'\n"),
    ],
)
def test_echo_prints_a_selected_field(ros, field: str, stdout: str, stderr: str) -> None:
    ros.node(JOINTS)
    asked = ros.ask("topic", "echo", "/joints", "--once", "--field", field)
    assert (asked.stdout, asked.stderr, asked.exit) == (stdout, stderr, int(bool(stderr)))


def test_echo_prints_message_info(ros) -> None:
    ros.node(COUNTER)
    block = ros.ask("topic", "echo", "/count", "--once", "-i").stdout.split("---\n")
    assert [line.split(":")[0] for line in block[0].splitlines()] == [
        "publication_sequence_number",
        "received_timestamp",
        "reception_sequence_number",
        "source_timestamp",
    ]
    assert block[1].startswith("data: ")
    field = ros.ask("topic", "echo", "/count", "--once", "-i", "--field", "data").stdout
    assert field.startswith("---Got new message, message info:---\n{'source_timestamp': ")


def test_delay_starts_with_the_second_message(ros) -> None:
    ros.node(JOINTS)
    assert ros.ask("topic", "delay", "/joints", stop_after=1.1).stdout == (
        "average delay: 0.000\n\tmin: 0.000s max: 0.000s std dev: 0.00000s window: 3\n"
    )


def test_delay_without_header_is_an_error_on_one_line(ros) -> None:
    ros.node(COUNTER)
    delay = ros.ask("topic", "delay", "/count")
    assert (delay.stdout, delay.stderr, delay.exit) == ("", "msg does not have header\n", 1)
