"""Command lines of rqt programs, in the spellings of real ROS 2 and of the course page."""

from __future__ import annotations

import pytest
from bot_console.tui.arrangement.rqt_command_line import RQT_PANES, Opening, is_rqt, matching, parse_rqt_command
from bot_console.tui.cli.arguments import parse


def opening(line: str) -> Opening:
    return parse_rqt_command(line.split())[0]


@pytest.mark.parametrize(
    "before", ["", "ros2 run rqt_plot ", "run rqt_plot ", "rqt -s ", "rqt --standalone=", "ros2 run "]
)
def test_topics_become_curves(before: str) -> None:
    line = f"{before}rqt_plot /robot/speed /robot/distance"
    assert is_rqt(line.split())
    assert opening(line) == Opening("plot", ("/robot/speed", "/robot/distance"))


def test_the_colon_of_rqt_plot_names_further_fields_and_a_relative_topic_is_one() -> None:
    assert opening("rqt_plot /pose/x:y robot/speed").curves == ("/pose/x", "/pose/y", "robot/speed")
    known = ["/pose/x", "/pose/y", "/robot/speed/data", "/robot/speeds/data"]
    assert matching("/pose/x", known) == ["/pose/x"]
    assert matching("/pose", known) == ["/pose/x", "/pose/y"]
    assert matching("robot/speed", known) == ["/robot/speed/data"]


def test_nested_fields_of_rqt_plot_use_slashes() -> None:
    known = ["/odom/twist.twist.linear.x", "/odom/twist.twist.linear.y", "/odom/twist.covariance[0]"]
    for wanted in ("/odom/twist/twist/linear/x", "odom/twist.twist.linear.x"):
        assert matching(wanted, known) == known[:1]
    assert matching("/odom/twist/twist/linear", known) == matching("/odom/twist", known) == known[:2]


@pytest.mark.parametrize("line", ["rqt_reconfigure /arm", "ros2 run rqt_reconfigure rqt_reconfigure arm"])
def test_node_is_preselected(line: str) -> None:
    assert opening(line) == Opening("parameters", node="/arm")


@pytest.mark.parametrize(
    "line",
    [
        "rqt_robot_steering --default_topic /base/cmd --ros-args -p publish_rate:=20.0",
        "run rqt_robot_steering rqt_robot_steering --ros-args -p default_topic:=/base/cmd --param publish_rate:=20",
    ],
)
def test_steering_takes_topic_and_rate_from_its_parameters(line: str) -> None:
    assert opening(line) == Opening("steering", topic="/base/cmd", rate=20.0)
    assert parse_rqt_command(line.split())[1] == []


@pytest.mark.parametrize(("program", "pane"), RQT_PANES.items())
def test_every_program_has_its_pane(program: str, pane: str) -> None:
    for line in (program, f"ros2 run {program} {program}", f"run {program} {program}"):
        assert opening(line) == Opening(pane)
        assert parse(line.split()).opening == Opening(pane)


@pytest.mark.parametrize(
    ("line", "note"),
    [
        ("rqt_plot -P /a", "-P of rqt_plot is ignored"),
        ("rqt_plot --default_topic /cmd", "--default_topic /cmd of rqt_plot is ignored"),
        ("rqt_robot_steering --ros-args -p publish_rate:=500", "publish_rate:=500 is not a number from 1 to 50"),
        ("rqt_robot_steering --ros-args -p publish_rate:=fast", "publish_rate:=fast is not a number from 1 to 50"),
        ("rqt_robot_steering --ros-args -p speed:=1", "the parameter speed of rqt_robot_steering is ignored"),
        ("rqt_plot --ros-args -p default_topic:=/a", "the parameter default_topic of rqt_plot is ignored"),
        ("rqt -s rqt_bag", "there is no pane for rqt_bag"),
    ],
)
def test_ignored_options_are_reported(line: str, note: str) -> None:
    assert [each.startswith(note) for each in opening(line).notes] == [True]


@pytest.mark.parametrize("line", ["rqt --perspective-file ~/a.ini", "rqt -p ~/a.ini", "rqt_gui --perspective=~/a.ini"])
def test_a_perspective_is_taken(line: str) -> None:
    assert opening(line) == Opening(perspective="~/a.ini")


def test_other_arguments_are_left_to_bot_console(capsys: pytest.CaptureFixture[str]) -> None:
    given = parse(["rqt_plot", "/a/b", "outdoor", "seed:=7"])
    assert (given.profile, given.launch_arguments, given.opening.curves) == ("outdoor", {"seed": "7"}, ("/a/b",))
    with pytest.raises(SystemExit):
        parse(["rqt_plot", "nonsense"])
    assert "there is no profile and no command 'nonsense'" in capsys.readouterr().err
    assert not is_rqt(["run", "my_rqt_plugin.py"])
