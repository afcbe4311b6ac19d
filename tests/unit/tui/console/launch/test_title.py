"""The title of a launch: its file, or the one program that the user has named."""

import pytest
from bot_console.tui.console.launch.title import argument_line, title_of, unique_title


@pytest.mark.parametrize(
    ("path", "arguments", "title"),
    [
        ("/a/robot.launch.py", {"program": "talker"}, "robot.launch.py"),
        ("/a/program.launch.py", {"program": "talker", "package": "mine"}, "talker"),
        ("/a/program.launch.py", {"program": "/home/me/node.py"}, "node.py"),
        ("/a/program.launch.py", {}, "program.launch.py"),
    ],
)
def test_the_title_is_the_file_or_program_named_by_the_user(path, arguments, title):
    assert title_of(path, arguments) == title


def test_duplicate_titles_are_numbered_and_free_numbers_reused():
    assert unique_title("a", ()) == "a"
    assert unique_title("a", {"a", "a (2)"}) == "a (3)"
    assert unique_title("a", {"b", "a (2)"}) == "a"


def test_the_argument_line_repeats_the_request() -> None:
    assert argument_line("/a/robot.launch.py", {"world": "maze"}) == "launch /a/robot.launch.py world:=maze"
    assert argument_line("/a/robot.launch.py", {}) == "launch /a/robot.launch.py"
    talker = {"package": "mine", "program": "talker", "words": "--ros-args -r a:=b"}
    assert argument_line("/site-packages/a/program.launch.py", talker) == "run mine talker --ros-args -r a:=b"
    assert argument_line("/a/program.launch.py", {"program": "/home/me/node.py", "words": ""}) == "run /home/me/node.py"
    assert argument_line("/a/program.launch.py", {}) == "launch /a/program.launch.py"
