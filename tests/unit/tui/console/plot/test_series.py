"""Series and paths into messages."""

import pytest
from bot_console.tui.console.plot.series import NotPlottable, Series, parse_steps, reader


def test_samples_are_read_by_cursor_and_the_oldest_fall_out() -> None:
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
def test_paths(text: str, steps: tuple[str | int, ...]) -> None:
    assert parse_steps(text) == steps


@pytest.mark.parametrize("text", ["", "a..b", "a[", "3a", "a b"])
def test_bad_paths(text: str) -> None:
    with pytest.raises(NotPlottable, match="field path"):
        parse_steps(text)


def test_reading_a_message() -> None:
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
