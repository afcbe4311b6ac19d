"""The log file of a process: its place, when it exists, and its contents."""

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
    """The folder for log files, which does not exist yet; contexts of other tests do not count."""
    monkeypatch.setattr(log_routing.state(), "log_file", LogFile())
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    return tmp_path / "log"


def content(folder: Path) -> list[str]:
    """Return the contents of the files, oldest first, without times."""
    return [re.sub(TIME, "", each.read_text("utf-8")) for each in sorted(folder.rglob("*.log"))]


def test_log_file_is_named_after_the_process(ros: Any, folder: Path, capfd: Any) -> None:
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


def test_log_file_is_closed_with_the_last_context(ros: Any, folder: Path) -> None:
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
def test_command_line_controls_the_log_file(ros: Any, folder: Path, words: list[str], names: list[str]) -> None:
    ros.init(*words)
    logging.get_logger("a").info("one")
    assert [each.name.split("_")[0] for each in folder.rglob("*.log")] == names


def test_there_is_no_log_file_unless_requested(
    ros: Any, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", "")
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    ros.init()
    logging.get_logger("a").info("one")
    assert list(tmp_path.iterdir()) == []


def test_console_markers_do_not_appear_in_the_log_file(ros: Any, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(ENVELOPE_VARIABLE, "<<{line}>>")
    monkeypatch.setenv("RCUTILS_CONSOLE_OUTPUT_FORMAT", "<<{message}>>")
    ros.init()
    logging.get_logger("a").info("one")
    assert content(folder) == ["one\n"]


def test_folder_that_cannot_be_created_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "file" / "log"))
    with pytest.raises(RCLError, match=r"^failed to initialize logging: Failed to create log directory '.*/log': 20$"):
        Context().init([])


def test_unwritable_log_file_is_reported_once(ros: Any, folder: Path, capfd: Any) -> None:
    ros.init("--log-file-name", "a/b")
    (folder / "a").write_text("no folder")
    logging.get_logger("a").info("one")
    logging.get_logger("a").info("two")
    assert capfd.readouterr().err.count("nothing more is logged to") == 1
