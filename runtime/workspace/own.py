"""The package `intelligent_robot` that comes along: the folders `nodes/`, `launch/` and `profiles/`."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType

from bot_console.runtime.workspace.package import EntryPoint, Package
from bot_console.runtime.workspace.share import link

NAME = "intelligent_robot"
ROOT = Path(__file__).resolve().parents[2]
"""Where `nodes/`, `launch/` and `profiles/` lie side by side, in a checkout and in an installed wheel."""


def own_package() -> Package:
    """The package as if it had been read from a source folder: each `*_node.py` is an executable."""
    nodes = ROOT / "nodes"
    names = sorted(each.stem for each in nodes.glob("*_node.py"))
    entry_points = {name: EntryPoint(f"{NAME}.{name}", "main") for name in names}
    return Package(NAME, nodes, "ament_python", executables=MappingProxyType(entry_points))


def own_share(links: Path) -> Path:
    """Its share folder: `launch/`, `config/` with each profile under both its names, and `worlds/`."""
    place = links / NAME
    for path in (ROOT / "launch").glob("*.launch.*"):
        link(path, place / "launch" / path.name)
    for path in (ROOT / "profiles").glob("*.yaml"):
        link(path, place / "config" / path.name)
        link(path, place / "config" / f"{path.stem}_config.yaml")
    for path in (ROOT / "profiles" / "worlds").glob("*.yaml"):
        link(path, place / "worlds" / path.name)
    return place
