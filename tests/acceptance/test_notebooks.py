"""rclpy in notebooks and IPython: a node in a background thread, an interrupted cell, a restarted kernel."""

from __future__ import annotations

import json
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from helpers.shells import in_shell, make_home, python, set_up
from jupyter_client.manager import KernelManager

if os.name != "posix":
    pytest.skip("needs a shell", allow_module_level=True)

NOTEBOOK = Path(__file__).resolve().parents[2] / "examples" / "robot.ipynb"
TIMEOUT_S = 240.0
"""Seconds after which a cell fails; nothing is measured by it."""

BEGIN = """
import threading, rclpy
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import String

rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
node = rclpy.create_node("notebook")
heard = threading.Event()
node.create_subscription(String, "t", lambda message: heard.set(), 1)
publisher = node.create_publisher(String, "t", 1)
threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
"""
HEARS = "heard.clear(); publisher.publish(String()); print(heard.wait(100.0))"
NODES = """
while node.get_node_names() != ["notebook"]:  # until nothing is left of the kernel before
    threading.Event().wait(0.05)
print(node.get_node_names())
"""


class Kernel:
    """A kernel of this interpreter, as Jupyter starts it."""

    def __init__(self, env: Mapping[str, str], folder: Path) -> None:
        self._manager = KernelManager(
            transport="ipc", ip=str(folder / "kernel"), connection_file=str(folder / "kernel.json")
        )
        self._manager.start_kernel(env=dict(env), cwd=str(folder))
        self._client = self._manager.blocking_client()
        self._client.start_channels()
        self._client.wait_for_ready(timeout=TIMEOUT_S)

    def run(self, cell: str, interrupt_at: str = "") -> tuple[str, str]:
        """Run a cell; return its output and the name of the exception that ended it. It is interrupted when it prints a
        text."""
        printed: list[str] = []

        def take(message: Mapping[str, Any]) -> None:
            printed.append(message["content"].get("text", ""))
            if interrupt_at and interrupt_at in printed[-1]:
                self._manager.interrupt_kernel()

        reply = self._client.execute_interactive(cell, timeout=TIMEOUT_S, output_hook=take)
        return "".join(printed), reply["content"].get("ename", "")

    def restart(self, *, now: bool) -> None:
        """Restart the kernel as the menu does; with `now`, as for a kernel that does not answer."""
        self._manager.restart_kernel(now=now)
        self._client.wait_for_ready(timeout=TIMEOUT_S)

    def end(self) -> None:
        """Shut the kernel down, as closing the notebook does."""
        self._client.stop_channels()
        self._manager.shutdown_kernel(now=True)
        self._manager.cleanup_resources()


@pytest.fixture
def env(tmp_path: Path) -> dict[str, str]:
    home = make_home(tmp_path)
    return {**set_up(home), "BOT_CONSOLE_SOCKET_DIR": str(tmp_path), "BOT_CONSOLE_USER_DIR": str(tmp_path / "user")}


@pytest.fixture
def kernel(env: dict[str, str]) -> Iterator[Kernel]:
    folder = Path(tempfile.mkdtemp(prefix="bcn"))  # short, since its sockets are below it
    made = Kernel(env, folder)
    yield made
    made.end()
    shutil.rmtree(folder, ignore_errors=True)


@pytest.mark.slow
def test_interrupt_ends_the_cell_and_a_restart_leaves_no_node(kernel: Kernel) -> None:
    assert kernel.run(BEGIN) == ("", "")
    assert kernel.run(HEARS) == ("True\n", "")
    cell = "print('waits', flush=True); threading.Event().wait()"
    assert kernel.run(cell, interrupt_at="waits") == ("waits\n", "KeyboardInterrupt")
    assert kernel.run(HEARS) == ("True\n", ""), "the node keeps spinning"
    for now in (False, True):
        kernel.restart(now=now)
        assert kernel.run(BEGIN + NODES) == ("['notebook']\n", "")


@pytest.mark.soak
def test_example_notebook_runs_and_ends_its_robot(kernel: Kernel, env: dict[str, str]) -> None:
    cells = [each for each in json.loads(NOTEBOOK.read_text("utf-8"))["cells"] if each["cell_type"] == "code"]
    printed = [kernel.run("".join(each["source"])) for each in cells]
    assert not any(failed for _, failed in printed), printed
    text = "".join(each for each, _ in printed)
    assert "speed while turning: 0.0 m/s" in text and "Double value is: " in text
    there = in_shell("bash", Path(env["HOME"]), "bot-console status", env)
    assert (there.returncode, "nothing is running" in there.stderr) == (1, True)


@pytest.mark.slow
def test_ipython_imports_and_spins(env: dict[str, str]) -> None:
    begin = "import rclpy; rclpy.init(); node = rclpy.create_node('n')"
    line = f"{begin}; rclpy.spin_once(node, timeout_sec=0.0); print(node.get_name())"
    done = python(["-m", "IPython", "--no-banner", "--colors=nocolor", "-c", line], env, sys.executable)
    assert (done.stdout, done.returncode) == ("n\n", 0), done.stderr
