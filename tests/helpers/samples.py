"""Sample systems for tests of drawing: an empty one, a driving robot, one with faults, and a hostile one."""

from __future__ import annotations

import math
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from bot_console.tui.console.model import (
    Capabilities,
    Change,
    ChangeSource,
    ConsoleSnapshot,
    Endpoint,
    GraphInfo,
    JournalState,
    Kind,
    LaunchArgument,
    LaunchEvent,
    LaunchInfo,
    NodeInfo,
    ParameterInfo,
    ParameterTree,
    ProcessInfo,
    ProcessState,
    Profile,
    ProfileDifference,
    Range,
    Severity,
    Value,
)
from bot_console.tui.console.robot.robot_model import DriveInfo, GridMap, Pose, WorldInfo
from bot_console.tui.console.sensors.camera_image import IMAGE, Picture
from bot_console.tui.console.sensors.diagnostic_status import Diagnostics, Level
from bot_console.tui.console.topics.port import Measure
from fakes.console import START, FakeConsole
from fakes.launcher import FakeLauncher
from fakes.sensors import status

ODOM_TOPIC = "/odom"
SPEED, LIMIT, NEAREST = "/odom/twist.twist.linear.x", "/robot_navigator:max_speed", "/telemetry/nearest_obstacle/data"
BELL = "\x1b[2J\x07evil[red]\u202etxt"
"""A text that clears the screen, rings, colours and reverses text unless it is sanitized."""


def parameter(name: str, value: Value, kind: Kind, description: str = "", limits: Range | None = None) -> ParameterInfo:
    """A parameter of the navigator."""
    return ParameterInfo("/robot_navigator", name, kind, value, description, range=limits, default=value)


def navigator() -> ParameterTree:
    """The navigator's parameters; one differs from its default, one cannot be set."""
    found = [
        parameter("max_speed", 1.0, Kind.DOUBLE, "Maximum linear velocity (m/s)", Range(0.1, 5.0)),
        parameter("safety_distance", 0.5, Kind.DOUBLE, "Minimum obstacle clearance (m)", Range(0.1, 2.0)),
        parameter("detection_threshold", 100, Kind.INTEGER, "Sensor detection sensitivity", Range(0, 255)),
        parameter("turn_rate", 1.0, Kind.DOUBLE, "Maximum angular velocity (rad/s)", Range(0.1, 3.0)),
        parameter("enable_safety", True, Kind.BOOL, "Enable/disable safety features"),
        parameter("robot_name", "IntelligentRobot", Kind.STRING, "Robot identifier"),
        parameter("use_sim_time", False, Kind.BOOL),
    ]
    found[1] = replace(found[1], value=0.8)
    return ParameterTree("/robot_navigator", tuple(found))


def simulator() -> ParameterTree:
    """The simulator's parameters."""
    found = (
        parameter("lidar.beams", 360, Kind.INTEGER, "Beams of one scan", Range(1, 3600)),
        parameter("lidar.noise", 0.01, Kind.DOUBLE, "Standard deviation of a range (m)", Range(0.0, 1.0)),
        replace(parameter("seed", 1, Kind.INTEGER, "Seed of everything random, used at reset"), read_only=True),
    )
    return ParameterTree("/simulator", tuple(replace(each, node="/simulator") for each in found))


SCAN, ODOM, TWIST, FLOAT = (
    "sensor_msgs/msg/LaserScan",
    "nav_msgs/msg/Odometry",
    "geometry_msgs/msg/Twist",
    "std_msgs/msg/Float64",
)
LINKS: tuple[tuple[str, str, str, tuple[str, ...]], ...] = (
    ("/simulator", "/scan_raw", SCAN, ("/sensor_handler",)),
    ("/sensor_handler", "/scan", SCAN, ("/robot_navigator", "/safety_monitor", "/telemetry_publisher")),
    ("/simulator", "/odom", ODOM, ("/robot_navigator", "/motion_controller", "/telemetry_publisher")),
    ("/robot_navigator", "/cmd_vel_desired", TWIST, ("/motion_controller",)),
    ("/motion_controller", "/cmd_vel_nav", TWIST, ("/safety_monitor",)),
    ("", "/cmd_vel_teleop", TWIST, ("/safety_monitor",)),
    ("/safety_monitor", "/cmd_vel", TWIST, ("/simulator",)),
    ("/telemetry_publisher", "/telemetry/speed", FLOAT, ()),
    ("/telemetry_publisher", "/telemetry/nearest_obstacle", FLOAT, ()),
)
TOOLS = (
    Endpoint("/parameter_events", ("rcl_interfaces/msg/ParameterEvent",)),
    Endpoint("/rosout", ("rcl_interfaces/msg/Log",)),
)
NODES = (
    "/motion_controller",
    "/robot_navigator",
    "/safety_monitor",
    "/sensor_handler",
    "/simulator",
    "/telemetry_publisher",
)


def graph() -> GraphInfo:
    """The robot system as nodes and topics."""
    nodes = tuple(_node(name) for name in NODES)
    topics = tuple(Endpoint(topic, (kind,)) for _, topic, kind, _ in LINKS) + TOOLS
    return GraphInfo(nodes, tuple(sorted(topics, key=lambda each: each.name)))


def _node(name: str) -> NodeInfo:
    qos = "reliable volatile 10"
    publishers = tuple(Endpoint(topic, (kind,), qos) for source, topic, kind, _ in LINKS if source == name)
    subscriptions = tuple(Endpoint(topic, (kind,), qos) for _, topic, kind, ends in LINKS if name in ends)
    services = (Endpoint(f"{name}/set_parameters", ("rcl_interfaces/srv/SetParameters",)),)
    return NodeInfo(name, publishers + TOOLS, subscriptions, services)


def figures() -> dict[str, Measure]:
    """Measurements of the robot's topics; one is silent."""
    found = {
        topic: Measure(rate, rate * size, 1 / rate / 2, 0.0021 if kind in (SCAN, ODOM) else None, 1200)
        for (_, topic, kind, _), rate, size in zip(
            LINKS, (10, 10, 50, 10, 10, 1, 10, 2, 2), (2940, 2940, 736, 52, 52, 52, 52, 12, 12), strict=True
        )
    }
    found["/cmd_vel_teleop"] = Measure(0.0, 0.0, 93.0, None, 4)
    return found


VALUES = {
    SCAN: "ranges 0.55 .. 9.87 m",
    ODOM: "x 2.50 m  y -1.20 m  0.60 m/s  0.20 rad/s",
    TWIST: "0.60 m/s  0.20 rad/s",
    FLOAT: "0.60",
}
"""What the newest message of a type says."""


def odometry() -> Any:
    """A message with a header, a quaternion, units and a long array."""
    from nav_msgs.msg import Odometry

    message = Odometry(child_frame_id="base_link")
    message.header.stamp.sec, message.header.frame_id = 1_700_000_000, "odom"
    message.pose.pose.position.x = 2.5
    message.pose.pose.orientation.z = message.pose.pose.orientation.w = 0.5**0.5
    message.twist.twist.linear.x = 0.58
    return message


def world() -> WorldInfo:
    """A room of 10 by 6 m with a robot in it."""
    width, height = 100, 60
    rows = [bytes([100] * width)]
    rows += [bytes([100] + [0] * (width - 2) + [100])] * (height - 2)
    rows.append(rows[0])
    grid = GridMap(width, height, 0.1, Pose(), b"".join(rows))
    hits = tuple((9.8, 1.0 + 0.1 * step) for step in range(40))
    trail = tuple((2.0 + 0.1 * step, 3.0) for step in range(30))
    return WorldInfo(grid, Pose(5.0, 3.0, 0.0), trail, hits, None, 0.98, 0.0, 4.8)


def driving() -> DriveInfo:
    """A robot that is slowed down near an obstacle."""
    return DriveInfo("/cmd_vel_teleop", asked=(1.0, 0.2), limited=(0.6, 0.2), final=(0.6, 0.2), actual=(0.58, 0.19),
                     limited_by="warning_distance of /safety_monitor")  # fmt: skip


def launched() -> LaunchInfo:
    """One launch file with a group in it; one process has crashed."""
    top = ("robot_system.launch.py",)
    names = ("sensor_handler", "safety_monitor", "motion_controller", "telemetry_publisher", "robot_navigator")
    processes = [ProcessInfo(f"{each}@{at}", f"{each}-{at + 1}", ProcessState.RUNNING, 4100 + at, (f"/{each}",), top)
                 for at, each in enumerate(names)]  # fmt: skip
    processes[3] = replace(processes[3], state=ProcessState.CRASHED, pid=None, exit_code=1, restarts=2,
                           problem="ended with exit code 1; its last lines are in the log")  # fmt: skip
    inside = (*top, "simulation")
    processes.insert(
        0, ProcessInfo("simulator@9", "simulator-6", ProcessState.RUNNING, 4109, ("/simulator",), inside, cpu=0.12)
    )
    texts = ("launch robot_system.launch.py", "simulator-6 started, pid 4109", "robot_navigator-5 started, pid 4104",
             "telemetry_publisher-4 ended, exit code 1")  # fmt: skip
    events = tuple(LaunchEvent(at, START + at * 10**9, text, Severity.ERROR if "ended" in text else Severity.INFO)
                   for at, text in enumerate(texts))  # fmt: skip
    return LaunchInfo(("robot_system.launch.py",), tuple(processes), events)


def diagnosed() -> Diagnostics:
    """Parts of a robot: one warm, one broken, one silent."""
    return Diagnostics(
        (
            status("safety_monitor: velocity", Level.OK, "free", source="cmd_vel_nav", nearest="1.2"),
            status("motors/left/driver", Level.WARN, "warm", temperature="71 C"),
            status("motors/right/driver", Level.OK, "fine", temperature="40 C"),
            status("motors/right/encoder", Level.ERROR, "no pulses"),
            status("camera", Level.OK, "30 Hz", last_received=90.0),
        ),
        ("/diagnostics",),
    )


def profiles() -> tuple[Profile, ...]:
    """Three profiles, one of which cannot be used."""
    values = MappingProxyType({("/robot_navigator", "max_speed"): 2.0})
    return (
        Profile("indoor", "/opt/profiles/indoor.yaml", "Indoor: low speed, high safety.", values, "indoor"),
        Profile(
            "competition", "/opt/profiles/competition.yaml", "Competition: fast, little margin.", values, "competition"
        ),
        Profile(
            "broken",
            "/opt/profiles/broken.yaml",
            problem="'ros_parameters' should be 'ros__parameters', with two underscores",
        ),
    )


def differences() -> tuple[ProfileDifference, ...]:
    """What the competition profile changes; one value would be refused."""
    return (
        ProfileDifference("/robot_navigator", "max_speed", 1.0, 3.0, unsafe="raises a safety limit"),
        ProfileDifference("/robot_navigator", "enable_safety", True, False, unsafe="turns a protection off"),
        ProfileDifference("/robot_navigator", "turn_rate", 1.0, 9.0, "Parameter turn_rate must be within 0.1 and 3.0"),
        ProfileDifference("/simulator", "world", "indoor", "competition", needs_reset=True),
    )


def arguments() -> tuple[LaunchArgument, ...]:
    """Arguments of a launch file: with choices, with a default, and required."""
    return (
        LaunchArgument("profile", "Environment: settings and world", "indoor", ("indoor", "outdoor", "warehouse")),
        LaunchArgument("seed", "Seed of the simulator", "1"),
        LaunchArgument("robot", "Name of the robot"),
    )


def _wave(rate: float, seconds: float) -> tuple[list[float], list[float]]:
    times = [60.0 - seconds + at / rate for at in range(int(seconds * rate))]
    return times, [0.6 + 0.35 * math.sin(each / 2.2) + 0.05 * math.sin(each * 5) for each in times]


def live(parts: tuple[str, ...] = ()) -> tuple[FakeConsole, FakeLauncher]:
    """A driving robot, with everything there is to show."""
    trees = {each.node: each for each in (navigator(), simulator())}
    console = FakeConsole(
        ConsoleSnapshot(
            parameters=MappingProxyType(trees), world=world(), drive=driving(), graph=graph(), launch=launched(),
            profiles=profiles(), active_profile="indoor", journal=JournalState(0, 2),
        )
    )  # fmt: skip
    console.series[SPEED] = _wave(20, 45)
    console.series[LIMIT] = ([16.0, 48.0], [0.7, 1.0])
    times, values = _wave(5, 45)
    console.series[NEAREST] = (times, [3 * each for each in values])
    console.journal = [
        Change(
            -1, START - 90_000 * 10**9, "/robot_navigator", "turn_rate", 1.0, 1.5, ChangeSource.PROFILE, by="outdoor",
            run=START - 90_060 * 10**9,
        ),
        Change(0, START - 12 * 10**9, "/robot_navigator", "max_speed", 0.7, 1.0, ChangeSource.EDIT),
        Change(1, START - 5 * 10**9, "/robot_navigator", "max_speed", 1.0, 10.0, ChangeSource.EDIT, False, "too fast"),
    ]  # fmt: skip
    console.topics.figures.update(figures())
    console.topics.values.update({topic: VALUES[kind] for source, topic, kind, _ in LINKS if source})
    console.sensors.info = diagnosed()
    console.topics.messages[ODOM_TOPIC] = (odometry(), ODOM)
    console.differences["competition"] = differences()
    console.differences["indoor"] = ()
    lines = (
        (Severity.INFO, "robot_navigator", "IntelligentRobot initialized!"),
        (Severity.INFO, "robot_navigator", "Max Speed: 1.0 m/s"),
        (Severity.WARN, "robot_navigator", "Obstacle at 0.42m - Turning!"),
        (Severity.ERROR, "safety_monitor", "Speed must be 0.1-5.0, got 10.0"),
        (Severity.DEBUG, "simulator", "step 1200"),
    )
    for number, (severity, node, text) in enumerate(lines):
        console.show_text(severity, node, text, START + number * 250_000_000)
    files = (
        "/opt/launch/robot_system.launch.py",
        "/opt/launch/single_robot.launch.py",
        "/opt/launch/multi_node_system.launch.py",
    )
    launcher = console.launcher = FakeLauncher(arguments(), files)
    return console, launcher


def with_camera(*names: str) -> tuple[FakeConsole, FakeLauncher]:
    """The live system with cameras; the first one's image is a gradient."""
    console, launcher = live()
    topics = tuple(Endpoint(f"/{each}/image", (IMAGE,)) for each in names)
    console.change(graph=replace(console.current.graph, topics=(*console.current.graph.topics, *topics)))
    pixels = bytes(value for y in range(24) for x in range(32) for value in (x * 8, y * 10, 120))
    console.sensors.shown = Picture(topics[0].name, 1, 640, 480, "rgb8", 32, 24, pixels)
    return console, launcher


def with_array(kind: Kind, value: Value) -> tuple[FakeConsole, FakeLauncher]:
    """The live system with an array `a_list` among the parameters of the navigator."""
    console, launcher = live()
    trees = dict(console.current.parameters)
    tree = trees["/robot_navigator"]
    extra = ParameterInfo("/robot_navigator", "a_list", kind, value, default=value)
    trees["/robot_navigator"] = replace(tree, parameters=(extra, *tree.parameters))
    console.change(parameters=MappingProxyType(trees))
    return console, launcher


def empty() -> tuple[FakeConsole, FakeLauncher]:
    """A system with nothing in it."""
    return FakeConsole(), FakeLauncher()


def faulty() -> tuple[FakeConsole, FakeLauncher]:
    """The console's connection has ended: its data stays, a launch file could not be run, and one node is silent."""
    console, launcher = live()
    trees = dict(console.current.parameters)
    trees["/silent"] = ParameterTree("/silent", (), "does not answer on its parameter services")
    launch = replace(console.current.launch, problem="/opt/launch/broken.launch.py, line 12: invalid syntax")
    console.change(
        problem="the console's link to ROS has ended: Context is not valid (executors.py:120)",
        parameters=MappingProxyType(trees),
        launch=launch,
        drive=replace(
            driving(),
            stopped=True,
            stop_confirmed=True,
            stop_holder="this console",
            lockable=True,
            stopped_here=True,
            own_stops=frozenset(["ours"]),
        ),
        capabilities=Capabilities(world="this system has no world"),
        world=WorldInfo(),
    )
    console.series[SPEED] = (console.series[SPEED][0], [math.nan] * len(console.series[SPEED][0]))
    return console, launcher


def hostile(text: str = BELL) -> tuple[FakeConsole, FakeLauncher]:
    """Every external text contains control characters, markup and marks that reverse text."""
    console, _ = live()
    evil = ParameterTree(
        f"/{text}", (ParameterInfo(f"/{text}", text, Kind.STRING, text, text, constraints=text),), text
    )
    node = NodeInfo(f"/{text}", (Endpoint(f"/out{text}", (text,), text),), (Endpoint(f"/in{text}", (text,)),))
    process = ProcessInfo("k", text, ProcessState.CRASHED, None, (text,), (text,), problem=text)
    console.show_text(Severity.FATAL, text, text)
    console.change(
        parameters=MappingProxyType({**console.current.parameters, evil.node: evil}),
        graph=GraphInfo((*console.current.graph.nodes, node), console.current.graph.topics),
        launch=LaunchInfo((text,), (process,), (LaunchEvent(0, START, text),)),
        profiles=(Profile(text, text, text, world=text),),
        active_profile=text,
        drive=replace(driving(), topic=text, limited_by=text),
    )
    console.differences[text] = (ProfileDifference(text, text, text, text, text),)
    console.sensors.info = Diagnostics((status(f"a/{text}", Level.ERROR, text, key=text),), (text,))
    console.series[f"/{text}"] = ([1.0, 2.0], [1.0, 2.0])
    return console, FakeLauncher((LaunchArgument(text, text, text, (text,)),), (text,))
