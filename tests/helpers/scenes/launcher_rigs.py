"""One launcher with one launch file: scripted, in this process, behind a host, and that of `attach --ros`."""

from __future__ import annotations

import os
import socket
import sys
from pathlib import Path
from typing import Protocol

import pytest
from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.model import LaunchArgument, LaunchInfo
from bot_console.tui.session.launch_host.combined import CombinedLauncher
from bot_console.tui.session.launch_host.host import LaunchHost
from bot_console.tui.session.launch_host.proxy import HostedLauncher
from bot_console.tui.session.machine.launchers import launcher_of_machine
from fakes.console import FakeConsole
from fakes.launcher import FakeLauncher
from launcher_bench import HEAD, WAITS, Bench
from rigs import until

DECLARED = (
    LaunchArgument("room", "Where it drives.", "hall", ("hall", "yard")),
    LaunchArgument("robot", "Its name."),
)
CHOICES = (
    "DeclareLaunchArgument('room', default_value='hall', description='Where it drives.', choices=['hall', 'yard'])"
)
REQUIRED = "DeclareLaunchArgument('robot', description='Its name.')"


class LauncherRig(Protocol):
    """A launcher, its file, and what can be done on the file's side."""

    path: str
    launcher: Launcher

    def info(self) -> LaunchInfo:
        """The current state."""
        ...

    def settle(self) -> None:
        """Wait until everything started is waiting."""
        ...

    def break_file(self) -> None:
        """Put a fault into line 3 of the launch file."""
        ...

    def close(self) -> None:
        """Close the launcher."""
        ...


class FakeRig:
    """A scripted launcher."""

    def __init__(self, folder: Path) -> None:
        self.path = "/opt/launch/system.launch.py"
        self._console = FakeConsole()
        self._fake = FakeLauncher(DECLARED, (self.path,), self._console)
        self.launcher: Launcher = self._fake

    def info(self) -> LaunchInfo:
        """The current state."""
        return self._console.snapshot().launch

    def settle(self) -> None:
        """Wait until everything started is waiting."""

    def break_file(self) -> None:
        """Put a fault into line 3 of the launch file."""
        self._fake.broken = f"{self.path}, line 3: syntax error: invalid syntax"

    def close(self) -> None:
        """Close the launcher."""
        self._fake.close()


class RosRig:
    """The real launcher over the embedded launch, with a node that waits."""

    def __init__(self, folder: Path) -> None:
        self._bench = Bench(folder)
        program = self._bench.program(WAITS)
        self.path = self._bench.file(f"[{CHOICES}, {REQUIRED}, Node(executable={program!r})]")
        self.launcher: Launcher = self._bench.launcher

    def info(self) -> LaunchInfo:
        """The current state."""
        return self._bench.info

    def settle(self) -> None:
        """Wait until everything started is waiting."""
        bench = self._bench
        starts = sum(each.restarts + 1 for each in self.info().processes)
        bench.until(lambda: sum(text == "up" for _, _, text in bench.printed) >= starts, "its first line")

    def break_file(self) -> None:
        """Put a fault into line 3 of the launch file."""
        Path(self.path).write_text("a = 1\n\ndef (:\n")

    def close(self) -> None:
        """Close the launcher."""
        self._bench.launcher.close()


class HostedRig(RosRig):
    """The same behind a host's socket."""

    def __init__(self, folder: Path) -> None:
        super().__init__(folder)
        bench = self._bench
        ours, theirs = socket.socketpair()
        self._host = LaunchHost(lambda record, printed: bench.launcher)
        self._host.connect(theirs, owner=True)
        self.launcher = self._proxy = HostedLauncher(ours, bench.launcher._record, lambda *line: None)

    def info(self) -> LaunchInfo:
        """The state as the console sees it."""
        return self._proxy.info()

    def close(self) -> None:
        """Close the launcher."""
        self._proxy.close()
        self._host.close()


class AttachedRig(HostedRig):
    """The same from an attached console, which starts a host when it first launches something."""

    def __init__(self, folder: Path) -> None:
        super().__init__(folder)
        self.launcher = self._combined = CombinedLauncher(lambda: ("own", self._proxy), self._proxy.files)

    def info(self) -> LaunchInfo:
        """The state as the console sees it."""
        return self._combined.info()

    def close(self) -> None:
        """Close the launcher."""
        self._combined.close()
        self._host.close()


class MachineRig:
    """The launcher of `attach --ros`, over the machine's launch, in separate processes."""

    def __init__(self, folder: Path) -> None:
        program, file = folder / "program.py", folder / "share" / "tried" / "system.launch.py"
        program.write_text(WAITS)
        node = f"Node(executable={str(program)!r}, prefix={sys.executable!r}, exec_name='program.py', output='screen')"
        marker = folder / "share" / "ament_index" / "resource_index" / "packages" / "tried"
        for each in (file, marker):
            each.parent.mkdir(parents=True)
        marker.touch()
        file.write_text(HEAD.format(entities=f"[{CHOICES}, {REQUIRED}, {node}]"))
        self.path = str(file)
        self._up = 0
        self._patch = pytest.MonkeyPatch()
        self._patch.setenv("AMENT_PREFIX_PATH", str(folder), prepend=os.pathsep)
        self.launcher: Launcher = launcher_of_machine(self._heard, lambda *line: None)

    def _heard(self, stamp: int, severity: int, label: str, text: str, site: object) -> None:
        self._up += text == "up"

    def info(self) -> LaunchInfo:
        """The current state."""
        return self.launcher.info()

    def settle(self) -> None:
        """Wait until everything started is waiting."""
        until(lambda: self._up >= sum(each.restarts + 1 for each in self.info().processes), "its first line")

    def break_file(self) -> None:
        """Put a fault into line 3 of the launch file."""
        Path(self.path).write_text("a = 1\n\ndef (:\n")

    def close(self) -> None:
        """Close the launcher."""
        self.launcher.close()
        self._patch.undo()
