"""If several programs start at the same moment, only one starts a robot."""

from __future__ import annotations

import subprocess
import sys
from types import SimpleNamespace

import pytest
from bot_console.runtime.rmw.zenoh.domain.file_lock import try_lock
from bot_console.tui.cli import open_console, robot_claim
from bot_console.tui.cli.arguments import parse
from bot_console.tui.cli.headless import run as headless
from bot_console.tui.cli.robot_claim import NAME, RobotClaim
from bot_console.tui.cli.verbs import background
from bot_console.tui.session import system_log
from bot_console.tui.session.embedded import domain


@pytest.fixture(autouse=True)
def at_once(monkeypatch):
    monkeypatch.setattr(robot_claim, "CLAIM_POLL_S", 0.0)


def test_second_program_waits_for_the_robot_of_the_first(tmp_path):
    first, second = RobotClaim(tmp_path), RobotClaim(tmp_path)
    assert first.held and not second.held
    polls, reported = iter([[], [], ["/simulator"]]), []
    assert first.wait_for_robot(lambda: [], lambda: reported.append(1)) == [] and not reported, (
        "there is nothing to wait for"
    )
    assert second.wait_for_robot(lambda: next(polls), lambda: reported.append(1)) == ["/simulator"] and not second.held
    assert reported == [1], "the wait is reported once"
    first.release(), first.release(), second.release()


def test_released_claim_can_be_taken(tmp_path):
    first, second = RobotClaim(tmp_path), RobotClaim(tmp_path)
    polls = []

    def poll():
        polls.append(1)
        if len(polls) == 3:
            first.release()
        return []

    assert second.wait_for_robot(poll, list) == [] and second.held
    assert not RobotClaim(tmp_path).held


def test_wait_for_claimed_robot_ends_at_its_timeout(tmp_path, monkeypatch):
    monkeypatch.setattr(robot_claim, "ROBOT_START_TIMEOUT_S", 0.0)
    first, second = RobotClaim(tmp_path), RobotClaim(tmp_path)
    assert second.wait_for_robot(lambda: [], list) == [] and not second.held
    first.release()


def test_released_claim_leaves_no_file(tmp_path):
    first, second = RobotClaim(tmp_path), RobotClaim(tmp_path)
    second.release()
    assert (tmp_path / NAME).exists(), "the claim is not theirs"
    first.release()
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(sys.platform == "win32", reason="Windows cannot remove an open file")
def test_file_removed_while_it_is_being_locked_is_not_a_claim(tmp_path, monkeypatch):
    first, got = RobotClaim(tmp_path), []

    def lock(handle):
        if not got:
            first.release()
        got.append(handle)
        return try_lock(handle)

    monkeypatch.setattr(robot_claim, "try_lock", lock)
    second = RobotClaim(tmp_path)
    assert second.held and len(got) == 2 and not RobotClaim(tmp_path).held
    second.release()


def test_folder_without_lock_support_does_not_prevent_a_start(tmp_path):
    (tmp_path / NAME).mkdir()
    claim = RobotClaim(tmp_path)
    assert claim.held and claim.descriptors == () and claim.wait_for_robot(lambda: [], list) == []
    claim.release()


@pytest.mark.skipif(sys.platform == "win32", reason="only POSIX processes inherit descriptors")
def test_process_that_inherited_the_claim_holds_it_until_it_ends(tmp_path):
    claim = RobotClaim(tmp_path)
    line = [sys.executable, "-c", "input()"]
    with subprocess.Popen(line, stdin=subprocess.PIPE, pass_fds=claim.descriptors) as system:
        claim.hand_over()
        assert not RobotClaim(tmp_path).held
        system.communicate(b"\n")
    assert RobotClaim(tmp_path).held


@pytest.fixture
def up(monkeypatch, tmp_path):
    """Replaces the process that `up` starts; returns its options."""
    calls = []

    def start(words, **options):
        calls.append(options)
        return SimpleNamespace(pid=1, poll=lambda: None)

    for name, value in {
        "take_part": lambda: "", "robot_claim": lambda: RobotClaim(tmp_path), "_file": lambda: tmp_path / "known.json",
        "running_robot_nodes": lambda: ["/simulator"] if calls else [], "_is_program": lambda pid, word: bool(calls),
    }.items():  # fmt: skip
        monkeypatch.setattr(background, name, value)
    monkeypatch.setattr(background.subprocess, "Popen", start)
    monkeypatch.setattr(system_log, "state_folder", lambda: tmp_path)
    return calls


def test_up_hands_its_claim_to_the_system(up):
    assert background.up([]) == 0
    assert len(up[0]["pass_fds"]) == 1


def test_up_starts_no_robot_beside_a_console_that_is_starting_one(up, tmp_path, monkeypatch, capsys):
    first, polls = RobotClaim(tmp_path), iter([[], ["/simulator"]])
    monkeypatch.setattr(background, "running_robot_nodes", lambda: next(polls))
    assert background.up([]) == 1 and not up
    reported = capsys.readouterr().err
    assert (
        "Another bot-console is starting a robot" in reported
        and "a robot is already running" in reported
        and "/simulator" in reported
    )
    first.release()


@pytest.mark.parametrize("program", ["up", "--headless"])
def test_nodes_with_our_names_alone_are_not_a_robot(program, up, tmp_path, monkeypatch, capsys):
    apart = []
    for name, value in {
        "take_part": lambda: "", "robot_claim": lambda: RobotClaim(tmp_path), "running_robot_nodes": list,
        "isolate_from_domain": lambda: apart.append(1),
    }.items():  # fmt: skip
        monkeypatch.setattr(headless, name, value)
    monkeypatch.setattr(domain, "same_names_there", lambda arguments: ["/sensor_handler"])
    background.up([]) if program == "up" else headless._join_domain(parse(["--headless"]))
    reported = capsys.readouterr().err
    assert (
        reported.startswith("nodes with our robot's node names are running already")
        and "/sensor_handler" in reported
        and not up
    )
    assert bool(apart) == (program == "--headless") and RobotClaim(tmp_path).held


def test_headless_runs_in_isolation_beside_a_console_that_is_starting_a_robot(tmp_path, monkeypatch, capsys):
    first, polls, apart = RobotClaim(tmp_path), iter([[], ["/simulator"]]), []
    for name, value in {
        "take_part": lambda: "", "robot_claim": lambda: RobotClaim(tmp_path),
        "running_robot_nodes": lambda: next(polls),
        "isolate_from_domain": lambda: apart.append(1),
    }.items():  # fmt: skip
        monkeypatch.setattr(headless, name, value)
    headless._join_domain(parse(["--headless"]))
    assert apart and "runs in isolation" in capsys.readouterr().err
    first.release()


def test_headless_robot_that_cannot_join_the_domain_reaches_its_launched_programs(monkeypatch, capsys):
    apart = []
    monkeypatch.setattr(headless, "take_part", lambda: "the folder belongs to another user")
    monkeypatch.setattr(headless, "isolate_from_domain", lambda: apart.append(1))
    headless._join_domain(parse(["--headless"]))
    assert apart and "belongs to another user" in capsys.readouterr().err


def test_console_started_beside_another_shows_its_robot(tmp_path, monkeypatch, capsys):
    first, shown = RobotClaim(tmp_path), []
    polls = iter([[], ["/simulator"]])

    class Shown:
        def __init__(self, options, connect):
            shown.append(options)

        def run(self):
            return 0

    for name, value in {
        "Session": Shown, "_prepare": lambda options: None, "_refusal": lambda _: "", "why_alone": lambda: "",
        "is_in_range": lambda: True, "others_take_part": lambda: False, "running_robot_nodes": lambda: next(polls),
        "robot_claim": lambda: RobotClaim(tmp_path),
    }.items():  # fmt: skip
        monkeypatch.setattr(open_console, name, value)
    monkeypatch.setattr("builtins.input", lambda question: "y")
    assert open_console.run(parse([])) == 0 and shown[0].attach
    assert "Another bot-console is starting a robot" in capsys.readouterr().err
    first.release()
    assert RobotClaim(tmp_path).held, "an attached console claims nothing"
