"""The file that a process logs to: where, when, and what is in it."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import pytest
from rclpy import logging
from rclpy._rclpy_pybind11 import RCLError
from rclpy.context import Context
from rclpy.impl import log_routing
from rclpy.impl.log_file import LogFile
from rclpy.impl.log_format import ENVELOPE_VARIABLE

TIME = r" \[\d{10}\.\d{9}\]"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder for log files, which is not there yet; no other test's context counts."""
    monkeypatch.setattr(log_routing.state(), "log_file", LogFile())
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    return tmp_path / "log"


def content(folder: Path) -> list[str]:
    """What the files hold, the oldest first, without times."""
    return [re.sub(TIME, "", each.read_text("utf-8")) for each in sorted(folder.rglob("*.log"))]


def test_lines_are_in_a_file_named_after_the_process(ros: Any, folder: Path, capfd: Any) -> None:
    node = ros.node("speaker_of_this_test")
    assert content(folder) == []
    node.get_logger().info("one\nmore \u00fc")
    node.get_logger().debug("not said")
    logging.clear_config()
    logging.get_logger("other").warning("two")
    assert content(folder) == ["[INFO] [speaker_of_this_test]: one\nmore \u00fc\n[WARN] [other]: two\n"]
    (path,) = folder.iterdir()
    assert path.name.split("_")[-2] == str(os.getpid()) and len(path.stem.split("_")[-1]) == 13
    assert re.sub(TIME, "", capfd.readouterr().err) == content(folder)[0]


def test_it_ends_with_the_last_context(ros: Any, folder: Path) -> None:
    ros.init()
    second, third = Context(), Context()
    second.init([], domain_id=ros.domain)
    third.init([], domain_id=ros.domain, initialize_logging=False)
    log = logging.get_logger("a")
    ros.context.shutdown()
    log.info("one")
    second.shutdown()
    log.info("nobody is there")
    third.shutdown()
    assert content(folder) == ["[INFO] [a]: one\n"]


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (["--log-file-name", "part/mine", "--disable-stdout-logs"], ["mine"]),
        (["--disable-external-lib-logs"], []),
    ],
)
def test_the_command_line_has_its_way(ros: Any, folder: Path, words: list[str], names: list[str]) -> None:
    ros.init(*words)
    logging.get_logger("a").info("one")
    assert [each.name.split("_")[0] for each in folder.rglob("*.log")] == names


def test_there_is_none_where_nobody_asks_for_it(
    ros: Any, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", "")
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    ros.init()
    logging.get_logger("a").info("one")
    assert list(tmp_path.iterdir()) == []


def test_a_console_that_marks_the_lines_leaves_the_file_as_it_is(
    ros: Any, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(ENVELOPE_VARIABLE, "<<{line}>>")
    monkeypatch.setenv("RCUTILS_CONSOLE_OUTPUT_FORMAT", "<<{message}>>")
    ros.init()
    logging.get_logger("a").info("one")
    assert content(folder) == ["one\n"]


def test_a_folder_that_cannot_be_made_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "file" / "log"))
    with pytest.raises(RCLError, match=r"^failed to initialize logging: Failed to create log directory '.*/log': 20$"):
        Context().init([])


def test_a_file_that_cannot_be_written_is_reported_once(ros: Any, folder: Path, capfd: Any) -> None:
    ros.init("--log-file-name", "a/b")
    (folder / "a").write_text("no folder")
    logging.get_logger("a").info("one")
    logging.get_logger("a").info("two")
    assert capfd.readouterr().err.count("nothing more is logged to") == 1
