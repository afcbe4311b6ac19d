"""Programs of other terminals: found by their nodes, named after the program that started them, and listed once."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from bot_console.tui.console.launch.external_programs import HEADING, ExternalPrograms
from bot_console.tui.console.model import LaunchInfo, ProcessInfo, ProcessState

NOTHING = LaunchInfo()
SHELL, LAUNCH, FORKS = 100, 200, 300


class Machine:
    """A `/proc` with a terminal in which a launch runs, and the nodes of its processes."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.nodes: dict[int, tuple[str, ...]] = {}
        self.hosts: list[int] = []
        self.now = 0.0
        self.runs(SHELL, 1, "bash")
        self.runs(LAUNCH, SHELL, "/usr/bin/python3", "/opt/bin/ros2", "launch", "/home/me/fleet.launch.py")
        self.runs(FORKS, LAUNCH, "bot-console", "fork", "server")
        self.search = ExternalPrograms(
            lambda: self.nodes, hosts=lambda: self.hosts, proc=self.folder, clock=lambda: self.now
        )  # fmt: skip

    def runs(self, pid: int, parent: int, *words: str, nodes: tuple[str, ...] = ()) -> None:
        """Add a process."""
        place = self.folder / str(pid)
        place.mkdir()
        (place / "cmdline").write_text("\0".join(words) + "\0")
        (place / "stat").write_text(f"{pid} (a (b) c) S {parent} {pid} 0")
        if nodes:
            self.nodes[pid] = nodes

    def found(self, launch: LaunchInfo = NOTHING) -> tuple[ProcessInfo, ...]:
        """The programs that are found a second later."""
        self.now += 1.0
        return self.search.merged_with(launch).processes


def test_launch_of_another_terminal_is_found_with_its_processes(tmp_path: Path) -> None:
    machine = Machine(tmp_path)
    machine.runs(301, FORKS, "/opt/talker", "--ros-args", nodes=("/talker", "/launch_ros_200", "/_tool"))
    machine.runs(302, FORKS, "/opt/ears", nodes=("/left", "/right"))
    talker, ears = machine.found()
    group = (HEADING, "ros2 launch fleet.launch.py")
    assert (talker.label, talker.pid, talker.nodes, talker.group) == ("talker", 301, ("/talker",), group)
    assert (ears.label, ears.nodes, ears.group) == ("2 nodes", ("/left", "/right"), group)
    assert talker.state is ProcessState.RUNNING and talker.started_by == "ros2 launch fleet.launch.py (pid 200)"
    del machine.nodes[301]
    assert [each.pid for each in machine.found()] == [302]


def test_program_that_a_shell_started_has_its_own_command(tmp_path: Path) -> None:
    machine = Machine(tmp_path)
    machine.runs(400, SHELL, "python3", "-u", "my_node.py", nodes=("/mine",))
    machine.runs(401, SHELL, "/usr/bin/python3", "-m", "bot_console.tui", "run", "a", "b", nodes=("/b",))
    assert [each.group[1] for each in machine.found()] == ["my_node.py", "bot-console run a b"]


def test_processes_of_a_known_launch_host_or_of_this_console_are_not_listed_again(tmp_path: Path) -> None:
    machine = Machine(tmp_path)
    machine.runs(301, FORKS, "/opt/talker", nodes=("/talker",))
    machine.runs(os.getpid(), SHELL, "bot-console")
    machine.runs(500, os.getpid(), "bot-console", nodes=("/own",))
    assert [each.pid for each in machine.found()] == [301]
    machine.hosts = [LAUNCH]
    assert machine.found() == ()
    machine.hosts = []
    launched = LaunchInfo(processes=(ProcessInfo("talker@1", "talker-1", ProcessState.RUNNING, 301),))
    assert [each.key for each in machine.found(launched)] == ["talker@1"]


def test_nodes_of_a_launched_program_are_found_even_if_it_started_them_through_a_shell(tmp_path: Path) -> None:
    machine = Machine(tmp_path)
    machine.runs(600, SHELL, "sh", "-c", "python3 mine.py")
    machine.runs(601, 600, "python3", "mine.py", nodes=("/mine", "/_hidden"))
    plain = ProcessInfo("sh@1", "sh-1", ProcessState.RUNNING, 600)
    named = ProcessInfo("b@2", "b-2", ProcessState.RUNNING, 700, ("/b",))
    assert machine.found(LaunchInfo(processes=(plain, named))) == (replace(plain, nodes=("/mine",)), named)
    del machine.nodes[601]
    ended = replace(plain, state=ProcessState.CRASHED, pid=None, exit_code=1)
    assert machine.found(LaunchInfo(processes=(ended, named)))[0].nodes == ("/mine",)


def test_launch_info_is_the_same_object_until_something_changes(tmp_path: Path) -> None:
    machine = Machine(tmp_path)
    launch = LaunchInfo()
    assert machine.search.merged_with(launch) is launch
    machine.runs(301, FORKS, "/opt/talker", nodes=("/talker",))
    machine.now += 1.0
    merged = machine.search.merged_with(launch)
    machine.now += 1.0
    assert machine.search.merged_with(launch) is merged
    assert machine.search.merged_with(LaunchInfo()) is not merged


def test_processes_of_other_machines_and_of_systems_without_proc_are_left_out(tmp_path: Path) -> None:
    machine = Machine(tmp_path)
    machine.nodes[999] = ("/far",)
    assert machine.found() == ()
