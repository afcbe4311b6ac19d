"""`--distro NAME` chooses the distribution before it is needed, and leaves the arguments of programs alone."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest
from bot_console.runtime.distribution import DEFAULT, TABLE, Distribution, UnknownDistributionError, distribution
from bot_console.tui.cli.distro_option import without_distro
from bot_console.tui.cli.main import main


@pytest.fixture(autouse=True)
def clear_distribution(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    for name in ("BOT_CONSOLE_DISTRO", "ROS_DISTRO"):
        monkeypatch.setenv(name, "")
    distribution.cache_clear()
    yield
    distribution.cache_clear()


@pytest.mark.parametrize(
    ("line", "rest"),
    [
        ("--distro kilted", ""),
        ("--distro=kilted run node.py", "run node.py"),
        ("--distro kilted ros2 topic list", "ros2 topic list"),
        ("--headless --distro kilted warehouse", "--headless warehouse"),
        ("warehouse --distro kilted", "warehouse"),
    ],
)
def test_option_is_removed_from_the_arguments(line: str, rest: str) -> None:
    assert without_distro(line.split(), {"run", "ros2"}.__contains__) == rest.split()
    assert (os.environ["BOT_CONSOLE_DISTRO"], os.environ["ROS_DISTRO"]) == ("kilted", "kilted")
    assert distribution() is TABLE["kilted"]


@pytest.mark.parametrize("line", ["run node.py --distro kilted", "ros2 run a b --distro=x", "warehouse"])
def test_arguments_after_a_command_are_left_alone(line: str) -> None:
    assert without_distro(line.split(), {"run", "ros2"}.__contains__) == line.split()
    assert distribution() is DEFAULT


@pytest.mark.parametrize("line", ["--distro humble", "--distro", "--distro=", "--headless --distro Kilted"])
def test_unknown_distribution_is_refused_on_one_line(line: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(line.split()) == 2
    refused = capsys.readouterr().err
    assert refused.startswith("bot-console: --distro: there is no distribution '") and refused.count("\n") == 1
    assert refused.endswith("choose jazzy or kilted\n")


def test_unknown_distribution_of_the_environment_is_refused(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("BOT_CONSOLE_DISTRO", "rolling")
    assert main(["run", "node.py"]) == 2
    assert capsys.readouterr().err.startswith("bot-console: BOT_CONSOLE_DISTRO: there is no distribution 'rolling'")
    with pytest.raises(UnknownDistributionError, match="rolling"):
        distribution()


def test_each_row_of_the_table_differs_between_distributions() -> None:
    jazzy, kilted = TABLE["jazzy"], TABLE["kilted"]
    assert [name for name in Distribution._fields if getattr(jazzy, name) == getattr(kilted, name)] == []
