"""Parsing ROS arguments."""

from __future__ import annotations

from bot_console.tui.console.launch.ros_arguments import RosArguments, read_ros_arguments


def test_arguments_are_sorted_by_purpose() -> None:
    words = "--fast --ros-args -r __node:=bob -r __ns:=/ns -r a:=b -p x:=1 --params-file f.yaml --log-level warn -- -v"
    assert read_ros_arguments(words.split()) == RosArguments(
        ("--fast", "-v"),
        "bob",
        "/ns",
        (("a", "b"),),
        ("-p", "x:=1", "--params-file", "f.yaml"),
        ("--log-level", "warn"),
    )


def test_the_first_of_several_names_counts_and_an_unfinished_line_is_accepted() -> None:
    words = "--ros-args -r __node:=a --ros-args -r __node:=b --disable-rosout-logs -r"
    found = read_ros_arguments(words.split())
    assert (found.name, found.others) == ("a", ("--disable-rosout-logs",))
    assert read_ros_arguments(["--", "x"]).arguments == ("--", "x"), "`--` ends ROS arguments only within them"
