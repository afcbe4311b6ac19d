"""Fixtures that run launches in this process, and their log as lines of text."""

from __future__ import annotations

import logging
import textwrap
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

Launch = Callable[..., "Outcome"]


@dataclass
class Outcome:
    """How a launch ended, and what it logged."""

    code: int = 0
    lines: list[str] = field(default_factory=list)

    @property
    def text(self) -> str:
        """All lines."""
        return "\n".join(self.lines)

    @property
    def message(self) -> list[str]:
        """The lines that the launch file itself logged."""
        prefix = "[INFO] [launch.user]: "
        return [each.removeprefix(prefix) for each in self.lines if each.startswith(prefix)]

    @property
    def caught(self) -> str:
        """The text of the exception that ended the launch."""
        prefix = "[ERROR] [launch]: Caught exception in launch (see debug for traceback): "
        return "\n".join(each.removeprefix(prefix) for each in self.lines if each.startswith(prefix))


class _Lines(logging.Handler):
    def __init__(self, lines: list[str]) -> None:
        super().__init__()
        self.lines = lines

    def emit(self, record: logging.LogRecord) -> None:
        self.lines.append(self.format(record))


@pytest.fixture(autouse=True)
def log_lines(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """The lines that launches of this test print to the screen."""
    import launch.logging

    for name in ("OVERRIDE_LAUNCH_PROCESS_OUTPUT", "OVERRIDE_LAUNCH_SCREEN_FORMAT", "OVERRIDE_LAUNCH_LOG_FORMAT"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    launch.logging.reset()
    lines: list[str] = []
    launch.logging.launch_config.set_screen_handler(_Lines(lines))
    yield lines
    launch.logging.reset()


@pytest.fixture
def run(log_lines: list[str], monkeypatch: pytest.MonkeyPatch) -> Launch:
    """Run entities, with launch arguments, to the end."""
    import os

    from bot_console.runtime.process.virtual.install import install_virtual_process

    install_virtual_process()  # before `os.environ` is saved: restoring it would otherwise undo a part of this
    monkeypatch.setattr(os, "environ", os.environ)
    before = dict(os.environ)

    def launched(entities: Iterable[Any], arguments: Mapping[str, str] | None = None, **options: Any) -> Outcome:
        from launch import LaunchDescription, LaunchService

        service = LaunchService(noninteractive=True, **options)
        service.context.launch_configurations.update(arguments or {})
        service.include_launch_description(LaunchDescription(list(entities)))
        try:
            return Outcome(service.run(), log_lines)
        finally:
            os.environ.clear()
            os.environ.update(before)

    return launched


@pytest.fixture
def run_file(run: Launch, tmp_path: Path) -> Launch:
    """Write a launch file and run it."""

    def launched(text: str, name: str = "x.launch.py", arguments: Mapping[str, str] | None = None) -> Outcome:
        from launch.actions import IncludeLaunchDescription

        path = tmp_path / name
        path.write_text(textwrap.dedent(text).lstrip(), encoding="utf-8")
        return run([IncludeLaunchDescription(str(path), launch_arguments=(arguments or {}).items())])

    return launched
