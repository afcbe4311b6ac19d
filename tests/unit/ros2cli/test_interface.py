"""`ros2 interface` prints definitions as they are written."""

from __future__ import annotations

import pytest
from ros2cli import interface_text


def test_show_prints_comments_of_the_top_level_only(ros) -> None:
    shown = ros.ask("interface", "show", "geometry_msgs/msg/Twist").stdout
    assert shown.startswith("# ")
    nested = ros.ask("interface", "show", "nav_msgs/msg/Odometry").stdout
    assert "\tfloat64 x\n" in nested
    assert "\t#" not in nested
    assert "\t#" in ros.ask("interface", "show", "nav_msgs/msg/Odometry", "--all-comments").stdout
    assert "#" not in ros.ask("interface", "show", "nav_msgs/msg/Odometry", "--no-comments").stdout


def test_show_without_comments_leaves_no_bare_number_sign(ros) -> None:
    shown = ros.ask("interface", "show", "rcl_interfaces/msg/ParameterDescriptor", "--no-comments").stdout
    assert "#" not in shown and "\n\n" not in shown
    assert "#\n" in ros.ask("interface", "show", "rcl_interfaces/msg/ParameterDescriptor").stdout


DEFINITION = """# Comment
#
  #
##
string COLOUR="#ff0000"  # red
string QUOTED='a # b'    # a value with a number sign
string first "x # y" # a default with one
int32 LIMIT=3#no blank
uint8[] data      # [a, b]
"""


def test_number_sign_inside_a_constant_does_not_start_a_comment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interface_text, "definition_text", lambda *names: DEFINITION)
    assert interface_text.show_text("std_msgs/msg/String", no_comments=True).splitlines() == [
        'string COLOUR="#ff0000"',
        "string QUOTED='a # b'",
        'string first "x # y"',
        "int32 LIMIT=3",
        "uint8[] data",
    ]
    assert interface_text.show_text("std_msgs/msg/String") == DEFINITION


def test_show_prints_services_and_actions(ros) -> None:
    assert (
        ros.ask("interface", "show", "example_interfaces/srv/AddTwoInts").stdout == "int64 a\nint64 b\n---\nint64 sum\n"
    )
    assert (
        ros.ask("interface", "show", "example_interfaces/action/Fibonacci", "--no-comments").stdout.count("---\n") == 2
    )


def test_list_groups_interfaces_and_packages_are_listed(ros) -> None:
    listed = ros.ask("interface", "list").stdout
    assert listed.startswith("Messages:\n    ")
    assert "\nServices:\n    " in listed
    assert "\nActions:\n    " in listed
    assert "Services:" not in ros.ask("interface", "list", "-m").stdout
    packages = ros.ask("interface", "packages", "-a").stdout.split()
    assert "example_interfaces" in packages
    assert "std_msgs" not in packages
    own = ros.ask("interface", "package", "example_interfaces", "-s").stdout.split()
    assert "example_interfaces/srv/AddTwoInts" in own
    assert all("/srv/" in each for each in own)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("std_msgs/msg/Int32", "data: 0\n"),
        ("example_interfaces/srv/AddTwoInts", "a: 0\nb: 0\n"),
        ("example_interfaces/action/Fibonacci", "order: 0\n"),
        ("geometry_msgs/msg/Quaternion", "x: 0.0\ny: 0.0\nz: 0.0\nw: 1.0\n"),
    ],
)
def test_proto_prints_a_prototype(ros, name: str, text: str) -> None:
    assert ros.ask("interface", "proto", name).stdout == f'"{text}"\n'
    assert ros.ask("interface", "proto", name, "--no-quotes").stdout == f"{text}\n"
