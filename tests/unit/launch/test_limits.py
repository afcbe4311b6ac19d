"""A launch that meets a limit of the machine reports it in one line, without a traceback."""

from __future__ import annotations

import sys

import launch.logging
import pytest
from launch.actions import ExecuteProcess, OpaqueFunction, execute_local

from launch import LaunchDescription, LaunchService


@pytest.fixture
def error_lines(monkeypatch):
    lines = []
    for method in ("error", "critical"):
        monkeypatch.setattr(launch.logging.LaunchLogger, method, lambda self, text, *args: lines.append(text))
    return lines


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (
            RuntimeError("can't start new thread"),
            "no more threads can be started (limits are shown by `ulimit -v` and `ulimit -u`)",
        ),
        (MemoryError(), "there is too little memory (a limit is shown by `ulimit -v`)"),
        (
            RuntimeError("cannot listen: Too many open files (os error 24)"),
            "too many files are open (the limit is shown by `ulimit -n`)",
        ),
        (OSError(24, "Too many", "/dev/null"), "too many files are open (the limit is shown by `ulimit -n`)"),
    ],
)
def test_process_that_cannot_be_started_names_the_limit(error, line, monkeypatch, error_lines):
    async def fails(*args, **kwargs):
        raise error

    monkeypatch.setattr(execute_local, "start_child", fails)
    service = LaunchService(noninteractive=True)
    service.include_launch_description(LaunchDescription([ExecuteProcess(cmd=[sys.executable], name="echo")]))
    service.run()
    errors = "\n".join(error_lines)
    assert f"exception occurred while executing process: {line}" in errors
    assert "Traceback" not in errors


def test_error_of_a_program_itself_keeps_its_traceback(monkeypatch, error_lines):
    async def fails(*args, **kwargs):
        raise ValueError("its own")

    monkeypatch.setattr(execute_local, "start_child", fails)
    service = LaunchService(noninteractive=True)
    service.include_launch_description(LaunchDescription([ExecuteProcess(cmd=[sys.executable], name="echo")]))
    service.run()
    errors = "\n".join(error_lines)
    assert "exception occurred while executing process:\nTraceback" in errors


def test_limit_that_caused_an_error_of_the_launch_is_named(error_lines):
    def fails(context):
        raise RuntimeError("the file cannot be loaded") from MemoryError()

    service = LaunchService(noninteractive=True)
    service.include_launch_description(LaunchDescription([OpaqueFunction(function=fails)]))
    assert service.run() == 1
    assert "there is too little memory (a limit is shown by `ulimit -v`)" in "\n".join(error_lines)
