"""Valid inputs, from which the mutated ones are derived."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def files(*patterns: str) -> Callable[[], Sequence[str]]:
    """The texts of files in the project."""

    def read() -> Sequence[str]:
        found = [path for pattern in patterns for path in sorted(ROOT.glob(pattern))]
        return [path.read_text(encoding="utf-8") for path in found]

    return cache(read)


def texts(*given: str) -> Callable[[], Sequence[str]]:
    """These texts."""
    return lambda: given


SAVED_LOG = (
    "[INFO] [1700000000.123456789] [node]: text\nmore of it\n[ERROR] [1700000001.0] [other]: text\n",
    "1700000000.123456789 [WARNING] [node] text\n",
)
METADATA = """rosbag2_bagfile_information:
  version: 5
  storage_identifier: mcap
  relative_file_paths: [a.mcap]
  topics_with_message_count:
    - topic_metadata: {name: /a, type: std_msgs/msg/String, offered_qos_profiles: "- history: 3"}
      message_count: 3
"""
TRACEBACK = """Traceback (most recent call last):
  File "/a/b.py", line 3, in on_timer
    x = 1 / 0
        ~~^~~
ZeroDivisionError: division by zero

During handling of the above exception, another exception occurred:

Traceback (most recent call last):
  File "<string>", line 1, in <module>
KeyError: 'a'
"""
VERBS = (
    "topic pub -r 5 /a std_msgs/msg/String {data:x}",
    "topic echo --field a.b /a",
    "param set /n p 1",
    "service call /a std_srvs/srv/Trigger",
    "node list -c",
    "interface show std_msgs/msg/String",
    "action send_goal /a b/action/C {} -f",
    "topic hz -w 5 /a --filter x",
    "pkg create --node-name n p",
    "lifecycle set /n configure",
    "launch p f.launch.py a:=1",
    "topic pub --qos-depth 3 /a b c --once",
)
EXPRESSIONS = (
    "0.5*2 - sqrt(x)/4",
    "/a/x - /b/x.y[0] ** 2",
    "deg(/odom/pose.pose.orientation.yaw())",
    "mean(/scan/ranges[0:10].min(), 500 ms) % 3",
    "hypot(/a/x, derivative(/a/y)) // -/n:p.q",
    "min(/scan/ranges) + max(/a, /b, pi)",
    "0x1f + 1_000e-3 * wrap(atan2(/a, /b))",
)
CONDITIONS = (
    "/battery/percentage < 0.2 and /odom/twist.twist.linear.x > 1 or /n:a.b == true",
    "0.1 < min(/scan/ranges[80:100]) <= hypot(/a/x, 2) ** 0.5",
    "(/a/x)/2 != -/b/y // 3 or abs(/a/and/b) >= 0x1f",
)
LINES = (
    "ros2 topic echo /odom --once",
    "rqt_plot /odom/twist/x:y /a/b",
    "rqt_reconfigure /node",
    "ros2 run rqt_plot rqt_plot /a/b",
    "rqt -s rqt_graph.ros_graph.RosGraph --perspective-file x",
    "ros2 topic pub /a std_msgs/msg/String \"{data: 'x'}\"",
)


LAUNCH_XML = """<?xml version="1.0"?>
<launch>
  <arg name="a" default="1" description="x"/>
  <let name="b" value="$(var a)"/>
  <group if="$(eval '$(var a) == 1')">
    <push-ros-namespace namespace="n"/>
    <node pkg="demo_nodes_py" exec="talker" name="t" output="screen" respawn="true">
      <param name="p" value="1.5"/>
      <param name="q"><param name="r" value="[1, 2]"/></param>
      <remap from="a" to="b"/>
      <env name="E" value="v"/>
    </node>
  </group>
  <executable cmd="ls -l"/>
  <set_env name="X" value="y"/>
  <include file="$(find-pkg-share x)/y.launch.xml"><arg name="z" value="1"/></include>
</launch>
"""
LAUNCH_YAML = """launch:
- arg: {name: a, default: "1", description: x}
- let: {name: b, value: $(var a)}
- group:
  - push_ros_namespace: {namespace: n}
  - node:
      pkg: demo_nodes_py
      exec: talker
      name: t
      param:
      - {name: p, value: 1.5}
      - from: file.yaml
      remap: [{from: a, to: b}]
- executable: {cmd: ls -l, output: screen}
- include:
    file: $(find-pkg-share x)/y.launch.yaml
    arg: [{name: z, value: "1"}]
"""
PACKAGE = """<?xml version="1.0"?>
<package format="3">
  <name>mine</name><version>0.1.0</version><description>x</description>
  <maintainer email="a@b.c">A</maintainer><license>MIT</license>
  <depend>rclpy</depend><buildtool_depend>ament_cmake</buildtool_depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""
PERSPECTIVE = """{"keys": {}, "groups": {"pluginmanager": {"keys": {"running-plugins": {"type": "repr",
"repr": "{'rqt_graph/RosGraph': [1], 'rqt_plot/Plot': [1, 2]}"}}, "groups": {}}}}
"""
STATES = (
    '{"mode": "FLOW", "folds": ["/a"], "rates": true, "debug": true}',
    '{"filter": "speed !node:/arm", "changed": true, "closed": ["/a"], "at": ["/n", "a.b", "c"]}',
    "- name: fast\n  condition: /odom/twist.twist.linear.x > 1\n  bell: true\n",
)
STORED_LINES = (
    "hide speed !node:/arm\noff red re:a.b\n# words\n",
    "ros2 topic list\nplot /odom/x\n",
    '{"words": ["topic", "list"], "code": 0, "pid": 12, "at": 1.5, "errors": ""}\n',
    '{"trial": "a 1", "report": {"time": 1.5}}\n{"trial": "a 2", "report": {}}\n',
)
PROGRESS = '{"version": 1, "at": "1.2", "held": {"1.1": ["a b", "c"]}, "names": {"node": "talker"}}'
CURVES = """{"curves": [{"curve": "/a/b", "right": true, "thresholds": "1 2"}], "window": 30.0, "limits": "0 1",
"against": ""}"""
BACKGROUND = '{"pid": 4194304, "words": ["indoor", "--seed", "1"], "log": "/tmp/a.log", "way_in": 0}'
WORDS = tuple(
    each.replace(" ", "\x1f")
    for each in (
        "stop \xfftoo-close",
        "release --all",
        "status",
        "bag info caf\xe9",
        "param set /n p:=\xff",
        "lint a.py",
        "interface show std_msgs/msg/String",
        "run caf\xe9/node.py --ros-args -p a:=1",
        "launch \xc3.launch.py x:=1",
    )
)
VARIABLES = tuple(
    each.replace(" ", "\x1f")
    for each in (
        "LOGNAME=\xff USER=\xe9 stop",
        "ROS_DOMAIN_ID=7 ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST ROS_STATIC_PEERS=127.0.0.1;a status",
        "BOT_CONSOLE_CONNECT=tcp/127.0.0.1:1 BOT_CONSOLE_DISTRO=jazzy status",
        "ZENOH_SESSION_CONFIG_URI=/a.json5 ZENOH_CONFIG_OVERRIDE=a/b=1;c=[2] BOT_CONSOLE_CONNECT=tcp/127.0.0.1:1 stop",
        "BOT_CONSOLE_STOP_FILE=/\xff RCUTILS_CONSOLE_OUTPUT_FORMAT={name}:{message} RCUTILS_COLORIZED_OUTPUT=1 node",
        "XDG_STATE_HOME=/\xff HOME=/\xe9 BOT_CONSOLE_USER_DIR=/dev/null/a ROS_HOME=a COLUMNS=80 LINES=x param",
        "AMENT_PREFIX_PATH=/a:b PYTHONPATH=\xff PATH=/x:\xff TERM=\xff LC_ALL=C NO_COLOR=1 interface",
        "RMW_IMPLEMENTATION=rmw_zenoh_cpp ROS_DISTRO=jazzy ROS_LOG_DIR=/dev/null/x TMPDIR=/y run",
    )
)

SCRIPTS = (
    "# a comment\nstart indoor\nwait 2 s\nexpect /odom/twist.twist.linear.x > 0.1 within 5 s\nset /n:max_speed 0.5\n",
    "rate /scan >= 9.5 for 3 s\nlog warn 'too close' within 500 ms\ncall /reset std_srvs/srv/Trigger\nstop\nrelease\n",
)
EXPECTED = (
    "nodes: [/a, b]\ntopics:\n  /scan: {type: sensor_msgs/msg/LaserScan, publishers: 1, rate: 10, tolerance: 0.2}\n"
    "services: {/reset: std_srvs/srv/Trigger}\nactions: {}\nexact: true\n",
    "greenwave_monitor:\n  ros__parameters:\n    topics:\n      /scan:\n        expected_frequency: 10.0\n"
    "        tolerance: 5.0\n",
)
JSONC = ('{\n  // words\n  "a": [1, "x",],\n  "paths": ["/old/x", "/z"], /* more */\n}\n', '{"paths": []}', "{}")
SETUP_PY = """from glob import glob
from setuptools import find_packages, setup
package_name = 'mine'
setup(name=package_name, version='0.1.0', packages=find_packages(exclude=['test']),
      data_files=[('share/' + package_name, ['package.xml']), (f'share/{package_name}/launch', glob('launch/*.py'))],
      entry_points={'console_scripts': ['talker = mine.talker:main']})
"""
CMAKE = """cmake_minimum_required(VERSION 3.8)
project(mine)
set(SCRIPTS a.py b.py)
install(PROGRAMS ${SCRIPTS} DESTINATION lib/${PROJECT_NAME} RENAME c)
install(DIRECTORY launch config DESTINATION share/${PROJECT_NAME} PATTERN "*.py" EXCLUDE) # words
ament_python_install_package(${PROJECT_NAME})
"""
CONVERT = (
    "output_bags:\n- uri: a\n  storage_id: sqlite3\n  topics: [/chatter]\n  max_bagfile_size: 100\n",
    "output_bags:\n- {uri: b, all: true, regex: '^/c', exclude: x, compression_mode: file, custom_data: {a: b}}\n",
)
QOS_OVERRIDES = (
    "/chatter:\n  reliability: best_effort\n  history: keep_last\n  depth: 5\n  deadline: {sec: 1, nsec: 0}\n",
    "/a: {durability: transient_local, liveliness: automatic, lease_duration: {sec: 0, nsec: 5}}\n",
)
TUNING = ("0.5..2", "0.1:1.0", "distance - 3 * collisions", "mean(/odom/twist.twist.linear.x) + 0.5*time")
