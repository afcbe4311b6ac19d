"""Writes `docs/what-runs.md`: the packages that public rclpy programs import, and how much of each is supported.

    python tools/what_runs.py

A package counts as supported if the runtime serves it; the table below lists what is known to be missing.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from fnmatch import fnmatch
from pathlib import Path

import yaml
from bot_console.runtime.importer import install, is_embedded
from bot_console.runtime.interfaces.further_interfaces import unverified_folders
from bot_console.runtime.programs.missing_packages import explain_missing_package

PAGE = Path(__file__).resolve().parents[1] / "docs" / "what-runs.md"
HEAD = """# What runs

This page shows which ROS 2 packages your Python programs can import. It lists the packages that such programs import,
the most common ones first. "yes" means that no part is known to be missing, not that every part was compared with
ROS 2. `python tools/what_runs.py` generates the page from what the runtime provides.

| package | here | what is missing, or how to get it |
| --- | --- | --- |
"""
RELEASES = {"jazzy": "7.1.5", "kilted": "9.1.2"}
"""The release of rclpy on PyPI, for each distribution."""
LIVE = Path(__file__).resolve().parents[1] / "tests" / "contract" / "live"
FOLLOWED = """
## Which releases are followed

The runtime follows ROS 2 Jazzy: recordings of rclpy 7.1.3, launch 3.4.3, launch_ros 0.26.6 and ros2cli 0.32.2, and what
the releases up to rclpy 7.1.12, launch 3.4.12, launch_ros 0.26.13, ros2cli 0.32.12, common_interfaces 5.3.8 and
rcl_interfaces 2.0.3 changed for users:

| release | what changed | here | test, or reason |
| --- | --- | --- | --- |
"""
COMPARED = f"""
`.ci/run` replays all recordings, and runs the recorded rclpy programs on the rclpy that PyPI has, with Fast DDS:
{RELEASES["jazzy"]} of Jazzy (in the wheel called 7.1.6) and {RELEASES["kilted"]} of Kilted. With `bot-console --distro
kilted`, or `BOT_CONSOLE_DISTRO=kilted`, the runtime gives Kilted's answers. Where those releases differ from the
recordings, in how many of the 965 programs, and what the runtime does by default:

| what | Jazzy {RELEASES["jazzy"]} | Kilted {RELEASES["kilted"]} | here | why |
| --- | --- | --- | --- | --- |
"""
KEPT = """
22 of the programs cannot run there, because PyPI has no `example_interfaces`.

A hundred further programs, as in tutorials and examples, run on the real rclpy of Jazzy and here
(`tools/compare_programs.py`): output, log lines, exit code and exceptions agree, but for these.

| program | why it differs |
| --- | --- |
PROGRAMS

## What differs from Jazzy on purpose, or is not done yet

| where | here | in Jazzy | why |
| --- | --- | --- | --- |
"""
PARTS = {
    "cv_bridge": "compressed images and Bayer patterns need OpenCV: `pip install 'bot-console[opencv]'`",
    "control_msgs": "the interfaces of rarely used controllers",
    "irobot_create_msgs": "`Mouse`, `IrOpcode`, `WallFollow`, `DockServo`",
    "launch_ros": "C++ components",
    "nav2_msgs": "services added after the first Jazzy release",
    "nav2_simple_commander": (
        "`BasicNavigator` has all methods; with the built-in robot, those for costmaps, docks, GPS, other maps, given "
        "paths (`followPath`, `smoothPath`), `getPathThroughPoses` and `assistedTeleop` wait for a server that it does "
        "not have"
    ),
    "launch_pytest": "`launch_service`, `launch_context` and `event_loop` for fixtures wider than a function",
    "launch_testing": "`loader` and `test_runner`; `bot-console test` and `launch_test` run test files",
    "message_filters": "`LatestTimeSynchronizer`, input aligner",
    "tf2_geometry_msgs": "`PyKDL` types",
    "turtlebot3_msgs": "`Patrol` as used by examples since 2025; `bot-console interface add FOLDER` adds a checkout",
    "tf_transformations": "`Arcball`, `clip_matrix`, `orthogonalization_matrix`",
}
"""The parts that are missing in supported packages."""
UNVERIFIED = "fields are known, the type hash was not compared with ROS 2"
BY_FREQUENCY = (
    *("rclpy", "std_msgs", "geometry_msgs", "sensor_msgs", "launch", "launch_ros", "ament_index_python", "nav_msgs"),
    *(
        "std_srvs",
        "cv_bridge",
        "example_interfaces",
        "tf_transformations",
        "tf2_ros",
        "rcl_interfaces",
        "builtin_interfaces",
    ),
    *("visualization_msgs", "turtlesim", "action_msgs", "tf2_msgs", "tf2_geometry_msgs", "sensor_msgs_py", "nav2_msgs"),
    *("message_filters", "lifecycle_msgs", "trajectory_msgs", "diagnostic_msgs", "launch_xml", "launch_yaml", "tf2_py"),
    *("rosidl_runtime_py", "action_tutorials_interfaces", "shape_msgs", "rosgraph_msgs", "unique_identifier_msgs"),
    *(
        "nav2_simple_commander",
        "launch_testing",
        "launch_testing_ros",
        "launch_pytest",
        "rosbag2_py",
        "control_msgs",
        "vision_msgs",
    ),
    *("geographic_msgs", "ackermann_msgs", "irobot_create_msgs", "tf2_sensor_msgs", "laser_geometry", "image_geometry"),
    *("map_msgs", "pcl_msgs", "can_msgs", "turtlebot3_msgs"),
    *("diagnostic_updater", "nav2_common", "xacro", "rqt_gui_py"),
)


def row(package: str) -> str:
    """A line of the table."""
    if is_embedded(package):
        missing = PARTS.get(package, "")
        return f"| `{package}` | {'partly' if missing else 'yes'} | {missing} |"
    if package in unverified_folders():
        missing = f"{PARTS[package]}; {UNVERIFIED}" if package in PARTS else UNVERIFIED
        return f"| `{package}` | {'partly' if package in PARTS else 'yes'} | {missing} |"
    why = explain_missing_package(ModuleNotFoundError(f"No module named '{package}'", name=package)) or ""
    return f"| `{package}` | no | {why} |"


def decisions() -> list[tuple[dict[str, str], dict[str, list[str]]]]:
    """The decisions about differences from a live rclpy, each with the cases that differ, by distribution."""
    found = {each: json.loads((LIVE / f"{each}.json").read_text("utf-8")) for each in RELEASES}
    rows: list[tuple[dict[str, str], dict[str, list[str]]]] = []
    for row in yaml.safe_load((LIVE / "decisions.yaml").read_text("utf-8")):
        cases = {
            distro: [case for case in outcomes if _matches(case, row["cases"], row.get("except", ()))]
            for distro, outcomes in found.items()
        }
        rows.append((row, cases))
    return rows


def _matches(case: str, patterns: Sequence[str], but: Sequence[str]) -> bool:
    return any(fnmatch(case, each) for each in patterns) and not any(fnmatch(case, each) for each in but)


def difference_rows() -> str:
    """The rows of the second table."""
    lines = ""
    for row, cases in decisions():
        shown = (f"differs ({len(cases[each])})" if cases[each] else "as recorded" for each in RELEASES)
        lines += f"| {row['what']} | {' | '.join(shown)} | as {row['here']} | {row['why']} |\n"
    return lines


def newer_release_rows() -> str:
    """The rows of the table of newer releases."""
    rows = yaml.safe_load((Path(__file__).parent / "what_runs_releases.yaml").read_text("utf-8"))
    return "".join(f"| {row['release']} | {row['entry']} | {row['here']} | {row['how']} |\n" for row in rows)


def programs() -> str:
    """The rows of the table of programs that end differently."""
    rows = yaml.safe_load((LIVE / "programs.yaml").read_text("utf-8"))
    return "".join(f"| `{name}` | {why} |\n" for name, why in rows.items())


def kept_difference_rows() -> str:
    """The rows of the third table."""
    rows = yaml.safe_load((Path(__file__).parent / "what_runs_differences.yaml").read_text("utf-8"))
    return "".join(f"| {row['where']} | {row['here']} | {row['jazzy']} | {row['why']} |\n" for row in rows)


def page() -> str:
    """The whole page."""
    install()
    kept_head = KEPT.replace("PROGRAMS\n", programs())
    return (
        HEAD
        + "".join(f"{row(each)}\n" for each in BY_FREQUENCY)
        + FOLLOWED
        + newer_release_rows()
        + COMPARED
        + difference_rows()
        + kept_head
        + kept_difference_rows()
    )


def main() -> None:
    """Write the page."""
    text = page()
    PAGE.write_text(text, encoding="utf-8")
    print(f"{PAGE}: {text.count('| yes |')} here, {text.count('| partly |')} partly", file=sys.stderr)


if __name__ == "__main__":
    main()
