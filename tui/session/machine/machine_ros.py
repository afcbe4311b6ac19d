"""Finds an installed real ROS 2, that is, an `rclpy` that is not ours. ROS_DISTRO proves nothing, as we set it too."""

from __future__ import annotations

import importlib.machinery
import os
import re
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

RUNTIME = Path(__file__).resolve().parents[3] / "runtime"
OLDEST = (3, 10)
"""The oldest Python that bot-console supports."""
_EXTENSION = re.compile(r"_rclpy_pybind11\.(?:cpython-)?(\d)(\d+)")
_WHEEL = re.compile(r"ros_([a-z]+)_rclpy-")
_FOLDER = re.compile(r"python(\d)\.(\d+)$")


@dataclass(frozen=True)
class MachineRos:
    """An `rclpy` of the machine: its folder, the Python that it was built for if that is another than the running one,
    and the distributions whose wheels from PyPI are installed beside it.
    """

    folder: Path
    other_python: str = ""
    wheels: tuple[str, ...] = ()

    @property
    def usable(self) -> bool:
        """Whether this program can import the `rclpy`."""
        return not self.other_python and not self.is_mixed

    @property
    def is_mixed(self) -> bool:
        """Whether wheels of several distributions have overwritten each other's files."""
        return len(self.wheels) > 1

    def __str__(self) -> str:
        distro = os.environ.get("ROS_DISTRO", "") or " and ".join(self.wheels)
        return f"ROS 2 {distro}".rstrip() + f" ({self.folder})"


def find_machine_ros(path: Iterable[str] | None = None) -> MachineRos | None:
    """Find the `rclpy` that an import would find without our finder, or else one in the sourced prefixes."""
    found = _importable(path)
    if found is not None:
        return found
    for folder in _rclpy_in_prefixes():
        match = _FOLDER.search(folder.parent.parent.name)
        other = f"{match[1]}.{match[2]}" if match else "another version"
        return MachineRos(folder, "" if other == _running_python() else other)
    return None


def how_to_install(ros: MachineRos) -> str:
    """One line of advice if the machine's ROS 2 is for another Python, or is a mixture."""
    if ros.is_mixed:
        one = ros.wheels[-1]
        return (
            f"the wheels of ROS 2 {' and '.join(ros.wheels)} are in one environment, where they overwrite each other: "
            f"make one for each (`python3 -m venv ~/{one} && ~/{one}/bin/pip install 'bot-console[ros-{one}]'`)"
        )
    whose = f"{ros} is sourced; it is for Python {ros.other_python}, while this bot-console runs on {_running_python()}"
    if _is_too_old(ros.other_python):
        return (
            f"{whose}, and needs {OLDEST[0]}.{OLDEST[1]} or newer: reach the robot over the network instead, if its "
            "middleware is Zenoh (`bot-console attach --connect tcp/robot:7447`)"
        )
    python = f"python{ros.other_python}" if ros.other_python[:1].isdigit() else "python3"
    return (
        f"{whose}: install it there, in its clone, by `{python} -m venv --system-site-packages ~/bot-console && "
        f"~/bot-console/bin/pip install .`, or by `{python} -m pip install --user .`"
    )


def _is_too_old(python: str) -> bool:
    """Whether bot-console does not support a Python of this version."""
    major, _, minor = python.partition(".")
    return major.isdigit() and minor.isdigit() and (int(major), int(minor)) < OLDEST


def _importable(path: Iterable[str] | None) -> MachineRos | None:
    folders = (each for each in (sys.path if path is None else path) if not _has_shims(each))
    spec = importlib.machinery.PathFinder.find_spec("rclpy", list(folders))
    if spec is None or not spec.origin:
        return None
    origin = Path(spec.origin)
    if origin.name != "__init__.py" or RUNTIME in origin.resolve().parents:
        return None  # it is ours
    return MachineRos(origin.parent, _other_python(origin.parent), _wheels(origin.parent))


def _has_shims(folder: str) -> bool:
    """Whether a folder contains what `bot-console setup` puts on the path in place of the ROS packages."""
    return os.path.lexists(os.path.join(folder, "bot_console_shims.py"))


def _other_python(folder: Path) -> str:
    """The Python for which the extension module of an `rclpy` was built; empty if the running one can load it."""
    extensions = [*folder.glob("_rclpy_pybind11*"), *folder.parent.glob("_rclpy_pybind11*")]
    names = [each.name for each in extensions if each.suffix in (".so", ".pyd")]
    suffixes = tuple(importlib.machinery.EXTENSION_SUFFIXES)
    if not names or any(name == "_rclpy_pybind11" + suffix for name in names for suffix in suffixes):
        return ""
    match = _EXTENSION.match(names[0])
    return f"{match[1]}.{match[2]}" if match else "another version"


def _wheels(folder: Path) -> tuple[str, ...]:
    """The distributions whose `rclpy` from PyPI is installed: `ros-jazzy-rclpy`, `ros-kilted-rclpy`."""
    names = (_WHEEL.match(each.name) for each in folder.parent.glob("ros_*_rclpy-*.dist-info"))
    return tuple(sorted({name[1] for name in names if name}))


def _rclpy_in_prefixes() -> Iterator[Path]:
    for prefix in filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)):
        for lib in ("lib", "local/lib"):
            yield from sorted(Path(prefix).glob(f"{lib}/python*/*-packages/rclpy"))


def _running_python() -> str:
    return f"{sys.version_info.major}.{sys.version_info.minor}"
