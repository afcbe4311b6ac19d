"""`ros2 interface`: list, package, packages, proto and show; and `add`, for which ROS 2 needs a build."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from bot_console.runtime.interfaces.further_interfaces import NotAdded, add, unverified_folders
from bot_console.runtime.interfaces.interface_finder import interface_folders
from bot_console.runtime.rosidl.names import KINDS
from ros2cli.command import Command, Result, Verb
from ros2cli.interface_text import show_text
from ros2cli.type_discovery import learn_type, not_installed
from rosidl_runtime_py import (
    get_action_interfaces,
    get_message_interfaces,
    get_service_interfaces,
    message_to_yaml,
)
from rosidl_runtime_py.utilities import get_action, get_message, get_service

UNVERIFIED = (
    "names and types of the fields of {0} were read from public sources, its type hash was not compared with ROS 2; "
    "beside a real robot add the package's own sources: bot-console interface add FOLDER"
)


def _all() -> dict[str, list[str]]:
    """Return the interfaces by package, such as `msg/String`."""
    found: dict[str, list[str]] = {}
    for get in (get_message_interfaces, get_service_interfaces, get_action_interfaces):
        interfaces: Mapping[str, Sequence[str]] = get()
        for package, names in interfaces.items():
            found.setdefault(package, []).extend(names)
    return {package: sorted(names) for package, names in sorted(found.items()) if names}


def _kind_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("-m", "--only-msgs", action="store_true", help="Print out only the message types")
    parser.add_argument("-s", "--only-srvs", action="store_true", help="Print out only the service types")
    parser.add_argument("-a", "--only-actions", action="store_true", help="Print out only the action types")


def _wanted(arguments: argparse.Namespace) -> list[str]:
    flags = (arguments.only_msgs, arguments.only_srvs, arguments.only_actions)
    return [kind for kind, flag in zip(KINDS, flags, strict=True) if flag] or list(KINDS)


def _list(arguments: argparse.Namespace) -> Result:
    titles = {"msg": "Messages:", "srv": "Services:", "action": "Actions:"}
    interfaces = _all()
    for kind in _wanted(arguments):
        print(titles[kind])
        for package, names in interfaces.items():
            for name in names:
                if name.startswith(f"{kind}/"):
                    print(f"    {package}/{name}")
    return None


def _package_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("package_name", help="Name of the ROS package (e.g. 'example_interfaces')")
    _kind_arguments(parser)


def _package(arguments: argparse.Namespace) -> Result:
    names = _all().get(arguments.package_name)
    if names is None:
        return f"Unknown package '{arguments.package_name}'"
    for name in names:
        if name.split("/")[0] in _wanted(arguments):
            print(f"{arguments.package_name}/{name}")
    return None


def _packages(arguments: argparse.Namespace) -> Result:
    wanted = tuple(f"{kind}/" for kind in _wanted(arguments))
    for package, names in _all().items():
        if any(name.startswith(wanted) for name in names):
            print(package)
    return None


def _proto_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("type", help="Show an interface definition (e.g. 'example_interfaces/msg/String')")
    parser.add_argument("--no-quotes", action="store_true", help="if true output has no outer quotes.")


def _proto(arguments: argparse.Namespace) -> Result:
    why = learn_type(arguments.type)
    if why:
        return not_installed(arguments.type, why)
    try:
        kind = _prototype(arguments.type)
    except (AttributeError, ImportError, LookupError, TypeError, ValueError) as error:
        if isinstance(error, AttributeError) and re.fullmatch(r"\w+/(msg|srv|action)/\w+", arguments.type):
            raise  # the package has no such name, which is reported as in ROS 2
        return f"Unknown interface '{arguments.type}'"
    text = message_to_yaml(kind())
    print(text if arguments.no_quotes else f'"{text}"')
    return None


def _prototype(name: str) -> Any:
    if "/srv/" in name:
        return get_service(name).Request
    if "/action/" in name:
        return get_action(name).Goal
    return get_message(name)


def _show_arguments(parser: argparse.ArgumentParser) -> None:
    comments = parser.add_mutually_exclusive_group()
    comments.add_argument(
        "--all-comments",
        action="store_true",
        help="Show all comments, including for nested interface definitions",
    )
    comments.add_argument(
        "--no-comments", action="store_true", help="Show no comments or whitespace; show only the interface definition"
    )
    parser.add_argument(
        "type",
        help="Show an interface definition (e.g. 'example_interfaces/msg/String'). Passing '-' reads the argument from "
        "stdin (e.g. 'ros2 topic type /chatter | ros2 interface show -').",
    )


def _show(arguments: argparse.Namespace) -> Result:
    name = sys.stdin.readline().strip() if arguments.type == "-" else arguments.type
    if len(name.split("/")) != 3:
        return f"Invalid name '{name}'. Expected three parts separated by '/'"
    try:
        text = _text(name, arguments)
    except LookupError as error:
        return str(error.args[0])
    except OSError as error:  # such as a name too long for a file
        return f"Unknown interface '{name[:80]}': {error.strerror}"
    print(text, end="")
    package = name.partition("/")[0]
    if interface_folders().get(package) == unverified_folders().get(package, ""):
        print(f"[INFO] [bot-console]: {UNVERIFIED.format(package)}", file=sys.stderr)
    return None


def _text(name: str, arguments: argparse.Namespace) -> str:
    """Return the installed definition, or the one learned from a node; raises `LookupError` if there is neither."""
    try:
        return show_text(name, all_comments=arguments.all_comments, no_comments=arguments.no_comments)
    except LookupError:
        why = learn_type(name)
        if why is None:
            raise
        if why:
            raise LookupError(not_installed(name, why)) from None
    return show_text(name, all_comments=arguments.all_comments, no_comments=arguments.no_comments)


def _add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", type=Path, help="A package that defines interfaces, or a checkout with such")


def _add(arguments: argparse.Namespace) -> Result:
    try:
        added = add(arguments.folder)
    except (NotAdded, OSError) as error:
        return f"nothing added: {error}"
    from bot_console.runtime.shim_folder import refresh_shims

    refresh_shims()
    for package, names in added.items():
        print(f"added {package}: {', '.join(names)}")
    return None


COMMAND = Command(
    "interface",
    "Show information about ROS interfaces",
    (
        Verb("add", "Keep the interfaces of a folder, for every program (not in ROS 2)", _add, _add_arguments),
        Verb("list", "List all interface types available", _list, _kind_arguments),
        Verb("package", "Output a list of available interface types within one package", _package, _package_arguments),
        Verb("packages", "Output a list of packages that provide interfaces", _packages, _kind_arguments),
        Verb("proto", "Output an interface prototype", _proto, _proto_arguments),
        Verb("show", "Output the interface definition", _show, _show_arguments),
    ),
)
