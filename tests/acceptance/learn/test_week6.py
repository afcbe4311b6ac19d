"""The course week6, completed as by a student: files, three shells, and the console in a fourth terminal.

Before each step its action is left out, and most steps get a typical mistake first; the lesson's text has to answer
both. After each action exactly the steps whose actions were carried out are done.
"""

from __future__ import annotations

import itertools
import os
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from bot_console.tui.learn.course import COURSES
from bot_console.tui.learn.sandbox import can_isolate
from helpers import student_bonus, student_robot
from helpers.processes.ports import free_port
from helpers.student import Shell, Student, until

WEEK6 = COURSES / "week6"
NODE = "src/simple_robot.py"


def chapter_1(at: Student) -> None:
    one, two, _ = at.shells
    id = "a-node-with-a-parameter"
    at.reads("there is no file *.py", "waiting for: a node with a parameter speed")
    at.write(NODE, at.listing(id).replace("speed", "sped"))
    one.start(at.listing(id, 1))
    at.reads("did you mean sped?")
    one.interrupt()
    at.write(NODE, at.listing(id))
    one.start(at.listing(id, 1))
    at.does(id)

    at.reads("waiting for: the command param get … speed")
    two.run("ros2 param get /simple_robto speed")
    at.reads("it ended with exit code 1")
    two.run(at.listing("ask-for-its-value"))
    at.does("ask-for-its-value")

    id = "a-node-that-is-gone"
    at.reads(
        "waiting for: the command param get /simple_robot speed, to see it fail; it did not fail: end the node first"
    )
    one.interrupt()
    assert "not found" in one.run(at.listing(id))
    at.does(id)

    id = "an-integer-is-not-a-double"
    at.reads("waiting for: the command run … speed:=2, to see it fail")
    one.start(at.listing(id).replace(":=2", ":=1.5"))
    one.shows("speed 1.5 m/s")
    at.reads("waiting for: the command run … speed:=2, to see it fail")
    one.interrupt()
    assert f"{NODE}:8: speed is a double, which takes no integer: write 2.0" in one.run(at.listing(id))
    at.does(id)

    # It is the last value that was seen, which the short life of the node before may have hidden.
    at.reads("waiting for: speed with the value 2.0; it is 1.", "2 is an integer: write 2.0")
    one.start(at.listing("start-it-with-another-value"))
    at.does("start-it-with-another-value")

    up, set_speed = at.lines("the-same-on-a-robot")
    at.reads("waiting for: node /robot_navigator with a parameter max_speed")
    two.run(up, set_speed.replace("0.6", "0.5"))
    at.reads("waiting for: max_speed to be set to 0.6", "waiting for: the robot to drive 0.5 m")
    two.run(set_speed)
    at.does("the-same-on-a-robot")


def restart(at: Student) -> None:
    """End the node in the first shell and start it again."""
    at.shells[0].interrupt()
    at.shells[0].start("bot-console run src/simple_robot.py")
    at.shells[0].shows("m/s")


def chapter_2(at: Student) -> None:
    two = at.shells[1]
    at.reads("speed has no description: give declare_parameter a", "then start the node again")
    fragment = at.listing("say-what-a-parameter-means")
    limit = "            floating_point_range=[FloatingPointRange(from_value=0.0, to_value=5.0)],\n"
    at.merge(NODE, fragment.replace(limit, ""), '        self.declare_parameter("speed", 1.0)\n')
    restart(at)
    at.reads("✓ speed has a description", "speed has no range: give its ParameterDescriptor")
    at.edit(NODE, '            description="Speed (m/s)",\n', f'            description="Speed (m/s)",\n{limit}')
    restart(at)
    at.does("say-what-a-parameter-means")

    id = "four-types"
    at.reads("waiting for: node /simple_robot with a parameter robot_name")
    first = at.listing(id).partition("\n")[0] + "\n"
    at.merge(NODE, first, '        self.declare_parameter("speed", 1.0, speed)\n', after=True)
    restart(at)
    at.reads(
        "✓ there is node /simple_robot with a parameter robot_name",
        "waiting for: node /simple_robot with a parameter sensor_range",
    )
    at.edit(NODE, first, at.listing(id) + "\n")
    restart(at)
    at.does(id)

    names, describe = at.lines("list-them")
    at.reads("waiting for: the command param list")
    two.run(names, describe.replace(" speed", " sped"))
    at.reads("✓ param list was run", "waiting for: the command param describe … speed")
    two.run(describe)
    at.does("list-them")

    up, describe = at.lines("the-robot-describes-its-own")
    assert "already running" in two.run(up)
    at.reads("waiting for: the command param describe … warning_distance")
    two.run(describe.replace("monitor", "moniter"))
    at.reads("waiting for: the command param describe … warning_distance; it ended with exit code 1")
    two.run(describe)
    at.does("the-robot-describes-its-own")


def chapter_3(at: Student) -> None:
    one, two, _ = at.shells
    id = "refuse-what-makes-no-sense"
    at.reads("simple_robot.py has no add_on_set_parameters_callback")
    fragment = at.listing(id).replace("        self.add_on", "\n        self.add_on", 1)
    anchor = "        self.create_timer(1.0, self.report)\n"
    wrong = fragment.replace("successful=False", "successful=True").replace("on_set_parameters_", "on_set_parameter_")
    at.merge(NODE, wrong, anchor, after=True)
    at.reads("simple_robot.py has no add_on_set_parameters_callback")
    at.edit(NODE, "on_set_parameter_", "on_set_parameters_")
    at.does(id)
    restart(at)

    refuse = at.listing("see-the-refusal-and-its-reason")
    at.reads("waiting for: a value of speed that is refused: set a value that your callback does not accept")
    two.run(refuse)
    at.reads("4.0 was accepted: a callback refuses it by SetParametersResult(successful=False, ...)")
    at.edit(NODE, "successful=True, reason", "successful=False, reason")
    restart(at)
    assert "faster than 3.0 m/s is not safe" in two.run(refuse)
    at.does("see-the-refusal-and-its-reason")

    id, last = "without-a-return", "        return SetParametersResult(successful=True)\n"
    at.reads("waiting for: a value of speed that is refused with the reason 'invalid type', not: faster than 3.0 m/s")
    two.run(at.listing(id).replace("2.2", "3.2"))
    at.reads("waiting for: a value of speed that is refused with the reason 'invalid type', not: faster than 3.0 m/s")
    at.edit(NODE, last, "")
    restart(at)
    two.run(at.listing(id))
    one.shows("It must return a SetParametersResult on every path")
    at.reads("✓ a value of speed was refused: invalid type", "waiting for: speed to be set to 2.2")
    at.merge(NODE, last, 'reason="faster than 3.0 m/s is not safe")\n', after=True)
    restart(at)
    two.run(at.listing(id))
    at.does(id)

    accepted = at.listing("set-one-that-is-fine")
    at.reads("waiting for: speed to be set to 2.5")
    two.run(accepted.replace("2.5", "3.5"))
    at.reads("waiting for: speed to be set to 2.5")
    two.run(accepted)
    at.does("set-one-that-is-fine")

    at.reads("waiting for: a value of max_speed that is refused")
    up, refuse = at.lines("the-robot-refuses-too")
    two.run(up, refuse.replace("99", "4"))
    at.reads("4.0 was accepted")
    two.run(refuse)
    at.does("the-robot-refuses-too")


def chapter_4(at: Student) -> None:
    one, two, _ = at.shells
    at.reads("waiting for: speed to be set to 1.5")
    two.run(at.listing("use-the-new-value-at-once").replace("1.5", "1.6"))
    at.reads("waiting for: speed to be set to 1.5; it was set to 1.6")
    two.run(at.listing("use-the-new-value-at-once"))
    one.shows("speed 1.5 m/s")
    at.does("use-the-new-value-at-once")

    dump = at.listing("write-all-values-into-a-file")
    at.reads("waiting for: the command param dump", "there is no file saved.yaml")
    two.run(dump.replace("saved", "save"))
    at.reads("✓ param dump was run", "there is no file saved.yaml")
    two.run(dump)
    at.does("write-all-values-into-a-file")

    at.reads("waiting for: warning_distance to be set to 1.5")
    up, set_distance = at.lines("watch-the-robot-change-its-mind")
    two.run(up, set_distance.replace("1.5", "0.9"))
    at.reads("waiting for: warning_distance to be set to 1.5; it was set to 0.9")
    two.run(set_distance)
    at.does("watch-the-robot-change-its-mind")


def chapter_5(at: Student) -> None:
    one, two, _ = at.shells
    path = "config/simple_robot.yaml"
    text = at.listing("values-in-a-file")
    at.reads("there is no file config/*.yaml")
    at.write(path, text.replace("ros__", "ros_"))
    at.reads(f"{path}:2: ros_parameters has one underscore")
    at.write(path, text.replace("simple_robot:", "simple_robto:"))
    at.does("values-in-a-file")

    at.reads("waiting for: the command run … --params-file …")
    one.interrupt()
    one.start(at.listing("start-with-the-file"))
    one.shows("m/s")
    at.reads("it is Rosie: the first line of the file has to be the name of the node")
    one.interrupt()
    at.write(path, text)
    one.start(at.listing("start-with-the-file"))
    at.does("start-with-the-file")

    id = "a-name-that-is-not-the-node-s"
    copy, run = at.lines(id)
    at.reads("waiting for: the command run … --params-file … other …", "there is no file other.yaml")
    one.interrupt()
    one.run(copy)
    one.start(run)
    one.shows("did you mean '/simple_robot'?")
    at.reads("✓ run … --params-file … other … was run", "other.yaml has no simple_robot: its first line")
    at.edit("other.yaml", "robot:", "simple_robto:")
    at.reads("other.yaml has no simple_robot: its first line")
    at.edit("other.yaml", "simple_robto:", "simple_robot:")
    at.does(id)

    change, run = at.lines("one-underscore")
    at.reads("waiting for: the command run … --params-file … wrong …, to see it fail")
    two.run(change.replace("s/ros__/", "s/Ros__/"))
    two.start(run)
    two.shows("m/s")
    two.interrupt()
    at.reads("waiting for: the command run … --params-file … wrong …, to see it fail; it did not fail")
    assert "wrong.yaml:2" in two.run(change, run)
    at.does("one-underscore")

    at.reads("waiting for: a profile warehouse to be applied: press 7, choose a profile, Enter")
    down, up = at.lines("a-profile-of-the-robot")
    two.run(down, up.replace("warehouse", "warehous"))
    at.reads("waiting for: a profile warehouse to be applied: press 7, choose a profile, Enter")
    two.run(up)
    at.does("a-profile-of-the-robot")


def chapter_6(at: Student) -> None:
    one, two, _ = at.shells
    one.interrupt()
    id = "one-node-started-by-a-file"
    down, launch = at.lines(id, 1)
    at.reads("waiting for: a launch of *.launch.py with simulator_node")
    at.write("launch/one.py", at.listing(id))
    two.run(down)
    two.start(launch.replace("one.launch.py", "one.py"))
    two.shows("process started")  # An interpreter that is just starting loses Ctrl-C.
    at.reads("✓ there is node /simulator", "waiting for: a launch of *.launch.py with simulator_node")
    two.interrupt()
    (at.workspace / "launch/one.py").rename(at.workspace / "launch/one.launch.py")
    two.start(launch)
    at.does(id)

    id = "a-package-that-is-not-there"
    at.reads("waiting for: the command launch *.launch.py, to see it fail")
    two.interrupt()
    at.edit("launch/one.launch.py", "bot_console_robot", "bot_console_robt")
    at.reads("waiting for: the command launch *.launch.py, to see it fail", "did you mean 'bot_console_robot'?")
    assert "did you mean" in two.run(launch)
    at.reads("✓ launch *.launch.py has failed", "did you mean 'bot_console_robot'?")
    at.edit("launch/one.launch.py", "bot_console_robt", "bot_console_robot")
    at.does(id)

    launch = at.listing("the-robot-by-its-launch-file")
    at.reads("waiting for: the command launch bot_console_robot robot_system.launch.py")
    two.run(launch.replace("bot_console_robot ", "bot_console_robt "))
    at.reads(
        "waiting for: the command launch bot_console_robot robot_system.launch.py",
        "end the other launch first (Ctrl-C)",
    )
    two.start(launch)
    at.does("the-robot-by-its-launch-file")
    two.interrupt()


def chapter_7(at: Student) -> None:
    two = at.shells[1]
    id, path = "values-beside-the-node", "launch/two.launch.py"
    launch = at.listing(id, 1)
    at.reads("waiting for: a launch of *.launch.py with parameters=")
    at.write(path, at.listing(id).replace("0.8", "1"))
    two.start(launch)
    at.reads("✓ *.launch.py with parameters= was launched", "launch the file, and write the value with a point")
    two.shows("Trying to set parameter 'max_speed' to '1'")
    two.interrupt()
    at.write(path, at.listing(id))
    two.start(launch)
    at.does(id)
    two.interrupt()

    at.reads("waiting for: a launch of *.launch.py with max_sped")
    at.edit(path, "max_speed", "max_sped")
    at.reads("waiting for: a launch of *.launch.py with max_sped", "two.launch.py still has max_sped")
    two.start(launch)
    two.shows(f"{path}:13: max_sped: ... sets nothing")
    at.reads("✓ *.launch.py with max_sped was launched", f"{path} still has max_sped")
    two.interrupt()
    at.edit(path, "max_sped", "max_speed")
    two.start(launch)
    at.does("a-misspelt-name")
    two.interrupt()


def chapter_8(at: Student) -> None:
    two, three = at.shells[1:]
    id = "six-nodes-from-one-file"
    launch = at.listing(id, 1)
    at.reads("waiting for: a launch of *.launch.py with sensor_node")
    at.write("launch/system.launch.py", at.listing(id).replace("sensor_node", "sensor"))
    two.run(launch)
    at.reads("launch/system.launch.py had no sensor_node when it was launched")
    at.write("launch/system.launch.py", at.listing(id))
    two.start(launch)
    at.does(id)

    ask = at.listing("who-hears-the-laser")
    at.reads("waiting for: the command topic info /scan")
    three.run(ask.replace("/scan", "/scann"))
    at.reads("waiting for: the command topic info /scan")
    assert "Subscription count: " in three.run(ask)
    at.does("who-hears-the-laser")
    two.interrupt()


ARGUMENTS = "launch/arguments.launch.py"


def chapter_9(at: Student) -> None:
    two = at.shells[1]
    id = "declare-an-argument"
    show = at.listing(id, 1)
    at.reads(
        "launch/system.launch.py has no DeclareLaunchArgument",
        "waiting for: the command launch *.launch.py --show-args",
    )
    imports, argument, parameters = at.listing(id).split("\n\n")
    at.write(ARGUMENTS, (at.workspace / "launch/two.launch.py").read_text("utf-8"))
    two.run(show)
    at.reads("arguments.launch.py has no DeclareLaunchArgument", "✓ launch *.launch.py --show-args was run")
    at.edit(ARGUMENTS, '                parameters=[{"max_speed": 0.8}],', parameters)
    at.merge(ARGUMENTS, f"{imports}\n\n{argument}", "        [\n", after=True)
    at.does(id)
    assert "Greatest speed (m/s)" in two.run(show)

    launch = at.listing("pass-it")
    at.reads("waiting for: a launch of *.launch.py with max_speed:=…")
    two.run(launch.replace(":=", "="))
    at.reads("waiting for: a launch of *.launch.py with max_speed:=…")
    two.start(launch)
    at.does("pass-it")
    two.interrupt()


def chapter_10(at: Student) -> None:
    two = at.shells[1]
    text = at.listing("indoor-and-outdoor")
    at.reads("there is no file config/indoor*.yaml", "there is no file config/outdoor*.yaml")
    at.write("config/indoor_config.yaml", text)
    at.write("config/outdoor_config.yaml", text.replace("max_speed", "max_sped"))
    at.reads("outdoor_config.yaml gives no max_speed; did you mean max_sped?")
    at.write("config/outdoor_config.yaml", text.replace("0.8", "1.6"))
    at.does("indoor-and-outdoor")

    id = "choose-at-launch"
    launch = at.listing(id, 1)
    argument, parameters = at.listing(id).split("\n\n")
    at.reads("waiting for: a launch of *.launch.py with config_file:=…outdoor… and config_file")
    two.start(launch)
    at.reads(f"{ARGUMENTS} had no config_file when it was launched")
    two.interrupt()
    at.edit(ARGUMENTS, '                parameters=[{"max_speed": LaunchConfiguration("max_speed")}],', parameters)
    at.merge(ARGUMENTS, f"{argument}\n", "        [\n", after=True)
    two.start(launch)
    at.does(id)
    two.interrupt()


def chapter_11(at: Student) -> None:
    two, keys = at.shells[1], at.console.type
    at.reads("waiting for: somebody to set turn_rate")
    two.run(at.listing("slide-a-value"))
    two.run("ros2 param set /robot_navigator max_speed 1.1")
    at.reads("waiting for: somebody to set turn_rate")
    keys("1/turn_rate\r")
    at.shows("1.0 rad/s")
    keys("+")
    at.does("slide-a-value")
    keys("050")
    at.reads("waiting for: the pane history")
    keys("H")
    at.does("see-what-was-changed-and-take-it-back")
    keys("0")


def chapter_12(at: Student) -> None:
    keys = at.console.type
    keys("50")
    at.reads("waiting for: the pane logs")
    keys("20")
    at.does("only-warnings")
    keys("50")
    at.reads("waiting for: the pane graph")
    keys("3")
    at.does("read-the-graph")
    keys("0")


def chapter_13(at: Student) -> None:
    two, keys = at.shells[1], at.console.type
    at.reads("waiting for: the pane plot", "waiting for: a curve of angular.z in the plot")
    keys(at.listing("the-turning-over-time").replace("angular.z", "linear.x") + "\r")
    at.shows("linear.x")
    keys("0")
    at.reads("✓ the pane plot was opened", "waiting for: a curve of angular.z in the plot")
    keys(at.listing("the-turning-over-time") + "\r")
    at.does("the-turning-over-time")
    plot, set_rate = at.lines("beside-the-limit")
    keys("0")
    at.reads("waiting for: a curve of turn_rate in the plot")
    keys(f"{plot}\r")
    keys("0")
    two.run(set_rate.replace("0.5", "5.0"))
    at.reads("✓ a curve of turn_rate was plotted", "waiting for: turn_rate to be set to 0.5")
    two.run(set_rate)
    at.does("beside-the-limit")
    keys("0")


def chapter_14(at: Student) -> None:
    keys = at.console.type
    at.reads("waiting for: the pane steering", "waiting for: the robot to be driven by your keys")
    keys("6w0")  # without arming
    at.reads("✓ the pane steering was opened", "waiting for: the robot to be driven by your keys")
    keys("6\r")
    to_and_fro = itertools.cycle("s" * 40 + "w" * 40)  # One of them leads away from the wall, if there is one.
    at.does_by("drive-by-hand", lambda: keys(next(to_and_fro)))
    keys(" 0")


def chapter_15(at: Student) -> None:
    keys = at.console.type
    at.reads("waiting for: a saved layout")
    arrange(at, "")  # without saving
    at.reads("waiting for: a saved layout")
    arrange(at, "wmine\r")
    keys(":layout lesson\r")
    at.reads("✓ a layout was saved", "a robot that you have steered is handed back by h")
    keys("6h0")
    at.does("arrange-and-save")


def arrange(at: Student, keys: str) -> None:
    """Arrange the panes with some keys, separately from Esc: a key right after Esc would be a key with Alt."""
    at.console.type("V")
    at.shows("w Save")
    at.console.type(keys)
    if keys:
        at.shows("[0 mine]")
    at.console.type("\x1b")
    at.shows("q Quit")


PACKAGE = "src/intelligent_robot"


def chapter_16(at: Student) -> None:
    two = at.shells[1]
    at.reads("there is no file intelligent_robot/package.xml")
    create, folders = at.lines("a-package")
    two.run(create.replace("ament_python", "ament_cmake"))
    at.reads("✓ there is intelligent_robot/package.xml", "there is no file intelligent_robot/setup.py")
    two.run("rm -r src/intelligent_robot", create, folders)
    at.does("a-package")
    up, prefix = at.lines("drive-with-it")
    at.reads("waiting for: the command pkg prefix intelligent_robot")
    two.run(up, prefix.replace("intelligent", "inteligent"))
    at.reads("waiting for: the command pkg prefix intelligent_robot")
    two.run(prefix)
    at.does("drive-with-it")


def scripts(at: Student, *names: str) -> None:
    """Write the console scripts into `setup.py`."""
    path = at.workspace / PACKAGE / "setup.py"
    lines = "".join(f"            '{each} = intelligent_robot.{each}:main',\n" for each in names)
    text = re.sub(r"('console_scripts': \[\n).*?( +\],)", rf"\1{lines}\2", path.read_text("utf-8"), flags=re.DOTALL)
    path.write_text(text, "utf-8")


def chapter_17(at: Student) -> None:
    one, two, three = at.shells
    id = "the-robot-node"
    down, simulator, run = at.lines(id)
    at.reads(
        "there is no file intelligent_robot/robot_node.py", "setup.py has no line for robot_node in console_scripts"
    )
    at.write(f"{PACKAGE}/intelligent_robot/robot_node.py", student_robot.ROBOT)
    scripts(at, "robot_nod")
    at.reads("has no line for robot_node in console_scripts; did you mean robot_nod?")
    scripts(at, "robot_node")
    at.reads("✓ setup.py has a console script robot_node", "waiting for: the command run intelligent_robot robot_node")
    three.run(down)
    three.start(simulator)
    two.start(run)
    at.does(id)

    at.reads("waiting for: a value of safety_distance that is refused")
    one.run(at.listing("it-refuses").replace("5.0", "1.0"))
    at.reads("1.0 was accepted: a callback refuses it by SetParametersResult")
    one.run(at.listing("it-refuses"))
    at.does("it-refuses")

    at.reads("setup.py has no line for sensor_node in console_scripts")
    for program, name in student_robot.OTHERS.items():
        at.write(f"{PACKAGE}/intelligent_robot/{program}.py", student_robot.OTHER.format(name=name))
    scripts(at, "robot_node", *list(student_robot.OTHERS)[:2], "telemetry_nod")
    at.reads("✓ setup.py has a console script safety_node", "no line for telemetry_node in console_scripts")
    scripts(at, "robot_node", *student_robot.OTHERS)
    at.does("sensor-safety-and-telemetry")


def chapter_18(at: Student) -> None:
    two = at.shells[1]
    at.reads("there is no file intelligent_robot/config/indoor_config.yaml")
    for name, speed in (("indoor", 0.8), ("outdoor", 2.0)):
        at.write(f"{PACKAGE}/config/{name}_config.yaml", student_robot.CONFIG.format(speed=speed))
    wrong = student_robot.CONFIG.format(speed=1.5).replace("ros__", "ros_")
    at.write(f"{PACKAGE}/config/warehouse_config.yaml", wrong)
    at.reads("yaml:2: ros_parameters has one underscore")
    at.write(f"{PACKAGE}/config/warehouse_config.yaml", wrong.replace("ros_", "ros__"))
    at.does("three-environments")

    at.reads("config/indoor_config.yaml is not installed: data_files of setup.py has no line for it")
    at.edit(f"{PACKAGE}/setup.py", "    data_files=[\n", f"    data_files=[\n{at.listing('install-them')}\n")
    at.edit(f"{PACKAGE}/setup.py", "from setuptools", "import os\nfrom glob import glob\n\nfrom setuptools")
    at.does("install-them")

    two.interrupt()
    run = at.listing("try-one")
    at.reads("waiting for: the command run intelligent_robot robot_node --params-file … outdoor …")
    two.run(run.replace("outdoor_config", "outdor_config"))
    at.reads("waiting for: the command run intelligent_robot robot_node --params-file … outdoor …")
    two.start(run)
    at.does("try-one")
    two.interrupt()


def chapter_19(at: Student) -> None:
    two = at.shells[1]
    path = f"{PACKAGE}/launch/robot_system.launch.py"
    at.reads("there is no file launch/*launch.py in a package")
    at.write(path, student_robot.LAUNCH.replace('    "telemetry_node": "telemetry_publisher",\n', ""))
    two.start(at.listing("one-file-for-the-system"))
    at.reads("robot_system.launch.py had no telemetry_node when it was launched")
    two.interrupt()
    at.write(path, student_robot.LAUNCH)
    two.start(at.listing("one-file-for-the-system"))
    at.does("one-file-for-the-system")
    two.interrupt()

    launch = at.listing("with-an-environment")
    at.reads("waiting for: a launch of intelligent_robot/launch/*launch.py with an argument that contains outdoor")
    two.start(launch.replace("outdoor_config", "outdor_config"))
    two.shows("Parameter file path is not a file")
    at.reads("waiting for: a launch of intelligent_robot/launch/*launch.py with an argument that contains outdoor")
    two.interrupt()
    two.start(launch)
    at.does("with-an-environment")


def chapter_20(at: Student) -> None:
    one, two, three = at.shells
    at.reads("waiting for: max_speed to be set to 2.0", "waiting for: a value of detection_threshold that is refused")
    valid, invalid = at.lines("valid-and-invalid")
    one.run(valid, invalid.replace("300", "200"))
    at.reads("waiting for: a value of detection_threshold that is refused; 200 was accepted")
    one.run(invalid)
    at.does("valid-and-invalid")
    two.interrupt()
    three.interrupt()

    build, lint = at.lines("would-it-build-on-ros-2")
    at.reads("waiting for: the command colcon build", "waiting for: the command lint")
    at.edit(f"{PACKAGE}/setup.py", 'glob("config/*.yaml")', 'glob("config/in*.yaml")')
    at.loses("install-them")
    assert "config/outdoor_config.yaml is not installed" in one.run(build)
    assert "config/outdoor_config.yaml is not installed" in one.run(lint)
    at.reads("outdoor_config.yaml is not installed: data_files of setup.py has no line for it")
    at.edit(f"{PACKAGE}/setup.py", 'glob("config/in*.yaml")', 'glob("config/*.yaml")')
    one.run(build, lint)
    at.does("install-them", "would-it-build-on-ros-2")


def chapter_21(at: Student) -> None:
    one = at.shells[0]
    check = at.listing("grade-yourself")
    at.reads("waiting for: the command check --course week6: all rows have to pass")
    if not can_isolate():
        check = f"{check} --allow-network"
    at.edit(f"{PACKAGE}/intelligent_robot/robot_node.py", '"max_speed": 1.0', '"max_speed": 1.5')
    assert "FAIL" in one.run(check)
    at.reads("it ended with exit code 1")
    at.edit(f"{PACKAGE}/intelligent_robot/robot_node.py", '"max_speed": 1.5', '"max_speed": 1.0')
    assert "13 of 13 points" in one.run(check)
    at.does("grade-yourself")


def chapter_22(at: Student) -> None:
    """The bonus challenges, each with one of the student's own programs."""
    one, two, three = at.shells
    made = ["robot_node", *student_robot.OTHERS]

    def add(program: str, text: str) -> None:
        made.append(program)
        at.write(f"{PACKAGE}/intelligent_robot/{program}.py", text)
        scripts(at, *made)

    up, run, call = at.lines("presets-by-a-service")
    at.reads(
        "setup.py has no line for preset_node in console_scripts", "waiting for: the command service call /preset/fast"
    )
    one.run(up)
    add("preset_node", student_bonus.PRESETS.replace("1.8", "1.7"))
    two.start(run)
    until_listed(one, "/preset/fast")
    one.run(call)
    at.reads(
        "✓ service call /preset/fast was run",
        "waiting for: max_speed to be set to 1.8; it was set to 1.7: has the node set it?",
    )
    two.interrupt()
    at.edit(f"{PACKAGE}/intelligent_robot/preset_node.py", "1.7", "1.8")
    two.start(run)
    until_listed(one, "/preset/fast")
    one.run(call)
    at.does("presets-by-a-service")
    two.interrupt()

    run, plot = at.lines("a-speed-that-tunes-itself")
    at.reads("setup.py has no line for tuning_node", "waiting for: a curve of max_speed in the plot")
    add("tuning_node", student_bonus.TUNER)
    at.console.type(f"{plot.replace('max_speed', 'turn_rate')}\r0")
    at.reads(
        "waiting for: the command run intelligent_robot tuning_node", "waiting for: a curve of max_speed in the plot"
    )
    two.start(run)
    at.console.type(f"{plot}\r0")
    at.does("a-speed-that-tunes-itself")
    two.interrupt()

    run, set_rate = at.lines("a-history-of-all-changes")
    at.reads("setup.py has no line for history_node", "there is no file history.csv")
    add("history_node", student_bonus.HISTORY)
    two.start(run)
    until_listed(one, "/history/get_parameters")
    one.run("ros2 param set /robot_navigator max_speed 1.0")
    at.reads("history.csv has no turn_rate")
    one.run(set_rate)
    at.does("a-history-of-all-changes")
    two.interrupt()

    id = "a-pane-of-your-own"
    at.reads("setup.py has no bot_console.panes", "waiting for: a pane of a package")
    at.write(f"{PACKAGE}/intelligent_robot/pane.py", at.listing(id))
    line, scripts_line = at.listing(id, 1) + "\n", "        'console_scripts': ["
    at.edit(f"{PACKAGE}/setup.py", scripts_line, line.replace("panes", "pane") + scripts_line)
    at.reads("setup.py has no bot_console.panes")
    at.edit(f"{PACKAGE}/setup.py", "bot_console.pane'", "bot_console.panes'")
    at.reads("waiting for: a pane of a package")
    at.reopen()
    at.console.type("\x10my pane")
    at.shows("Pane: my pane")
    at.console.type("\r")
    at.does(id)
    at.console.type("0")

    id = "values-from-a-server"
    serve, run = at.lines(id, 1)
    at.reads("there is no file config/remote.yaml", "setup.py has no line for remote_node")
    at.write("config/remote.yaml", at.listing(id))
    port = str(free_port())
    add("remote_node", student_bonus.REMOTE.replace("8000", port))
    two.start(run)
    two.shows("no values from the server")
    at.reads(
        "✓ run intelligent_robot remote_node was run",
        "waiting for: max_speed to be set to 0.85: does the server run",
    )
    two.interrupt()
    three.start(serve.replace("8000", port))
    three.shows("Serving HTTP")
    two.start(run)
    at.does(id)
    two.interrupt()
    three.interrupt()


def until_listed(shell: Shell, service: str) -> None:
    """Wait until a service is there."""
    until(lambda: service in shell.run("ros2 service list").split(), lambda: f"no {service}: {shell.printed()}")


CHAPTERS = {
    1: chapter_1,
    2: chapter_2,
    3: chapter_3,
    4: chapter_4,
    5: chapter_5,
    6: chapter_6,
    7: chapter_7,
    8: chapter_8,
    9: chapter_9,
    10: chapter_10,
    11: chapter_11,
    12: chapter_12,
    13: chapter_13,
    14: chapter_14,
    15: chapter_15,
    16: chapter_16,
    17: chapter_17,
    18: chapter_18,
    19: chapter_19,
    20: chapter_20,
    21: chapter_21,
    22: chapter_22,
}
KEPT, FIRST = os.environ.get("BOT_CONSOLE_WALK", ""), int(os.environ.get("BOT_CONSOLE_WALK_FROM", "1"))
"""A folder that gets a copy of the workspace before each chapter, and the chapter to begin with in such a copy."""
SIMULATOR = "bot-console launch bot_console_robot simulator.launch.py"


def begin(at: Student, number: int) -> None:
    """Start what the earlier chapters have left running."""
    one, two, three = at.shells
    if number in range(2, 6):
        one.start("bot-console run src/simple_robot.py")
        one.shows("m/s")
    if number in range(2, 7) or number in range(12, 18):
        two.run("bot-console up")
    if number == 15:
        at.console.type("6\r0")
    if number in range(18, 22):
        three.start(SIMULATOR)
    if number == 18:
        two.start("bot-console run intelligent_robot robot_node")
    if number == 20:
        two.start("bot-console launch intelligent_robot robot_system.launch.py")
        until_listed(one, "/robot_navigator/set_parameters")


@pytest.mark.soak
@pytest.mark.timeout(600)
def test_first_chapter_can_be_completed(student: Callable[[Path], Student]) -> None:
    chapter_1(student(WEEK6))


@pytest.mark.soak
@pytest.mark.timeout(3600)
def test_whole_course_can_be_completed(student: Callable[..., Student]) -> None:
    at = student(WEEK6, Path(KEPT) / str(FIRST) if FIRST > 1 else None)
    if FIRST > 1:
        begin(at, FIRST)
    for number, chapter in CHAPTERS.items():
        if number >= FIRST:
            if KEPT:
                kept = Path(KEPT) / str(number)
                shutil.copytree(at.workspace, kept, ignore=shutil.ignore_patterns("*.saving"), dirs_exist_ok=True)
            chapter(at)
    assert at.done() == {each.id for each in at.course.steps()}
