"""Imitates an installed ROS 2: a folder that contains `rclpy`, `launch` and the messages as ordinary packages.

They are copies of the embedded runtime, found through the path and not by our finder, so that `attach --ros` treats
them as the machine's. Any attribute that real ROS 2 lacks, or does not declare public, raises `AttributeError` when
the console accesses it, according to the lists in `public_ros.py`.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from bot_console.runtime.importer import GENERATED, PACKAGES, RUNTIME

HOOK = """\
import os, sys

os.environ["_ROS_WHEELS_BOOTSTRAP_COMPLETE"] = "1"  # As the wheels of PyPI do in every Python of their environment.
sys.path.append({helpers!r})
from bot_console.runtime.children.child_discovery import let_children_meet
from bot_console.runtime.rmw.zenoh.domain.domain_bus import share_domains

share_domains()
let_children_meet(True)
from fakes.public_ros import PublicOnly

sys.meta_path.insert(0, PublicOnly())
"""


def make_standin(folder: Path) -> dict[str, str]:
    """Create the installation in a folder; return the environment that sourcing it would set."""
    place = folder / "ros"
    for name in PACKAGES:
        shutil.copytree(Path(RUNTIME) / name, place / name, ignore=shutil.ignore_patterns("__pycache__"))
    for each in Path(GENERATED).iterdir():
        if each.is_dir() and (each / "__init__.py").is_file():
            shutil.copytree(each, place / each.name, ignore=shutil.ignore_patterns("__pycache__"))
    (place / "sitecustomize.py").write_text(HOOK.format(helpers=str(Path(__file__).parents[1])))
    before = os.environ.get("PYTHONPATH", "")
    path = os.pathsep.join(filter(None, (str(place), before)))
    return {**os.environ, "PYTHONPATH": path, "ROS_DISTRO": "standin", "RMW_IMPLEMENTATION": "rmw_standin"}
