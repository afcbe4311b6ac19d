"""One run of the simulator, in a forked process with everything already imported."""

from __future__ import annotations

import contextlib
import gc
import importlib
import json
import os
import signal
from collections.abc import Callable, Mapping, Sequence
from typing import Any

LAUNCHED = ("robot_node", "sensor_node", "safety_node", "controller_node", "telemetry_node", "simulator_node")
MODULES = (
    "bot_console.tui.cli.headless.launches",
    "bot_console.tui.cli.headless.run",
    "bot_console.tui.cli.headless.probe",
    "launch.actions",
    "bot_console.tui.console.plot.watch",
    "bot_console.tui.tuning.score",
    "launch.event_handlers",
    "launch.launch_description_sources",
    "launch_ros.actions",
    "diagnostic_msgs.msg",
    "visualization_msgs.msg",
    "rosgraph_msgs.msg",
    "geometry_msgs.msg",
    "pymunk",
    "bot_console.runtime.process.node.main_thread",
    "bot_console.runtime.process.stepping.stepped_time",
    "bot_console.runtime.rmw.lockstep.coordination",
    "bot_console.runtime.rmw.parameter_file",
    "rcl_interfaces.srv._get_logger_levels",
    "rcl_interfaces.srv._set_logger_levels",
    "rclpy.logging_service",
    "rclpy.validate_node_name",
    "service_msgs.msg._service_event_info",
    "std_srvs.srv._set_bool__parts",
    "std_srvs.srv._trigger__parts",
    "numpy.random",
    *(f"bot_console_robot.{each}" for each in LAUNCHED),
)
"""The modules that a run imports."""


def warm_up() -> None:
    """Import, once at the start of the fork server, the modules that every run needs."""
    from bot_console.runtime.children.warm_up import warm_up as warm_runtime

    warm_runtime()
    for name in MODULES:
        with contextlib.suppress(ImportError):  # a package of that name in the workspace may hide it
            importlib.import_module(name)
    gc.collect()
    gc.freeze()  # otherwise the runs would traverse these objects repeatedly, and copy their memory pages


def job(
    kind: str, profile: str, parameters: str, world: str, seed: int, duration: float, words: Sequence[str],
    paths: Sequence[str], processor: int,
) -> Callable[[], object]:  # fmt: skip
    """Return the program of a run's process, which prints a JSON object; `kind` is `run` or `probe`.

    `parameters` is the path of a parameter file, `words` are launch arguments (`name:=value`), and `processor` is the
    CPU to which the process is pinned if possible, because concurrent runs might otherwise end up on the same one.
    """

    def program() -> None:
        signal.signal(signal.SIGINT, lambda number, frame: os._exit(128 + number))  # half a report would be useless
        if hasattr(os, "sched_setaffinity"):
            with contextlib.suppress(OSError):
                os.sched_setaffinity(0, {processor})
        out = os.dup(1)
        os.dup2(2, 1)  # keeps the output of nodes out of the report
        report = _run(kind, profile, parameters, world, seed, duration, dict(_pair(each) for each in words), paths)
        with os.fdopen(out, "w") as file:
            json.dump(report, file)

    return program


def _run(
    kind: str, profile: str, parameters: str, world: str, seed: int, duration: float, arguments: Mapping[str, str],
    paths: Sequence[str],
) -> dict[str, Any]:  # fmt: skip
    from bot_console.runtime.importer import install
    from bot_console.tui.cli.arguments import Options
    from bot_console.tui.cli.headless.observer import Observer
    from bot_console.tui.cli.headless.probe import ParameterProbe
    from bot_console.tui.cli.headless.run import run_simulation

    install()
    gc.disable()  # until the nodes are up, since the objects that they make stay alive
    options = Options(
        profile=profile,
        launch_arguments={**arguments, "config_file": parameters},
        headless=True,
        fast=True,
        duration=duration,
        seed=seed,
        world=world,
    )
    observer = (ParameterProbe if kind == "probe" else Observer)(duration, paths)
    report, _, launches = run_simulation(options, observer)
    if not observer.complete or launches.died:
        return {"problem": launches.died or "the system ended before its time"}
    return report


def _pair(word: str) -> tuple[str, str]:
    name, _, value = word.partition(":=")
    return name, value
