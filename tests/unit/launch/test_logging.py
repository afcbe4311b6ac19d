"""`launch.logging`: folders, formats and handlers that a launch file may set."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from pathlib import Path

import launch.logging
import pytest
from bot_console.runtime.process import on_notice

config = launch.logging.launch_config


@pytest.fixture(autouse=True)
def fresh() -> Iterator[None]:
    launch.logging.reset()
    yield
    launch.logging.reset()


def test_log_folder_must_exist(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="is not a directory"):
        config.log_dir = str(tmp_path / "none")
    config.log_dir = str(tmp_path)
    assert config.log_dir == str(tmp_path)
    config.log_dir = None
    assert config.log_dir != str(tmp_path)


def test_named_format_rejects_another_style() -> None:
    with pytest.raises(ValueError):
        config.set_screen_format("default", screen_style="%")
    with pytest.raises(ValueError):
        config.set_log_format(log_format="default", log_style="%")


def test_custom_format_may_use_percent_style(capsys: pytest.CaptureFixture[str]) -> None:
    config.set_screen_format("%(name)s: %(message)s", screen_style="%")
    launch.logging.get_logger("n").info("x")
    assert capsys.readouterr().out == "n: x\n"


def test_handler_added_twice_writes_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    config.log_dir = str(tmp_path)
    logger = launch.logging.get_logger("n")
    logger.addHandler(config.get_screen_handler())
    logger.addHandler(config.get_log_file_handler())
    logger.info("x")
    assert capsys.readouterr().out == "[INFO] [n]: x\n"
    assert len((tmp_path / "launch.log").read_text().splitlines()) == 1


def test_log_files_are_created_by_the_factory(tmp_path: Path) -> None:
    made: dict[str, list[str]] = {}

    class Memory(launch.logging.handlers.Handler):
        def __init__(self, path: str) -> None:
            super().__init__()
            self.lines = made.setdefault(path, [])

        def emit(self, record: logging.LogRecord) -> None:
            self.lines.append(self.format(record))

    config.log_dir = str(tmp_path)
    config.log_handler_factory = lambda path, encoding=None: Memory(path)
    launch.logging.get_logger("n").error("x")
    [line] = made[config.get_log_file_path()]
    assert line.endswith("[ERROR] [n]: x")


def test_unwritable_log_file_is_reported_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    config.log_dir = str(tmp_path)
    (tmp_path / "launch.log").mkdir()
    reported = list[str]()
    forget = on_notice(lambda process, text: reported.append(text))
    for number in range(3):
        launch.logging.get_logger("n").info(f"line {number}")
    forget()
    assert reported == [f"log files are not complete: {tmp_path} cannot be written (Is a directory)"]
    message = capsys.readouterr()
    assert message.out.splitlines() == [f"[INFO] [n]: line {number}" for number in range(3)] and message.err == ""
