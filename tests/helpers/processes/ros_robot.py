"""The live robot on the machine's own rclpy: the nodes of the exported package, each in a separate process.

Requests that the rig otherwise makes by the console's command line are made through ROS 2 instead.
"""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

from processes.live_robot import TIMEOUT_S, LiveRobot

PACKAGE = "bot_console_robot"
NODE = "import importlib, sys; importlib.import_module(sys.argv.pop(1)).main()"
"""Runs a module of the exported package."""
CALLS = """
import sys
import rclpy
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("caller")
for name in sys.argv[1:]:
    client = node.create_client(Trigger, name)
    client.wait_for_service()
    future = client.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future)
    print(name, future.result(), flush=True)
"""
"""Calls services of the type `Trigger`."""
TRANSFORMS = """
from std_msgs.msg import Empty

type(Empty).__import_type_support__()


class Kind(type(Empty)):
    def __call__(cls, **fields):
        return Empty()

    def __instancecheck__(cls, instance):
        return isinstance(instance, Empty)


class TFMessage(Empty, metaclass=Kind):
    pass
"""
"""A stand-in for `tf2_msgs.msg`, which the rclpy of PyPI lacks: transforms are sent as empty messages."""


class RosRobot(LiveRobot):
    """A robot on the sourced rclpy, which must belong to `sys.executable`.

    Only a second program drives it, on the spot, so that no wall stops it.
    """

    attach = (*LiveRobot.attach, "--ros")
    circle = ("0.0", "0.8")

    def __init__(self, folder: Path, environment: Mapping[str, str]) -> None:
        subprocess.run(
            [sys.executable, "-m", "bot_console.tui", "export", str(folder)], check=True, stdout=subprocess.DEVNULL,
            timeout=TIMEOUT_S,
        )  # fmt: skip
        self._package = folder / PACKAGE
        if importlib.util.find_spec("tf2_msgs") is None:
            (self._package / "tf2_msgs").mkdir(exist_ok=True)
            (self._package / "tf2_msgs" / "msg.py").write_text(TRANSFORMS)
        prefix = folder / "install"
        marker = prefix / "share" / "ament_index" / "resource_index" / "packages" / PACKAGE
        marker.parent.mkdir(parents=True)
        marker.touch()
        (prefix / "share" / PACKAGE).symlink_to(self._package)
        stops = folder / "bot-console" / "stops" / f"domain-{environment['ROS_DOMAIN_ID']}.json"
        super().__init__(
            folder, {**environment, "BOT_CONSOLE_STOP_FILE": str(stops), "AMENT_PREFIX_PATH": str(prefix),
                     "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"},
        )  # fmt: skip

    def start(self) -> None:
        """Start everything but the witness."""
        self._node("robot_node", "-r", "__node:=robot_navigator", "-r", "cmd_vel:=nobody_listens_here")
        self.start_base()
        self.start_monitor()
        self.second_driver()

    def _node(self, module: str, *words: str) -> subprocess.Popen[bytes]:
        config = self._package / "config" / "indoor_config.yaml"
        return self._run(NODE, f"{PACKAGE}.{module}", "--ros-args", "--params-file", str(config), *words)

    def _run(self, text: str, *words: str, stdout: int | None = None) -> subprocess.Popen[bytes]:
        process = subprocess.Popen(
            [sys.executable, "-c", text, *words], cwd=self.folder, stdin=subprocess.DEVNULL,
            env={**self.environment, "PYTHONPATH": str(self._package)}, start_new_session=True,
            stdout=self._log if stdout is None else stdout, stderr=self._log,
        )  # fmt: skip
        self._started.append(process)
        return process

    def program(self, text: str, *words: str, stdout: int | None = None) -> subprocess.Popen[bytes]:
        """Start a node as a separate program."""
        return self._run(text, *words, stdout=stdout)

    def console(
        self, *words: str | bytes, stdout: int | None = None, environment: Mapping[str, str] | None = None
    ) -> subprocess.Popen[bytes]:
        """Make the request of a command line through ROS 2; raise `ValueError` for one that requests nothing of it."""
        match words:
            case ["run", "bot_console_robot", str(executable), *options]:
                name = {"simulator_node": "simulator", "safety_node": "safety_monitor"}[executable]
                return self._node(executable, "-r", f"__node:={name}", *map(str, options[1:]))
            case ["release", *options]:
                verb = "release_all" if options else "release"
                return self._run(CALLS, *(f"/{node}/{verb}" for node in ("safety_monitor", "simulator")))
            case ["service", "call", str(name), "std_srvs/srv/Trigger"]:
                return self._run(CALLS, name)
            case _:
                raise ValueError(f"not possible on ROS 2: {words}")

    def answer(self, *words: str) -> str:
        """The end of its processes' output, in place of the output of a command line."""
        return self.log()[-500:]
