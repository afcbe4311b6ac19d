"""`main(argv)`: help, wrong words and exit codes."""

from __future__ import annotations

import pytest
from ros2cli import main
from ros2cli.command_line import COMMANDS


def test_help_names_all_commands(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    shown = capsys.readouterr().out
    assert all(f"  {name} " in shown and text in shown for name, (_, text) in COMMANDS.items())


@pytest.mark.parametrize("command", [name for name in COMMANDS if name not in ("run", "launch")])
def test_a_command_alone_shows_its_verbs(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([command]) == 0
    assert f"usage: ros2 {command} [-h]" in capsys.readouterr().out


@pytest.mark.parametrize("words", [["nope"], ["param", "nope"], ["param", "get"], ["node", "list", "--nope"]])
def test_wrong_words(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.startswith("usage: ros2")


def test_an_exception_in_a_verb_is_its_exit_code(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["interface", "proto", "std_msgs/msg/Nope"]) == 1
    assert capsys.readouterr().err.splitlines()[-1] == "AttributeError: module 'std_msgs.msg' has no attribute 'Nope'"


def test_the_verbs_need_no_arguments_list(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr("sys.argv", ["ros2", "pkg", "prefix", "no_package"])
    assert main() == 1
    assert capsys.readouterr().err == "Package not found\n"
