"""Series and paths into messages."""

import math
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.tui.console.model import Endpoint, GraphInfo
from bot_console.tui.console.plot.arrays import NotPlottable
from bot_console.tui.console.plot.paths import number_paths
from bot_console.tui.console.plot.series import Series, parse_path, parse_steps, reader
from bot_console.tui.console.plot.watch import PlotWatch
from bot_console.tui.console.topics import meters


def test_samples_are_read_by_cursor_and_the_oldest_are_dropped() -> None:
    series = Series(4)
    for number in range(6):
        series.add(number, number * 10.0)
    everything = series.after(0)
    assert list(everything.times) == [2, 3, 4, 5]
    series.add(6, 60.0)
    assert list(series.after(everything.cursor).values) == [60.0]
    assert series.after(7).cursor == 7
    assert list(series.after(7).values) == []


@pytest.mark.parametrize(
    ("text", "steps"),
    [("linear.x", ("linear", "x")), ("pose/pose.position.x", ("pose", "pose", "position", "x")),
     ("ranges[3]", ("ranges", 3)), ("data", ("data",)), ("a[-1].b", ("a", -1, "b"))],
)  # fmt: skip
def test_field_paths_are_parsed_into_steps(text: str, steps: tuple[str | int, ...]) -> None:
    assert parse_steps(text) == steps


@pytest.mark.parametrize("text", ["", "a..b", "a[", "3a", "a b"])
def test_invalid_paths_are_refused(text: str) -> None:
    with pytest.raises(NotPlottable, match="field path"):
        parse_steps(text)


def test_a_path_reads_the_number_from_a_message() -> None:
    from geometry_msgs.msg import Twist
    from sensor_msgs.msg import LaserScan
    from std_msgs.msg import Bool, String

    assert reader(("linear", "x"))(Twist()) == 0.0
    assert reader(("data",))(Bool(data=True)) == 1.0
    assert reader(("ranges", 1))(LaserScan(ranges=[1.0, 2.5])) == 2.5
    with pytest.raises(NotPlottable, match="no field 'y'; fields here: linear, angular"):
        reader(("y",))(Twist())
    with pytest.raises(NotPlottable, match="linear is a message with the fields x, y, z"):
        reader(("linear",))(Twist())
    with pytest.raises(NotPlottable, match="data is text"):
        reader(("data",))(String())
    with pytest.raises(NotPlottable, match=r"no element \[9\]"):
        reader(("ranges", 9))(LaserScan())


def test_an_array_is_reduced_to_one_number_ignoring_infinite_elements():
    from geometry_msgs.msg import Quaternion
    from sensor_msgs.msg import LaserScan

    scan = LaserScan(ranges=[4.0, float("inf"), 1.0, 2.0])
    made = {
        name: reader(*parse_path(f"ranges{where}.{name}()"))(scan)
        for name, where in {"min": "", "max": "[1:3]", "mean": "[2:]", "sum": "[:1]", "len": "", "std": "[-1:]"}.items()
    }
    assert made == {"min": 1.0, "max": 1.0, "mean": 1.5, "sum": 4.0, "len": 4.0, "std": 0.0}
    assert math.isnan(reader(*parse_path("ranges[1:2].min()"))(scan)), "an array without finite values is a gap"
    turned = Quaternion(z=0.5**0.5, w=0.5**0.5)
    from geometry_msgs.msg import Pose

    assert reader(*parse_path("orientation.yaw()"))(Pose(orientation=turned)) == pytest.approx(1.5707963)
    for path, why in (
        ("angle_min.mean()", "not an array"), ("header.frame_id.len()", "not an array"),
        ("ranges.yaw()", "not a quaternion"),
        ("ranges[0:2]", "not a number"), ("header.min()", "not an array"),
    ):  # fmt: skip
        with pytest.raises(NotPlottable, match=why):
            reader(*parse_path(path))(scan)
    with pytest.raises(NotPlottable, match="array are min, max, mean"):
        parse_path("ranges.median()")


def test_suggested_paths_are_fields_then_elements_then_array_functions():
    paths = number_paths("sensor_msgs/msg/LaserScan")
    assert paths[0] == "header.stamp.sec" and paths.index("range_max") < paths.index("ranges[0]")
    assert paths[-3:] == ("intensities.min()", "intensities.max()", "intensities.mean()")
    assert "pose.pose.orientation.yaw()" in number_paths("nav_msgs/msg/Odometry")
    assert number_paths("no_such/msg/Thing") == ()


def test_feedback_of_an_action_has_paths_into_its_own_fields() -> None:
    paths = number_paths("example_interfaces/action/Fibonacci_FeedbackMessage")
    assert "feedback.sequence[0]" in paths and "goal_id.uuid[0]" in paths


def test_the_colon_of_a_slice_does_not_mark_a_parameter() -> None:
    made: list[str] = []
    node: Any = SimpleNamespace(create_subscription=lambda kind, topic, take, qos, raw: made.append(topic))
    graph = GraphInfo(topics=(Endpoint("/scan", ("sensor_msgs/msg/LaserScan",)),))
    answer = PlotWatch(node).watch("/scan/ranges[80:100].min()", graph, {})
    assert answer.ok and made == ["/scan"], answer.text


class CountingNode:
    """A node whose only subscription and timer are called by the test."""

    def __init__(self) -> None:
        self.take: Any = None
        self.poll: Any = None
        self.left: list[str] = []

    def create_subscription(self, kind: Any, topic: str, take: Any, qos: Any, *, raw: bool) -> str:
        assert raw, "counting does not unpack"
        self.take = take
        return topic

    def create_timer(self, period: float, poll: Any) -> str:
        self.poll = poll
        return "timer"

    def destroy_subscription(self, subscription: str) -> None:
        self.left.append(subscription)

    destroy_timer = destroy_subscription


def test_rate_of_a_topic_is_a_series_that_falls_to_zero_in_silence(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(meters, "time", SimpleNamespace(monotonic=lambda: now[0], time_ns=lambda: int(now[0] * 1e9)))
    node: Any = CountingNode()
    watch = PlotWatch(node)
    graph = GraphInfo(topics=(Endpoint("/scan", ("sensor_msgs/msg/LaserScan",)),))
    assert watch.watch("rate(/scan)", graph, {}).ok
    for _ in range(40):
        now[0] += 0.1
        node.take(b"\0" * 40, {"received_timestamp": None})
        node.poll()
    assert watch.samples("rate(/scan)", 0).values[-1] == pytest.approx(10.0, abs=0.1)
    for _ in range(20):
        now[0] += 0.5
        node.poll()
    assert watch.samples("rate(/scan)", 0).values[-1] == 0.0
    watch.unwatch("rate(/scan)")
    assert node.left == ["/scan", "timer"] and len(watch.samples("rate(/scan)", 0).values) == 0


def test_rate_of_a_topic_that_is_not_there_is_refused() -> None:
    answer = PlotWatch(SimpleNamespace()).watch("rate(/nowhere)", GraphInfo(), {})  # type: ignore[arg-type]
    assert not answer.ok and answer.text == "there is no topic /nowhere"
