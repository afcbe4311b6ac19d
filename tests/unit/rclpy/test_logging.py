"""Logging: levels, filters by call site, lines, `/rosout`."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from rcl_interfaces.msg import Log
from rclpy import logging
from rclpy._rclpy_pybind11 import RCLError
from rclpy.clock import Clock
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.impl.log_format import Formatter
from rclpy.logging import LoggingSeverity
from rclpy.qos import DurabilityPolicy, QoSProfile

_names = itertools.count()


@pytest.fixture
def log() -> Iterator[Any]:
    """A logger that no other test has used."""
    yield logging.get_logger(f"logger{next(_names)}")
    logging.clear_config()


@pytest.fixture
def printed(capfd: pytest.CaptureFixture[str]) -> Callable[[], list[str]]:
    """Return the lines printed since the last call, without time and logger."""

    def lines() -> list[str]:
        return [re.sub(r"\[\d{10}\.\d{9}\] \[[\w.]+\]: ", "", line) for line in capfd.readouterr().err.splitlines()]

    return lines


def test_each_severity_prints_its_line(log: Any, printed: Callable[[], list[str]]) -> None:
    assert [log.debug("d"), log.info("i"), log.warning("w"), log.warn("w2"), log.error("e"), log.fatal("f")] == [
        *(False, True, True, True, True, True)
    ]
    assert printed() == ["[INFO] i", "[WARN] w", "[WARN] w2", "[ERROR] e", "[FATAL] f"]
    assert [(each.name, int(each)) for each in LoggingSeverity] == [
        *(("UNSET", 0), ("DEBUG", 10), ("INFO", 20), ("WARN", 30), ("ERROR", 40), ("FATAL", 50))
    ]


@pytest.mark.parametrize(
    ("options", "answers"),
    [
        ({}, [True, True, True, True]),
        ({"once": True}, [True, False, False, False]),
        ({"skip_first": True}, [False, True, True, True]),
        ({"skip_first": True, "once": True}, [False, True, False, False]),
        ({"once": False}, [True, True, True, True]),
        ({"throttle_duration_sec": 100.0}, [True, False, False, False]),
        ({"throttle_duration_sec": 100}, [True, False, False, False]),
        ({"throttle_duration_sec": 100.0, "skip_first": True}, [False, False, False, False]),
    ],
)
def test_filters_limit_messages(log: Any, options: dict[str, Any], answers: list[bool]) -> None:
    assert [log.info("x", **options) for _ in range(4)] == answers


def test_throttle_follows_its_clock(stepped_ros: Any, log: Any) -> None:
    context, clock = stepped_ros.init(), Clock()
    answers = []
    for _ in range(5):
        answers.append(log.info("x", throttle_duration_sec=1.0, throttle_time_source_type=clock))
        clock.sleep_for(Duration(seconds=0.4), context)
    assert answers == [True, False, False, True, False]


def test_filters_are_kept_per_call_site(log: Any) -> None:
    answers = []
    for _ in range(2):
        answers.append(log.info("a", once=True))
        answers.append(log.info("b", once=True))
    assert answers == [True, True, False, False]


def test_call_site_may_not_change_its_severity(log: Any) -> None:
    def show_text(severity: int, **options: Any) -> Any:
        return log.log("x", severity, **options)

    assert show_text(20)
    with pytest.raises(ValueError, match=r"^Logger severity cannot be changed between calls.$"):
        show_text(30)
    with pytest.raises(ValueError, match=r"^Requested logging filters cannot be changed between calls.$"):
        show_text(20, once=True)

    def throttled(seconds: float) -> Any:
        return log.info("x", throttle_duration_sec=seconds)

    throttled(1.0)
    with pytest.raises(ValueError, match=r"^Logging filter parameters cannot be changed between calls.$"):
        throttled(2.0)


def test_severity_of_a_call_site_is_kept_per_logger(log: Any) -> None:
    def show_text(logger: Any, method: str) -> Any:
        return getattr(logger, method)("x")

    assert show_text(log, "info") and show_text(log.get_child("other"), "error")


@pytest.mark.parametrize(
    ("message", "options", "kind", "words"),
    [
        ("x", {"foo": 1}, TypeError, 'parameter "foo" is not one of the recognized logging options'),
        ("x", {"throttle_time_source_type": Clock()}, TypeError, 'required parameter "throttle_duration_sec" not'),
        (
            "x",
            {"throttle_duration_sec": 1.0, "throttle_time_source_type": "ROS"},
            ValueError,
            'Received throttle_time_source_type of "ROS" is not a clock instance',
        ),
        (5, {}, TypeError, "must be a string"),
        ([], {}, TypeError, "must be a string"),
    ],
)
def test_invalid_filters_are_rejected(
    log: Any, message: Any, options: dict[str, Any], kind: type[Exception], words: str
) -> None:
    with pytest.raises(kind, match=words):
        log.info(message, **options)


@pytest.mark.parametrize(("message", "text"), [(None, "(null)"), (b"bytes", "bytes"), ("", "")])
def test_non_text_messages_are_converted(log: Any, message: Any, text: str, printed: Callable[[], list[str]]) -> None:
    assert log.info(message)
    assert printed() == [f"[INFO] {text}"]
    assert log.debug(5) is False, "arguments of suppressed messages are not evaluated"


def test_printf_style_is_rejected(log: Any) -> None:
    with pytest.raises(TypeError):
        log.info("x %d", 5)


@pytest.mark.parametrize(
    ("levels", "name", "effective"),
    [
        ({}, "a.b", 20),
        ({"a": 40}, "a.b.c", 40),
        ({"a": 40, "a.b": 10}, "a.b.c", 10),
        ({"a.b": 10}, "a", 20),
        ({"a.b": 10}, "a.bc", 20),
        ({"": 50}, "z", 50),
        ({"a": 40, "a.b": 0}, "a.b", 40),
    ],
)
def test_levels_are_inherited_by_dotted_names(levels: dict[str, int], name: str, effective: int, log: Any) -> None:
    for logger, level in levels.items():
        logging.set_logger_level(logger, level)
    assert logging.get_logger_effective_level(name) == effective
    assert logging.get_logger(name).get_effective_level() == effective
    assert logging.get_logger(name).is_enabled_for(LoggingSeverity.FATAL)


def test_level_of_a_logger_can_be_set_and_queried(log: Any) -> None:
    assert logging.get_logger_level(log.name) == LoggingSeverity.UNSET
    assert log.set_level(LoggingSeverity.ERROR) is None
    assert logging.get_logger_level(log.name) == LoggingSeverity.ERROR
    assert (log.is_enabled_for(40), log.is_enabled_for(30)) == (True, False)
    for wrong in (42, "ERROR"):
        with pytest.raises(ValueError, match="is not a valid LoggingSeverity"):
            log.set_level(wrong)
    assert log.get_effective_level() is LoggingSeverity.ERROR


@pytest.mark.parametrize("word", ["INFO", "info", "Info"])
def test_severities_are_found_by_name(word: str) -> None:
    assert logging.get_logging_severity_from_string(word) is LoggingSeverity.INFO
    for wrong in ("WARNING", "", "foo"):
        with pytest.raises(RuntimeError):
            logging.get_logging_severity_from_string(wrong)


def test_child_loggers_have_dotted_names(log: Any) -> None:
    assert log.get_child("a").get_child("b").name == f"{log.name}.a.b"
    with pytest.raises(ValueError, match=r"^Child logger name must not be empty.$"):
        log.get_child("")
    with pytest.raises(ValueError, match=r"^Logger name must not be empty.$"):
        logging.get_logger("").get_child("a")


STAMP = 1_700_000_000_000_000_005


@pytest.mark.parametrize(
    ("pattern", "line"),
    [
        ("", "[INFO] [1700000000.000000005] [n]: hi"),
        ("{severity}", "INFO"),
        ("fixed", "fixed"),
        ("{message", "{message"),
        ("{{message}}", "{hi}"),
        ("{message} {message}", "hi hi"),
        ("{nonsense} {name}", "{nonsense} n"),
        ("{message}\\n{name}\\t.", "hi\nn\t."),
        ("{function_name}:{line_number} {file_name}", "f:7 x.py"),
        ("{time_as_nanoseconds}", "1700000000000000005"),
    ],
)
def test_output_format_is_applied(pattern: str, line: str) -> None:
    formatter = Formatter(pattern, "0", to_stdout=False)
    assert formatter.line(20, "n", "hi", "x.py", "f", 7, STAMP) == line


@pytest.mark.parametrize(
    ("severity", "begin"), [(10, "\033[32m"), (20, "\033[0m"), (30, "\033[33m"), (40, "\033[31m"), (50, "\033[31m")]
)
def test_colours_follow_severity(severity: int, begin: str, capsys: pytest.CaptureFixture[str]) -> None:
    Formatter("{message}", "1", to_stdout=True).write(severity, "n", "hi", "x.py", "f", 7, STAMP)
    assert capsys.readouterr().out == f"{begin}hi\033[0m\n"


def test_messages_are_published_on_rosout(ros: Any) -> None:
    node, observer, got = ros.node("talker"), ros.node("observer"), []
    observer.create_subscription(Log, "/rosout", got.append, 100)
    node.get_logger().warning("careful")
    node.get_logger().debug("unheard")
    node.get_logger().get_child("part").info("child")
    logging.get_logger("stranger").info("no node's")
    ros.settle()
    assert [(each.name, each.level, each.msg) for each in got] == [
        ("talker", 30, "careful"),
        ("talker.part", 20, "child"),
    ]
    assert (
        got[0].file.endswith("test_logging.py")
        and got[0].function == "test_messages_are_published_on_rosout"
        and got[0].line > 0
    )
    assert got[0].stamp.sec > 1_600_000_000


def test_rosout_keeps_messages_for_late_joiners(ros: Any) -> None:
    ros.node("talker").get_logger().info("early")
    observer, got = ros.node("observer"), []
    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    observer.create_subscription(Log, "/rosout", got.append, latched)
    ros.settle()
    assert [each.msg for each in got] == ["early"]


def test_latched_log_messages_are_copies(ros: Any) -> None:
    ros.node("talker").get_logger().info("early")
    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    first, second = [], []
    observer = ros.node("observer")
    observer.create_subscription(Log, "/rosout", first.append, latched)
    ros.settle()
    first[0].msg = "changed"
    observer.create_subscription(Log, "/rosout", second.append, latched)
    ros.settle()
    assert second[0].msg == "early"


def test_invalid_logger_names_are_rejected(log: Any) -> None:
    with pytest.raises(ValueError, match=r"Logger name must not be empty\."):
        logging.get_logger("")
    with pytest.raises(TypeError):
        logging.get_logger("a").get_child(5)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("rule", "warning"),
    [
        ("__node:=1a", "Node name not remapped to invalid name: '1a'"),
        ("__ns:=sp ace", "Namespace not remapped to a fully qualified name (found: sp ace)"),
        ("__ns:=/1sp", "Namespace not remapped to a fully qualified name (found: /1sp)"),
        ("foo:=", ""),
    ],
)
def test_remap_rule_with_invalid_name_is_warned_about_before_the_error(
    rule: str, warning: str, printed: Callable[[], list[str]]
) -> None:
    with pytest.raises(RCLError):
        Context().init(["--ros-args", "-r", rule])
    expected = [f"[WARN] {warning}"] if warning else []
    assert printed() == [*expected, "[ERROR] Failed to parse global arguments"]


@pytest.mark.parametrize("name", [None, 5, "loud", ""])
def test_unknown_severity_name_is_refused(name: Any) -> None:
    with pytest.raises(RuntimeError, match="Failed to get severity name"):
        logging.get_logging_severity_from_string(name)


def test_message_ends_at_a_null_character(log: Any, printed: Callable[[], list[str]]) -> None:
    log.info("a\0b")
    log.info("\0")
    assert printed() == ["[INFO] a", "[INFO] "]
