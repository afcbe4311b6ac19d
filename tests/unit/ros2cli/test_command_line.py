"""`main(argv)`: help, invalid arguments and exit codes."""

from __future__ import annotations

import io
import subprocess
import sys

import pytest
from ros2cli import main
from ros2cli.command_line import COMMANDS, HelpFormatter


def test_help_lists_all_commands(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    shown = capsys.readouterr().out
    assert all(f"  {name} " in shown and text in shown for name, (_, text) in COMMANDS.items())


@pytest.mark.parametrize("command", [name for name in COMMANDS if name not in ("run", "launch")])
def test_command_without_verb_shows_usage(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([command]) == 0
    assert f"usage: ros2 {command} [-h]" in capsys.readouterr().out


@pytest.mark.parametrize("words", [["nope"], ["param", "nope"], ["param", "get"], ["node", "list", "--nope"]])
def test_invalid_arguments_show_usage_and_return_2(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.startswith("usage: ros2")


def test_exception_in_a_verb_returns_1(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["interface", "proto", "std_msgs/msg/Nope"]) == 1
    assert capsys.readouterr().err.splitlines()[-1] == "AttributeError: module 'std_msgs.msg' has no attribute 'Nope'"


def test_main_reads_sys_argv_by_default(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr("sys.argv", ["ros2", "pkg", "prefix", "no_package"])
    assert main() == 1
    assert capsys.readouterr().err == "Package not found\n"


def test_param_verb_does_not_import_rarely_needed_modules() -> None:
    """`ros2 param set` in a second terminal: each of these would take a twentieth of its CPU time, or more."""
    program = """
import sys
from bot_console.runtime.importer import install
install()
from ros2cli.command_line import main
from rclpy.parameter import get_parameter_value
assert main(["param", "set", "/no_node"]) == 2
assert get_parameter_value("1.5").double_value == 1.5
print(*{"dataclasses", "inspect", "numpy", "shutil", "traceback", "yaml"} & {*sys.modules})
"""
    shown = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert shown.stdout == "\n"


@pytest.mark.parametrize(("reported", "width"), [("100", 100), ("0", 80), ("wide", 80)])
def test_help_is_as_wide_as_the_terminal(reported: str, width: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", reported)
    monkeypatch.setattr("sys.__stdout__", io.StringIO())  # no terminal
    assert HelpFormatter("ros2")._width == width - 2
