"""Messages of nodes and networks, and how they are shown: each function feeds a text to one part."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from typing import Any


def message_yaml(text: str) -> None:
    from rclpy.serialization import serialize_message
    from ros2cli.yaml_values import read_values
    from rosidl_runtime_py.set_message import set_message_fields
    from sensor_msgs.msg import LaserScan

    try:
        values = read_values(text)
    except RecursionError:
        raise
    except RuntimeError:  # how the verbs report exceptions of the library
        return
    if isinstance(values, dict):
        message = LaserScan()
        set_message_fields(message, values)
        serialize_message(message)  # messages that could not be sent are never shown
        reported(message)


def cdr(text: str) -> None:
    from diagnostic_msgs.msg import DiagnosticArray
    from rclpy.serialization import deserialize_message
    from sensor_msgs.msg import LaserScan

    data = text.encode("latin-1", "replace")
    for each in (DiagnosticArray, LaserScan):
        with contextlib.suppress(RuntimeError):
            reported(deserialize_message(data, each))


def cdr_seeds() -> Sequence[str]:
    from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
    from rclpy.serialization import serialize_message
    from sensor_msgs.msg import LaserScan

    status = DiagnosticStatus(name="n", message="m", values=[KeyValue(key="a", value="b")])
    messages = (DiagnosticArray(status=[status, status]), LaserScan(ranges=[1.0, 2.0, 3.0]))
    return [serialize_message(each).decode("latin-1") for each in messages]


def reported(message: Any) -> None:
    """Format a message as panes and verbs show it."""
    from bot_console.tui.console.topics.message_tree import tree
    from rosidl_runtime_py import message_to_csv, message_to_yaml

    package, _, name = type(message).__module__.partition(".")[0], "", type(message).__name__
    tree(message, f"{package}/msg/{name}")
    message_to_yaml(message)
    message_to_csv(message)


def shown(value: Any) -> None:
    from bot_console.tui.format import field_text
    from bot_console.tui.text.value_text import value_text

    value_text(value)
    value_text(value, exact=True)
    field_text(value)


def pane_text(text: str) -> None:
    """Text written by a node or a person, as all panes show it."""
    from bot_console.tui.console.model import ConsoleSnapshot
    from bot_console.tui.console.robot.robot_model import DriveInfo, RobotStop
    from bot_console.tui.safety.stop_wording import release_question
    from bot_console.tui.text.sanitize import brief, cut, sanitize
    from bot_console.tui.text.value_text import value_text, yaml_text
    from bot_console.tui.widgets.status_bar import status_text
    from rich.text import Text

    shown = sanitize(text)
    assert not any(ord(each) < 32 or 0x7F <= ord(each) < 0xA0 for each in shown), repr(shown)
    for width in (0, 1, 7, 80):
        assert Text(cut(text, width)).cell_len <= width
    brief(text)
    yaml_text(text)
    value_text(text)
    drive = DriveInfo(
        stopped=True, stop_confirmed=True, lockable=True, stop_holder=text, stop_reason=text, limited_by=text
    )
    line = status_text(ConsoleSnapshot(drive=drive, problem=text))
    assert "\x1b" not in line
    release_question([RobotStop(text, text, text)], lambda _: None, lambda: "")


def stop(text: str) -> None:
    from bot_console.tui.console.robot.lock_state import LockState
    from bot_console_robot.safety.latch import Latch
    from bot_console_robot.safety.stop_messages import State, parse_request, parse_state, state_message
    from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

    keys = (
        *("request", "id", "ids", "of", "challenges", "kept"),
        *("locked", "holder", "stops", "released", "turn", "instance", "challenge"),
    )
    pairs = [KeyValue(key=key, value=text) for key in keys]
    message = DiagnosticStatus(name=text, message=text, hardware_id=text, values=pairs)
    latch = Latch()
    latch.request(parse_request(message), 0)
    latch.follow(parse_state(message).lock)
    state = state_message(State(latch.lock, "1", latch.challenge, latch.steered_by), "n")
    assert parse_state(state).lock == latch.lock
    LockState.of({each.key: each.value for each in message.values}).holds("1", "a")
    assert parse_state(message).lock.held or text == "false"


def key_expressions(text: str) -> None:
    from bot_console.runtime.rmw.zenoh.wire.keys import demangle, ros_type

    demangle(text)
    ros_type(text)


def printed(text: str) -> None:
    from bot_console.tui.console.logs.tracebacks import PrintedLines

    reader = PrintedLines("n", lambda level, label, line: None, stderr=True)
    for line in text.split("\n"):
        reader.line(line)
    reader.close()
