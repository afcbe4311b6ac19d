"""Input that people type: each function feeds a text to one parser."""

from __future__ import annotations

import contextlib
import io
import re
import shlex
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from messages import shown


def substitution(text: str) -> None:
    from launch.frontend.parse_substitution import parse_substitution

    parse_substitution(text)


def ros_arguments(text: str) -> None:
    from bot_console.runtime.rmw.arguments import parse

    parse(text.split(" "))


def quietly(run: Callable[[Sequence[str]], object]) -> Callable[[str], None]:
    """Run a command line; exiting counts as an answer."""

    def fed(text: str) -> None:
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output), contextlib.suppress(SystemExit):
            run(text.split(" "))

    return fed


def verbs(words: Sequence[str]) -> None:
    parsers = verb_parsers()
    parsers.get(words[0], parsers["topic"]).parse_args(words)


@cache
def verb_parsers() -> dict[str, Any]:
    from ros2cli import command_line

    found: dict[str, Any] = {}
    for name in command_line.COMMANDS:
        top = command_line.top_parser()
        command = command_line.load(name)
        assert command is not None
        command_line.add_command(top, command, [each.name for each in command.verbs])
        found[name] = top
    return found


def console_line(words: Sequence[str]) -> None:
    from bot_console.tui.cli.arguments import parse

    parse(words)


def line(text: str) -> None:
    from bot_console.tui.arrangement.rqt_command_line import is_rqt, parse_rqt_command

    if is_rqt(text.split()):
        parse_rqt_command(text.split())
    else:
        shlex.split(text)


def interface_verbs(words: Sequence[str]) -> None:
    from ros2cli.command_line import main

    with contextlib.redirect_stderr(io.StringIO()) as output:
        main(["interface", *words])
    # As in ROS 2, a name missing from a package is reported by this line below a traceback.
    recorded = re.fullmatch(r".*AttributeError: module '\S+' has no attribute '\w+'\n", output.getvalue(), re.DOTALL)
    assert recorded or "Traceback" not in output.getvalue(), output.getvalue()


def filter(text: str) -> None:
    from bot_console.tui.console.filter_syntax import parse
    from bot_console.tui.console.logs.search import matching
    from bot_console.tui.console.model import LogFilter

    query = parse(text)
    query.matches("a text: Speed 1.0 m/s", "/robot_navigator")
    matching(log(), LogFilter(words=text))


@cache
def log() -> Any:
    from bot_console.tui.console.logs.store import LogStore

    store = LogStore()
    for number in range(100):
        store.add(number, 10 * (number % 5 + 1), "/robot_navigator", f"Speed {number / 10} m/s\nor [{number}] %%")
    return store


def plot(text: str) -> None:
    from bot_console.tui.console.plot.series import NotPlottable, parse_path, reader
    from geometry_msgs.msg import PoseWithCovarianceStamped
    from sensor_msgs.msg import LaserScan

    read = reader(*parse_path(text))
    for message in (LaserScan(ranges=[1.0]), PoseWithCovarianceStamped()):
        with contextlib.suppress(NotPlottable):
            read(message)


def expression(text: str) -> None:
    import numpy as np
    from bot_console.tui.panes.plot.formulas.formula import HeldValues, parse_formula, split_expressions
    from bot_console.tui.text.expression.numbers import evaluate

    with contextlib.suppress(ValueError):
        evaluate(text, {"x": 2.0})
    split_expressions(text)
    found = parse_formula(text)
    if not isinstance(found, str):
        held = HeldValues(np.arange(50.0), np.linspace(-1.0, 1.0, 50))
        try:
            times, values = found.values(dict.fromkeys(found.paths, held))
        except ValueError as error:
            raise AssertionError(f"read, but not worked out: {error}") from error
        assert len(times) == len(values) == 50


def condition(text: str) -> None:
    from bot_console.tui.panes.alarms.condition import parse_condition

    found = parse_condition(text)
    for value in (-1.5, 0.0, 1e300):
        with contextlib.suppress(ValueError):
            assert found.holds(dict.fromkeys(found.paths, value)) in (True, False)


def typed_value(text: str) -> None:
    from bot_console.tui import format as words
    from bot_console.tui.console.model import Kind, ParameterInfo

    with contextlib.suppress(ValueError):
        words.guess(text)
    for kind in Kind:
        with contextlib.suppress(ValueError):
            value = words.parse_value(text, ParameterInfo("/n", "p", kind, 0))
            shown(value)
            words.command_of(ParameterInfo("/n", "p", kind, 0), value)
        if kind.name.endswith("ARRAY"):
            with contextlib.suppress(ValueError):
                words.parse_element(text, kind)


def typed_field(text: str) -> None:
    from bot_console.tui.console.topics.typed import parse

    for kind in (
        "double",
        "int8",
        "uint64",
        "boolean",
        "string",
        "octet",
        "sequence<double>",
        "string<5>",
        "builtin_interfaces/Time",
        "geometry_msgs/Point",
    ):
        with contextlib.suppress(ValueError):
            parse(kind, text)


def typed_path(text: str) -> None:
    from bot_console.tui.files.save_file import typed_path

    typed_path(text)
