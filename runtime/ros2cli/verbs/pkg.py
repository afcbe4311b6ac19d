"""`ros2 pkg`: list, prefix, executables, xml and create."""

from __future__ import annotations

import argparse
from pathlib import Path

from ament_index_python.packages import (
    PackageNotFoundError,
    get_package_prefix,
    get_package_share_directory,
    get_packages_with_prefixes,
)
from bot_console.runtime.workspace.executables import executable_names
from ros2cli.command import Command, Result, Verb
from ros2cli.verbs import pkg_create


def _list(arguments: argparse.Namespace) -> Result:
    for name in sorted(get_packages_with_prefixes()):
        print(name)
    return None


def _prefix_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("--share", action="store_true", help="show share directory for the package")


def _prefix(arguments: argparse.Namespace) -> Result:
    try:
        find = get_package_share_directory if arguments.share else get_package_prefix
        print(find(arguments.package_name))
    except (PackageNotFoundError, ValueError):
        return "Package not found"
    return None


def _executables_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("package_name", nargs="?", help="The package name")
    parser.add_argument("--full-path", action="store_true", help="Show full path of each executable")


def _executables(arguments: argparse.Namespace) -> Result:
    names = [arguments.package_name] if arguments.package_name else sorted(get_packages_with_prefixes())
    for name in names:
        try:
            found = executable_names(name)
        except (PackageNotFoundError, ValueError):
            return f"Package '{name}' not found"
        for executable, path in sorted(found.items()):
            print(path if arguments.full_path else f"{name} {executable}")
    return None


def _xml_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("-t", "--tag", help="The XML tag to output, e.g. version")


def _xml(arguments: argparse.Namespace) -> Result:
    from xml.etree import ElementTree

    try:
        path = Path(get_package_share_directory(arguments.package_name)) / "package.xml"
    except (PackageNotFoundError, ValueError):
        return "Package not found"
    if not path.exists():
        return "Package xml manifest not found"
    tree = ElementTree.parse(path)
    if arguments.tag is None:
        ElementTree.dump(tree)
        return None
    found = tree.getroot().findall(arguments.tag)
    for each in found:
        print(each.text)
    return None if found else "XML tag not found"


COMMAND = Command(
    "pkg",
    "Various package related sub-commands",
    (
        Verb("create", "Create a new ROS 2 package", pkg_create.create, pkg_create.arguments),
        Verb("executables", "Output a list of package specific executables", _executables, _executables_arguments),
        Verb("list", "Output a list of available packages", _list),
        Verb("prefix", "Output the prefix path of a package", _prefix, _prefix_arguments),
        Verb("xml", "Output the XML of the package manifest or a specific tag", _xml, _xml_arguments),
    ),
)
