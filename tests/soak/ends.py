"""Starts and ends the console in every way: `python tests/soak/ends.py --ends 500`, JSON.

Each end must leave a usable terminal and, if the process ended in order, no process, socket or temporary file.
Prints how many ends of each kind there were, and what was wrong with those that failed.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "acceptance" / "console"))
from terminal import Terminal

TIMEOUT_S = 60.0
UNCLEAN = ("killed", "crash")
"""Kinds that may leave files, which the next start removes."""


def send_signals(*numbers: signal.Signals) -> Callable[[Terminal], None]:
    """Sends these signals, one right after the other."""

    def send(terminal: Terminal) -> None:
        for number in numbers:
            os.kill(terminal.process.pid, number)

    return send


def quit_while_armed(terminal: Terminal) -> None:
    """`q` while the steering is armed."""
    terminal.type("6")
    terminal.read_until(lambda: b"cmd_vel_teleop" in terminal.output, "the topic that is steered by")
    terminal.type("\r")
    terminal.read_until(lambda: b"ARMED" in terminal.output, "the armed steering")
    terminal.type("q")


KINDS: dict[str, Callable[[Terminal], None]] = {
    "q": lambda terminal: terminal.type("q"),
    "Ctrl-C": lambda terminal: terminal.type("\x03"),
    "TERM": send_signals(signal.SIGTERM),
    "HUP": send_signals(signal.SIGHUP),
    "QUIT": send_signals(signal.SIGQUIT),
    "TERM and HUP": send_signals(signal.SIGTERM, signal.SIGHUP),
    "closed terminal": lambda terminal: terminal.hang_up(),
    "killed": send_signals(signal.SIGKILL),
    "crash": send_signals(signal.SIGSEGV),
    "armed": quit_while_armed,
    "node aborts": lambda terminal: terminal.type("q"),
    "node raises": lambda terminal: terminal.type("q"),
}

NODES = {"node aborts": "os.abort()", "node raises": "raise RuntimeError('broken node')"}
"""Kinds in which a node has died before the end, and how it dies."""

NODE = """import os, rclpy
rclpy.init()
node = rclpy.create_node("broken")
{}
"""

LAUNCH_FILE = """from launch import LaunchDescription
from launch.actions import ExecuteProcess


def generate_launch_description():
    return LaunchDescription([ExecuteProcess(cmd=["python3", {!r}], output="screen")])
"""


def died(kind: str, folder: Path) -> list[str]:
    """The console's arguments for a kind in which a node dies; writes its launch file."""
    node, launch = folder / "broken_node.py", folder / "broken.launch.py"
    node.write_text(NODE.format(NODES[kind]))
    launch.write_text(LAUNCH_FILE.format(str(node)))
    return ["--launch", str(launch), "--simulator"]


def end(kind: str, folder: Path, base: Path) -> str:
    """Start a console and end it; returns what was wrong, empty if nothing was."""
    arguments = died(kind, folder) if kind in NODES else []
    terminal = Terminal(["-m", "bot_console.tui", "--seed", "1", *arguments], folder)
    try:
        begun = b"has died" if kind in NODES else b"robot_navigator"
        terminal.read_until(lambda: begun in terminal.output, "the robot or the node's death")
        KINDS[kind](terminal)
        code = terminal.process.wait(TIMEOUT_S) if terminal.master < 0 else terminal.wait()
        if code in (-signal.SIGSEGV, -signal.SIGABRT) and kind != "crash":
            return f"ended by signal {-code}"
        deadline = time.monotonic() + TIMEOUT_S
        while wrong := _leftovers(terminal, kind, base):
            if time.monotonic() > deadline:
                return wrong
            if terminal.master >= 0:
                terminal.drain(0.1)
            else:
                time.sleep(0.1)
    except (AssertionError, OSError) as error:
        return str(error)[:300]
    finally:
        terminal.close()
    return ""


def _leftovers(terminal: Terminal, kind: str, base: Path) -> str:
    if terminal.master >= 0 and not terminal.is_usable():
        return "the terminal is not usable"
    if processes := terminal.processes():
        return f"processes are left: {processes}"
    files = [str(each.relative_to(base)) for each in base.rglob("*") if not each.is_dir()]
    return f"files are left: {files}" if files and kind not in UNCLEAN else ""


def main() -> None:
    """Run with the command line's options."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--ends", type=int, default=500)
    parser.add_argument("--kind", choices=KINDS, action="append", help="only of this kind; may be given several times")
    options = parser.parse_args()
    folder, base = Path(tempfile.mkdtemp(prefix="ends")), Path(tempfile.mkdtemp(prefix="bcs"))
    os.environ |= {"BOT_CONSOLE_SOCKET_DIR": str(base), "XDG_STATE_HOME": str(folder), "XDG_CONFIG_HOME": str(folder)}
    os.environ["TMPDIR"] = str(base)
    counts: Counter[str] = Counter()
    failed: list[str] = []
    kinds = options.kind or list(KINDS)
    try:
        for number in range(options.ends):
            kind = kinds[number % len(kinds)]
            counts[kind] += 1
            wrong = end(kind, folder, base)
            failed += [f"{kind}: {wrong}"] if wrong else []
            print(f"{number + 1} of {options.ends}, {kind}: {wrong or 'clean'}", file=sys.stderr, flush=True)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        shutil.rmtree(base, ignore_errors=True)
    print(json.dumps({"ends": counts, "failed": failed}, indent=2))
    sys.exit(bool(failed))


if __name__ == "__main__":
    main()
