"""Rotating files: their size, and other writers."""

from __future__ import annotations

import logging
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.tui.session.embedded.rotating_file import LAUNCH_BYTES, RotatingFile, rotate_launch_files
from launch.logging import launch_config


def write(handler: logging.Handler, text: str) -> None:
    handler.handle(logging.LogRecord("n", logging.INFO, "", 0, text, None, None))


def test_output_that_bypasses_the_log_follows_the_rotation(tmp_path: Path) -> None:
    path = tmp_path / "a.log"
    past_it = os.open(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    elsewhere = os.open(tmp_path / "other", os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    handler = RotatingFile(path, 100, 1, (past_it, elsewhere))
    for number in range(10):
        write(handler, f"{number} {'x' * 40}")
    os.write(past_it, b"a crash\n")
    os.write(elsewhere, b"not logged\n")
    handler.close()
    assert path.read_text(encoding="utf-8").endswith("a crash\n")
    assert (tmp_path / "other").read_text(encoding="utf-8") == "not logged\n"
    os.close(past_it)
    os.close(elsewhere)


@pytest.fixture
def launch_folder(tmp_path: Path) -> Iterator[Path]:
    launch_config.reset()
    launch_config.log_dir = str(tmp_path)
    yield tmp_path
    launch_config.reset()


def test_files_that_launch_keeps_per_process_are_bounded(launch_folder: Path) -> None:
    rotate_launch_files()
    handler = launch_config.get_log_file_handler("flood-1-stdout.log")
    assert not list(launch_folder.iterdir())
    for number in range(60):
        write(handler, f"{number} {'x' * 100_000}")
    sizes = {each.name: each.stat().st_size for each in launch_folder.iterdir()}
    assert set(sizes) == {"flood-1-stdout.log", "flood-1-stdout.log.1"}
    assert max(sizes.values()) <= LAUNCH_BYTES
    assert " 59 xxx" in (launch_folder / "flood-1-stdout.log").read_text(encoding="utf-8")
