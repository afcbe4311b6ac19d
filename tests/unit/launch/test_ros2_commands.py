"""`ros2 ...` as the command of a process: which command lines need no shell and run inside bot-console."""

from __future__ import annotations

import pytest
from launch.ros2_commands import ros2_words

ROWS: list[tuple[list[str], bool, list[str] | None]] = [
    (["ros2", "topic", "list"], False, ["topic", "list"]),
    (["/opt/ros/bin/ros2", "node", "list"], False, ["node", "list"]),
    (["echo", "ros2"], False, None),
    (["ros2", "bag", "record", "-a"], False, None),  # a separate program
    (["ros2 daemon stop"], True, None),
    (["ros2"], False, []),
    (
        ["ros2 service call /spawn a/srv/B \"{x: 2, name: 'a b'}\""],
        True,
        ["service", "call", "/spawn", "a/srv/B", "{x: 2, name: 'a b'}"],
    ),
    (["ros2", "param", "set /n p '$5'"], True, ["param", "set", "/n", "p", "$5"]),
    (["ros2 topic list | wc -l"], True, None),
    (["ros2 topic list && true"], True, None),
    (["ros2 topic echo $TOPIC"], True, None),
    (['ros2 topic echo "$TOPIC"'], True, None),
    (["ros2 topic echo /a*"], True, None),
    (["ros2 topic list '"], True, None),
    ([""], True, None),
]


@pytest.mark.parametrize(("command", "shell", "words"), ROWS)
def test_ros2_command_is_recognized(command: list[str], shell: bool, words: list[str] | None) -> None:
    assert ros2_words(command, shell) == words
