"""`ros2 launch`: runs a launch file, given by its path or by package and name."""

from __future__ import annotations

import argparse
import atexit
import os
import signal
import sys
import threading
from functools import partial
from types import FrameType

from bot_console.runtime.workspace.available_names import launch_file_names, package_names
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.launch_place import place_of
from ros2cli.advice import advise, launch_files
from ros2cli.command import Command, Result
from ros2cli.launch_file import LaunchFileError, named_launch_file, package_errors_converted, parse_launch_arguments


def _arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "-n",
        "--noninteractive",
        default=not sys.stdin or not sys.stdin.isatty(),
        action="store_true",
        help="There is no terminal: launch itself sends SIGINT to the processes",
    )
    parser.add_argument("-d", "--debug", default=False, action="store_true", help="Log everything, with tracebacks")
    what = parser.add_mutually_exclusive_group()
    what.add_argument(
        "-p",
        "--print",
        "--print-description",
        default=False,
        action="store_true",
        dest="print",
        help="Print the tree of the launch file and run nothing",
    )
    what.add_argument(
        "-s",
        "--show-args",
        "--show-arguments",
        default=False,
        action="store_true",
        dest="show_args",
        help="Print the arguments of the launch file and run nothing",
    )
    parser.add_argument(
        "-a",
        "--show-all-subprocesses-output",
        action="store_true",
        help="Show what all processes print, whatever the launch file says",
    )
    parser.add_argument(
        "--launch-prefix",
        help="Command to put before all executables, in quotes where it has spaces",
    )
    parser.add_argument(
        "--launch-prefix-filter",
        help="Regular expression for the names of executables that get the --launch-prefix",
    )
    parser.add_argument(
        "--resolved", action="store_true", help="With --print: the tree with everything evaluated, and each parameter"
    )
    parser.add_argument(
        "--allow-missing", action="store_true", help="Go on without nodes whose executables are not installed"
    )
    parser.add_argument("package_name", help="The package that has the launch file, or the path of a launch file")
    parser.add_argument("launch_file_name", nargs="?", help="The launch file's name, in a package")
    parser.add_argument(
        "launch_arguments",
        nargs="*",
        help="Arguments of the launch file: '<name>:=<value>'; of several with one name the last counts",
    )


def _launch(arguments: argparse.Namespace) -> Result:
    if not arguments.package_name:
        return "name a launch file, or a package and one of its launch files"
    name = arguments.launch_file_name
    words = [*([name] if name is not None else []), *arguments.launch_arguments]
    try:
        if arguments.show_args and name is None and not os.path.isfile(arguments.package_name):
            with package_errors_converted(arguments.package_name):
                return _list_launch_files(arguments.package_name)
        path, words = named_launch_file(arguments.package_name, words)
    except LaunchFileError as error:
        print(error, file=sys.stderr)
        if name is not None:
            advise(partial(_launch_files_of, arguments.package_name))
        return 1
    if arguments.show_all_subprocesses_output:
        os.environ["OVERRIDE_LAUNCH_PROCESS_OUTPUT"] = "both"
    try:
        return _act(arguments, path, words)
    except LaunchFileError as error:
        return str(error)


def _launch_files_of(package: str) -> str:
    return launch_files(package, launch_file_names(package)) if package in package_names() else ""


def _list_launch_files(package: str) -> Result:
    """List the launch files for `--show-args`; raises `PackageNotFoundError` and `ValueError` for the package."""
    from ament_index_python.packages import get_package_share_directory

    share = get_package_share_directory(package)
    names = launch_file_names(package)
    if not names:
        return f"package '{package}' has no launch files in its share directory, which is at '{share}'"
    print(f"Launch files of package '{package}' (add one to see its arguments):\n")
    for name in names:
        print(f"    {name}")
    return 0


def _act(arguments: argparse.Namespace, path: str, words: list[str]) -> Result:
    if arguments.show_args or arguments.print:
        from ros2cli.launch_print import print_description, print_resolved, show_args

        if arguments.show_args:
            return show_args(path)
        return print_resolved(path, parse_launch_arguments(words)) if arguments.resolved else print_description(path)
    if arguments.resolved:
        return "--resolved goes with --print"
    given = parse_launch_arguments(words)
    if arguments.launch_prefix_filter is not None and arguments.launch_prefix is None:
        return "--launch-prefix must be specified if --launch-prefix-filter is provided"
    for name, value in (
        ("launch-prefix", arguments.launch_prefix),
        ("launch-prefix-filter", arguments.launch_prefix_filter),
    ):
        if value is not None:
            given[name] = value
    options = {"noninteractive": arguments.noninteractive, "debug": arguments.debug}
    return launch(path, given, missing_allowed=arguments.allow_missing, **options)


def launch(
    path: str,
    arguments: dict[str, str],
    *,
    noninteractive: bool = False,
    debug: bool = False,
    missing_allowed: bool = False,
) -> int:
    """Run a launch file to its end; returns 1 if the launch itself failed, regardless of its processes' exit codes."""
    from launch.undeclared_arguments import WarnOfUndeclaredArguments

    from launch import LaunchDescription, LaunchService

    service = LaunchService(argv=sys.argv[1:], noninteractive=noninteractive, debug=debug)
    include = IncludeLaunchDescription(AnyLaunchDescriptionSource(path), launch_arguments=arguments.items())
    if missing_allowed:
        from launch_ros.missing_executables import allow_missing

        allow_missing(service)
    service.include_launch_description(LaunchDescription([include, WarnOfUndeclaredArguments(arguments)]))
    if threading.current_thread() is threading.main_thread():
        # The run installs its own handler, and restores this one at the end.
        signal.signal(signal.SIGINT, _ignore_late_interrupt)
        # Python removes its own handlers before the process has ended.
        atexit.register(signal.signal, signal.SIGINT, signal.SIG_IGN)
    code = service.run()
    if service.failure is not None:
        advise(partial(_failed_at, service.failure))
    return code


def _failed_at(failure: Exception) -> str:
    place = place_of(failure)
    return place and f"the launch failed at {place}"


def _ignore_late_interrupt(number: int, frame: FrameType | None) -> None:
    """Ignore the first interrupt after the end of a launch; the second one ends a program that does not exit."""
    signal.signal(number, signal.default_int_handler)


COMMAND = Command("launch", "Run a launch file", arguments=_arguments, main=_launch)
