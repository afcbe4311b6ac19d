"""A sample fleet for tests of drawing: 60 nodes in six namespaces, four of which are identical robots."""

from __future__ import annotations

import math
from types import MappingProxyType

import samples
from bot_console.tui.console.model import (
    Change,
    ChangeSource,
    ConsoleSnapshot,
    Endpoint,
    GraphInfo,
    JournalState,
    Kind,
    LaunchEvent,
    LaunchInfo,
    NodeInfo,
    ParameterInfo,
    ParameterTree,
    ProcessInfo,
    ProcessState,
    Range,
    Severity,
)
from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.console.sensors.camera_image import IMAGE, Picture
from bot_console.tui.console.sensors.diagnostic_status import Diagnostics, Level
from bot_console.tui.console.topics.port import Measure
from fakes.console import START, FakeConsole
from fakes.launcher import FakeLauncher
from fakes.sensors import status
from samples import FLOAT, ODOM, SCAN, TOOLS, TWIST

ROBOTS = ("robot1", "robot2", "robot3", "robot4")
POSE, TEXT, BATTERY, CLOUD = (
    "geometry_msgs/msg/PoseStamped",
    "std_msgs/msg/String",
    "sensor_msgs/msg/BatteryState",
    "sensor_msgs/msg/PointCloud2",
)
PATH, MAP, IMU, CLOCK = (
    "nav_msgs/msg/Path",
    "nav_msgs/msg/OccupancyGrid",
    "sensor_msgs/msg/Imu",
    "rosgraph_msgs/msg/Clock",
)
VALUES = {
    **samples.VALUES,
    BATTERY: "percentage 0.98  voltage 12.59 V",
    CLOCK: "812.4 s",
    CLOUD: "640 x 480",
    IMAGE: "640 x 480 pixels  encoding rgb8",
    IMU: "z 0.20 rad/s  x 0.10 m/s²  z 9.81 m/s²",
    MAP: "400 x 300 cells  resolution 0.05 m/cell",
    PATH: "poses 42",
    POSE: "x 2.50 m  y -1.20 m",
    TEXT: "ready",
}
"""A summary of the newest message of each type."""
IN_ROBOT: tuple[tuple[str, str, str, tuple[str, ...], float], ...] = (
    ("lidar", "scan", SCAN, ("localization", "collision_monitor", "costmap"), 10),
    ("camera", "image", IMAGE, (), 15),
    ("depth", "points", CLOUD, ("costmap",), 8),
    ("imu", "imu", IMU, ("localization",), 100),
    ("base", "odom", ODOM, ("localization", "controller"), 50),
    ("localization", "pose", POSE, ("planner", "/fleet/traffic", "/tools/dashboard"), 10),
    ("costmap", "local_costmap", MAP, ("controller",), 2),
    ("planner", "plan", PATH, ("controller",), 1),
    ("controller", "cmd_vel_nav", TWIST, ("smoother",), 20),
    ("smoother", "cmd_vel_smoothed", TWIST, ("collision_monitor",), 20),
    ("collision_monitor", "cmd_vel", TWIST, ("base",), 20),
    ("battery", "battery_state", BATTERY, ("status", "/fleet/monitor"), 1),
    ("status", "status", TEXT, ("/fleet/monitor", "/fleet/dispatcher"), 1),
)
"""The topics of a robot: publisher, name, type, subscribers, and rate in Hz."""
AROUND: tuple[tuple[str, str, str, tuple[str, ...], float], ...] = (
    *(("/fleet/dispatcher", f"/{each}/goal", POSE, (f"/{each}/planner",), 0.2) for each in ROBOTS),
    ("/fleet/traffic", "/fleet/speed_limit", FLOAT, tuple(f"/{each}/controller" for each in ROBOTS), 1),
    ("/fleet/map_server", "/map", MAP, tuple(f"/{each}/{node}" for each in ROBOTS for node in ("localization",
                                                                                              "planner")), 0),
    ("/fleet/monitor", "/fleet/summary", TEXT, ("/tools/dashboard", "/tools/alarm_relay"), 1),
    ("/tools/clock", "/clock", CLOCK, ("/fleet/dispatcher", "/fleet/traffic"), 100),
)  # fmt: skip
LINKS = (
    *((f"/{robot}/{source}", f"/{robot}/{topic}", kind,
       tuple(each if each.startswith("/") else f"/{robot}/{each}" for each in ends), rate)
      for robot in ROBOTS for source, topic, kind, ends, rate in IN_ROBOT),
    *AROUND,
)  # fmt: skip
PARTS = tuple(dict.fromkeys(source for source, *_ in IN_ROBOT))
NODES = (
    *(f"/{robot}/{part}" for robot in ROBOTS for part in PARTS),
    *(f"/fleet/{each}" for each in ("dispatcher", "map_server", "monitor", "traffic")),
    *(f"/tools/{each}" for each in ("alarm_relay", "clock", "dashboard", "recorder")),
)


def graph() -> GraphInfo:
    """The nodes and topics of the fleet."""
    topics = (*(Endpoint(topic, (kind,)) for _, topic, kind, *_ in LINKS), *TOOLS)
    return GraphInfo(tuple(_node(each) for each in sorted(NODES)), tuple(sorted(topics, key=lambda each: each.name)))


def _node(name: str) -> NodeInfo:
    qos = "reliable volatile 10"
    publishers = tuple(Endpoint(topic, (kind,), qos) for source, topic, kind, *_ in LINKS if source == name)
    subscriptions = tuple(Endpoint(topic, (kind,), qos) for _, topic, kind, ends, _ in LINKS if name in ends)
    return NodeInfo(
        name, publishers + TOOLS, subscriptions, (Endpoint(f"{name}/get_state", ("lifecycle_msgs/srv/GetState",)),)
    )


def parameters(node: str) -> ParameterTree:
    """Four parameters of a node; the velocity of one robot differs from its default."""
    speed = 0.8 if node == "/robot3/controller" else 1.2
    return ParameterTree(
        node,
        (
            ParameterInfo(node, "enabled", Kind.BOOL, True, "Whether the node works at all", default=True),
            ParameterInfo(node, "max_speed", Kind.DOUBLE, speed, "Maximum velocity (m/s)", range=Range(0.0, 2.0),
                          default=1.2),
            ParameterInfo(node, "rate", Kind.DOUBLE, 10.0, "Cycles per second", range=Range(0.1, 100.0), default=10.0),
            ParameterInfo(node, "use_sim_time", Kind.BOOL, True, default=True),
        ),
    )  # fmt: skip


def launched() -> LaunchInfo:
    """A container for the drivers and one for the navigation of each robot, and a process for each other node."""
    top = "fleet.launch.py"
    drivers = ("lidar", "camera", "depth", "imu", "base", "battery")
    processes: list[ProcessInfo] = []
    for at, robot in enumerate(ROBOTS):
        nodes = [each for each in NODES if each.startswith(f"/{robot}/")]
        halves = {"drivers": [each for each in nodes if each.rpartition("/")[2] in drivers]}
        halves["navigation"] = [each for each in nodes if each not in halves["drivers"]]
        for name, group in halves.items():
            number = len(processes) + 1
            processes.append(ProcessInfo(f"{robot}_{name}@{number}", f"component_container-{number}",
                                         ProcessState.RUNNING, 5100 + number, tuple(group), (top, robot),
                                         cpu=0.05 * (at + 1), memory=60 + number))  # fmt: skip
    for name in (each for each in NODES if not each.startswith("/robot")):
        number, group = len(processes) + 1, name.split("/")[1]
        processes.append(ProcessInfo(f"{name}@{number}", f"{name.rpartition('/')[2]}-{number}", ProcessState.RUNNING,
                                     5100 + number, (name,), (top, group), cpu=0.01, memory=31))  # fmt: skip
    events = (LaunchEvent(0, START, f"launch {top}"),)
    return LaunchInfo((top,), tuple(processes), events)


def diagnosed() -> Diagnostics:
    """Three parts of each robot; one motor is warm."""
    parts = (("base/motors", "71 C"), ("battery", "12.4 V"), ("lidar", "10 Hz"))
    found = [
        status(f"{robot}/{part}", Level.WARN if (robot, part) == ("robot2", "base/motors") else Level.OK, value)
        for robot in ROBOTS
        for part, value in parts
    ]
    return Diagnostics(tuple(found), ("/diagnostics",))


def fleet() -> tuple[FakeConsole, FakeLauncher]:
    """The fleet at work on the map of a map server; the first robot is driven."""
    drive = DriveInfo("/robot1/cmd_vel", robot="/robot1", robots=tuple(f"/{each}" for each in ROBOTS),
                      others=frozenset(f"/{each}/" for each in ROBOTS[1:]), actual=(0.4, 0.0))  # fmt: skip
    console = FakeConsole(
        ConsoleSnapshot(
            parameters=MappingProxyType({each: parameters(each) for each in sorted(NODES)}),
            graph=graph(), drive=drive, launch=launched(), journal=JournalState(0, 1), world=samples.world(),
        )
    )  # fmt: skip
    for _, topic, kind, _, rate in LINKS:
        console.topics.values[topic] = VALUES[kind]
        console.topics.figures[topic] = Measure(rate, rate * 400, 0.5 / rate if rate else None, None, 1200)
    times = [at / 10 for at in range(150, 600)]
    for at, robot in enumerate(ROBOTS):
        console.series[f"/{robot}/odom/twist.twist.linear.x"] = times, [0.5 + 0.3 * math.sin(each / 3 + at)
                                                                       for each in times]  # fmt: skip
    console.journal = [
        Change(0, START - 12 * 10**9, "/robot3/controller", "max_speed", 1.2, 0.8, ChangeSource.EDIT),
    ]
    console.sensors.info = diagnosed()
    pixels = bytes(value for y in range(24) for x in range(32) for value in (x * 8, y * 10, 120))
    console.sensors.shown = Picture("/robot1/image", 1, 640, 480, "rgb8", 32, 24, pixels)
    for number in range(40):
        robot = ROBOTS[number % 4]
        line = (Severity.INFO, f"{robot}.planner", f"Goal {number // 4 + 1} reached, 3.{number % 10} m in 9.1 s")
        if number % 13 == 12:
            line = (Severity.WARN, f"{robot}.collision_monitor", "Slowing down: obstacle at 0.42 m")
        console.show_text(*line, START + number * 250_000_000)
    launcher = console.launcher = FakeLauncher((), ("/opt/launch/fleet.launch.py",))
    return console, launcher
