"""The README of the exported package, generated from its files: contents, build, launch and tuning."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, cast

import yaml


def readme(name: str, place: Path, executables: Iterable[str]) -> str:
    """Return the text for the package that was written to `place`."""
    files = {each.stem.removesuffix("_config"): each for each in sorted((place / "config").glob("*.yaml"))}
    profiles = list(files)
    commands = "\n".join(f"- `ros2 run {name} {each}`" for each in sorted(executables))
    launch_files = sorted(each.name for each in (place / "launch").iterdir())
    return f"""# {name}

A small robot system of ROS 2 nodes and a simulated robot to run them on, with settings for {", ".join(profiles)}.

## Build

    pip install pymunk
    colcon build --packages-select {name}
    source install/setup.bash

## Launch

    ros2 launch {name} robot_system.launch.py profile:={profiles[0]}
    ros2 launch {name} robot_system.launch.py --show-args

Launch files: {", ".join(launch_files)}.
`config_file:=FILE` gives all nodes another parameter file;
`navigator:=my_node.py` lets a Python file of yours drive, which need not be executable.

## Nodes

{commands}

## Parameters

`ros2 param describe /robot_navigator max_speed` tells what a parameter means and its range; values outside are refused
with the reason. These are the values of the profiles in `config/`:

{_table(profiles, [_flat(yaml.safe_load(each.read_text("utf-8"))) for each in files.values()])}
"""


def _table(names: list[str], profiles: list[Mapping[str, object]]) -> str:
    keys = list(dict.fromkeys(key for values in profiles for key in values))
    head = [f"| parameter | {' | '.join(names)} |", "|" + " --- |" * (len(names) + 1)]
    return "\n".join(
        [*head, *(f"| `{key}` | {' | '.join(str(each.get(key, '')) for each in profiles)} |" for key in keys)]
    )


def _flat(tree: Mapping[str, object], prefix: str = "") -> dict[str, Any]:
    found: dict[str, object] = {}
    for key, value in tree.items():
        path = prefix if key == "ros__parameters" else f"{prefix}{'.' if prefix else ''}{key}"
        found.update(_flat(cast("dict[str, Any]", value), path) if isinstance(value, dict) else {path: value})
    return found
