"""Runs a student's programs, isolated as far as the kernel allows.

A run gets a copy of the workspace, a separate network and process table (user, network and process namespaces of
Linux), a time limit, and a memory limit that all its processes share. This protects the network, other processes and
the machine's memory from mistakes; it does not hide the files of the account that grades.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

NAMESPACES = ("unshare", "--user", "--map-root-user", "--net", "--pid", "--fork", "--kill-child", "--mount-proc")
MAX_MEMORY_BYTES = 2_000_000_000
"""Resident memory that all processes of a run may use together."""
MEMORY_POLL_S = 0.2
MAX_OUTPUT_BYTES = 2_000_000
SKIPPED = shutil.ignore_patterns(".git", "build", "install", "log", "__pycache__", ".bot-console")


class NoSandboxError(RuntimeError):
    """The kernel does not let users' programs have separate namespaces, or the workspace cannot be copied."""


@dataclass(frozen=True)
class RunResult:
    """How a run has ended; `why` names the limit for which it was killed, and is empty otherwise."""

    code: int
    output: str
    why: str = ""


@dataclass(frozen=True)
class Sandbox:
    """A copy of a workspace in `folder`, and the prefix that isolates commands; without isolation it is empty."""

    folder: Path
    prefix: Sequence[str]

    @property
    def workspace(self) -> Path:
        """The path of the copy."""
        return self.folder / "ws"

    def run(self, script: str, seconds: float) -> RunResult:
        """Run a shell script in the copy for at most `seconds`; no process that it has started outlives it."""
        output = self.folder / "output"
        with output.open("wb") as file:
            process = subprocess.Popen(
                [*self.prefix, "sh", "-c", script],
                cwd=self.workspace,
                env=self._environment(),
                stdin=subprocess.DEVNULL,
                stdout=file,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            why = _wait(process, seconds)
        text = output.read_bytes()[-MAX_OUTPUT_BYTES:].decode("utf-8", "replace")
        return RunResult(process.returncode, text, why)

    def _environment(self) -> dict[str, str]:
        kept = {name: value for name, value in os.environ.items() if name in ("PATH", "LANG", "LC_ALL", "PYTHONPATH")}
        home = str(self.folder / "home")
        return {
            **kept,
            "HOME": home,
            "ROS_HOME": home,
            "TMPDIR": home,
            "BOT_CONSOLE_USER_DIR": home,
            "BOT_CONSOLE_SOCKET_DIR": str(self.folder / "s"),
            "BOT_CONSOLE": f"{sys.executable} -m bot_console.tui",
        }


def make_sandbox(workspace: Path, folder: Path, *, allow_network: bool) -> Sandbox:
    """Copy a workspace into an empty folder.

    Raises `NoSandboxError` if it cannot be copied, or if programs cannot be isolated and the network is not allowed.
    """
    prefix: Sequence[str] = NAMESPACES
    if not can_isolate():
        if not allow_network:
            raise NoSandboxError(
                "this system does not let programs have a separate network namespace, so that graded programs could "
                "reach the network: grade in a container without network access, or accept this, with --allow-network"
            )
        prefix = ()
    try:
        shutil.copytree(workspace, folder / "ws", ignore=_left_out, symlinks=True)
    except OSError as error:  # `shutil.Error` lists a source, a destination and a reason per file
        path, why = error.args[0][0][::2] if isinstance(error, shutil.Error) else (workspace, error)
        raise NoSandboxError(f"not graded, as {path} cannot be copied: {why}") from None
    for each in ("home", "s"):
        (folder / each).mkdir(mode=0o700)
    return Sandbox(folder, prefix)


def _left_out(folder: str, names: list[str]) -> set[str]:
    """The names in a folder that are not copied: what tools have built, and pipes, sockets and devices."""
    special = {each.name for each in os.scandir(folder) if not (each.is_symlink() or each.is_dir() or each.is_file())}
    return {*SKIPPED(folder, names), *special}


@cache
def can_isolate() -> bool:
    """Whether programs of this user can have separate namespaces."""
    if not sys.platform.startswith("linux") or shutil.which(NAMESPACES[0]) is None:
        return False
    try:
        return subprocess.run([*NAMESPACES, "true"], capture_output=True, check=False, timeout=10).returncode == 0
    except (OSError, subprocess.TimeoutExpired):
        return False


def _wait(process: subprocess.Popen[bytes], seconds: float) -> str:
    """Wait for the process to end; returns the limit for which it was killed, or an empty text."""
    deadline = time.monotonic() + seconds
    while True:
        try:
            process.wait(MEMORY_POLL_S)
            return ""
        except subprocess.TimeoutExpired:
            pass
        why = ""
        if time.monotonic() > deadline:
            why = f"it took longer than {seconds:g} s"
        elif _resident_bytes(process.pid) > MAX_MEMORY_BYTES:
            why = f"it used more than {MAX_MEMORY_BYTES // 1_000_000} MB of memory"
        if why:
            _kill_all(process.pid)
            process.wait()
            return why


def _with_descendants(pid: int) -> list[int]:
    """The process ids of a process and its descendants."""
    children: dict[int, list[int]] = {}
    for each in os.listdir("/proc") if os.path.isdir("/proc") else ():
        if each.isdigit():
            try:
                parent = int(Path(f"/proc/{each}/stat").read_text("utf-8").rpartition(")")[2].split()[1])
            except (OSError, ValueError, IndexError):
                continue
            children.setdefault(parent, []).append(int(each))
    found = [pid]
    for each in found:
        found += children.get(each, [])
    return found


def _resident_bytes(pid: int) -> int:
    page = os.sysconf("SC_PAGE_SIZE")
    total = 0
    for each in _with_descendants(pid):
        try:
            total += int(Path(f"/proc/{each}/statm").read_text("utf-8").split()[1]) * page
        except (OSError, ValueError, IndexError):
            continue
    return total


def _kill_all(pid: int) -> None:
    for each in reversed(_with_descendants(pid)):
        try:
            os.kill(each, 9)
        except OSError:
            continue
