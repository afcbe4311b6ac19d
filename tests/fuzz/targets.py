"""Every parser of input from people, files and nodes, as a target: valid inputs, and the refusals of invalid ones."""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import bags
import browser
import files
import installed
import messages
import programs
import seeds
import sockets
import stores
import typed
import wire
import workspaces
import yaml
from mutation import mutated


@dataclass(frozen=True)
class Target:
    """A parser to feed. `run` returns for any input; only `refusals` may be raised."""

    name: str
    seeds: Callable[[], Sequence[str]]
    run: Callable[[str], object]
    refusals: tuple[type[BaseException], ...] = ()
    share: float = 1.0
    """Its share of the inputs compared with other targets; lower for slow ones."""


def targets() -> list[Target]:
    """All targets."""
    from bot_console.runtime.rmw.arguments import ArgumentsError
    from bot_console.runtime.rmw.lexer import GrammarError
    from bot_console.runtime.rmw.parameter_overrides import ParameterYamlError
    from bot_console.runtime.rmw.zenoh.session import SessionError
    from bot_console.runtime.rmw.zenoh.wire.keys import FormatError
    from bot_console.runtime.rosidl.parse import DefinitionError
    from bot_console.tui.cli.check.script import ScriptError
    from bot_console.tui.console.bags.damage import BagError
    from bot_console.tui.console.plot.arrays import NotPlottable
    from bot_console.tui.files.jsonc import JsoncError
    from bot_console.tui.files.plot_presets import PlotPresetError
    from bot_console.tui.files.save_file import NotSaved
    from bot_console.tui.layout.form import LayoutError
    from bot_console_robot.preset_files import PresetError
    from bot_console_robot.safety.stop_file import StopFileError
    from bot_console_robot.simulation.world import WorldError

    arguments = (
        "--ros-args -p a:=1 -r b:=c --",
        "a --ros-args --params-file x -r __ns:=/a n:b:=c --log-level info",
        "--ros-args -r rosservice:///a:=b -e /x",
    )
    broad = (ValueError, TypeError, AttributeError, KeyError, AssertionError, OverflowError, yaml.YAMLError)
    return [
        Target("parameter file", seeds.files("profiles/*.yaml"), files.parameter_file, (ParameterYamlError,)),
        Target("preset", seeds.files("profiles/*.yaml"), files.preset, (PresetError,)),
        Target("profile", seeds.files("profiles/*.yaml"), files.profile),
        Target("save into a file", seeds.files("profiles/*.yaml"), files.save, (NotSaved,)),
        Target("world", seeds.files("profiles/worlds/*.yaml"), files.world, (WorldError,)),
        Target("launch Python", seeds.files("launch/single*.py", "launch/sim*.py"), files.launch("py")),
        Target("launch XML", seeds.texts(seeds.LAUNCH_XML), files.launch("xml")),
        Target("launch YAML", seeds.texts(seeds.LAUNCH_YAML), files.launch("yaml")),
        Target(
            "substitution",
            seeds.texts("a $(var b) c", "$(env A $(var b '1'))", "$(eval 'x' + \"y\") \\$(z)"),
            typed.substitution,
            (ValueError,),
        ),
        Target("ROS arguments", seeds.texts(*arguments), typed.ros_arguments, (ArgumentsError, GrammarError)),
        Target("verbs", seeds.texts(*seeds.VERBS), typed.quietly(typed.verbs)),
        Target(
            "interface verbs",
            seeds.texts("show std_msgs/msg/String", "list -m", "proto geometry_msgs/msg/Twist", "package std_msgs"),
            typed.quietly(typed.interface_verbs),
        ),
        Target(
            "command line",
            seeds.texts("indoor --seed 1", "--launch a.launch.py x:=1 --pane plot", "--headless --duration 5 --fast"),
            typed.quietly(typed.console_line),
        ),
        Target("lines", seeds.texts(*seeds.LINES), typed.line, (ValueError,)),
        Target(
            "filter",
            seeds.texts(
                "speed !node:/arm sev:>=warn re:a.b", 'node:"a b" !re:"x y" sev:info,fatal', "re:^[a-z]+\\s\\d{1,3}$"
            ),
            typed.filter,
            (ValueError,),
        ),
        Target(
            "plot path",
            seeds.texts("pose.pose/position.x", "ranges[0]", "ranges[1:9].min()", "pose.pose.orientation.yaw()"),
            typed.plot,
            (NotPlottable,),
        ),
        Target("expression", seeds.texts(*seeds.EXPRESSIONS), typed.expression, (ValueError,)),
        Target("condition", seeds.texts(*seeds.CONDITIONS), typed.condition, (ValueError,)),
        Target(
            "definition msg",
            seeds.files(
                "runtime/rosidl/definitions/sensor_msgs/msg/L*.msg", "runtime/rosidl/definitions/std_msgs/msg/*.msg"
            ),
            files.definition("msg"),
            (DefinitionError,),
        ),
        Target(
            "definition srv",
            seeds.files(
                "runtime/rosidl/definitions/std_srvs/srv/*.srv", "runtime/rosidl/definitions/rcl_interfaces/srv/*.srv"
            ),
            files.definition("srv"),
            (DefinitionError,),
        ),
        Target(
            "message as YAML",
            seeds.texts(
                "{header: {frame_id: a, stamp: {sec: 1}}, ranges: [1.0, .nan], angle_min: 0.5}",
                "angle_max: 1\nranges: [1, 2]",
            ),
            messages.message_yaml,
            broad,
        ),
        Target("message as bytes", messages.cdr_seeds, messages.cdr),
        Target(
            "text in panes",
            seeds.texts("a line [bold]x[/] of a node", "/robot/arm\n[link=x]y", "\x1b[31mred\x1b[0m", "日本語 😀 text"),
            messages.pane_text,
        ),
        Target(
            "typed value",
            seeds.texts("1.5", "[1, 2.5]", '["a", b, "c, d"]', "true", '"two\\tparts"', "[0x0a, 0xff]", "0x10"),
            typed.typed_value,
        ),
        Target(
            "typed field",
            seeds.texts("1.5", "now", "1.5 s", "[1, 2]", "{x: 1.0}", "true", "90 deg", '"a"'),
            typed.typed_field,
        ),
        Target(
            "stop messages",
            seeds.texts(
                '[["a", "anna", "why", 3], ["node", "n", "gone", 4]]', '["a", "node"]', "release", "true", "17"
            ),
            messages.stop,
        ),
        Target(
            "settings",
            seeds.texts("theme: dark\nkeys:\n  app.stop: f2\n", "colours: {ok: '#00ff00'}\n"),
            files.settings,
        ),
        Target(
            "layout",
            seeds.texts("layout:\n  beside: [parameters, {below: [logs, plot]}]\n  share: [1, 2]\n"),
            files.layout("yaml"),
            (LayoutError,),
        ),
        Target("perspective", seeds.texts(seeds.PERSPECTIVE), files.layout("perspective"), (LayoutError,)),
        Target("package.xml", seeds.texts(seeds.PACKAGE), files.package, (ValueError,)),
        Target("node file", seeds.files("nodes/telemetry_node.py"), files.plain_file),
        Target("printed lines", seeds.texts(seeds.TRACEBACK), messages.printed),
        Target("saved log", seeds.texts(*seeds.SAVED_LOG), bags.saved_log),
        Target("bag's metadata", seeds.texts(seeds.METADATA), bags.metadata),
        Target("bag of MCAP", bags.mcap_seeds, bags.bag(".mcap"), (BagError,)),
        Target("bag of SQLite", bags.sqlite_seeds, bags.bag(".db3"), (BagError,)),
        Target("file names", seeds.texts("~/a.yaml", "/tmp/x", "a b", "~root/x"), typed.typed_path, (NotSaved,)),
        Target(
            "keys of the network",
            seeds.texts("std_msgs::msg::dds_::String_", "0/%a%b/std_msgs::msg::dds_::String_/RIHS01_ab"),
            messages.key_expressions,
            (FormatError,),
        ),
        Target("stop file", stores.stop_file_seeds, stores.stop_file, (StopFileError,)),
        Target("row of the history", seeds.texts("\n".join(stores.ROW)), stores.history_row),
        Target("file of the history", stores.history_file_seeds, stores.history_file, share=0.2),
        Target("states of panes", seeds.texts(*seeds.STATES), stores.pane_states),
        Target("lines of stores", seeds.texts(*seeds.STORED_LINES), stores.lines_of_stores),
        Target("progress in a course", seeds.texts(seeds.PROGRESS), stores.progress),
        Target("preset of curves", seeds.texts(seeds.CURVES), stores.preset_of_curves, (PlotPresetError,)),
        Target("system in the background", seeds.texts(seeds.BACKGROUND), stores.background),
        Target("control topics in MCAP", bags.control_seeds("mcap"), bags.control_bag(".mcap"), (BagError,), share=0.5),
        Target(
            "control topics in SQLite", bags.control_seeds("sqlite3"), bags.control_bag(".db3"), (BagError,), share=0.5
        ),
        Target("chapter of a course", seeds.files("tui/learn/courses/week6/*.md"), workspaces.chapter, (ValueError,)),
        Target("check script", seeds.texts(*seeds.SCRIPTS), workspaces.check_script, (ScriptError,)),
        Target("expected graph", seeds.texts(*seeds.EXPECTED), workspaces.expected_graph, (ValueError,)),
        Target("settings of an editor", seeds.texts(*seeds.JSONC), workspaces.editor_settings, (JsoncError,)),
        Target(
            "setup.py",
            seeds.texts(seeds.SETUP_PY),
            workspaces.build_file("setup.py", "setup_py.read_setup_py"),
            (ValueError,),
        ),
        Target(
            "CMakeLists.txt",
            seeds.texts(seeds.CMAKE),
            workspaces.build_file("CMakeLists.txt", "cmake_lists.read_cmake_lists"),
            (ValueError,),
        ),
        Target("options of bag convert", seeds.texts(*seeds.CONVERT), workspaces.convert_options, share=0.3),
        Target("QoS overrides", seeds.texts(*seeds.QOS_OVERRIDES), workspaces.qos_overrides, (ValueError,)),
        Target("words of a tuning", seeds.texts(*seeds.TUNING), workspaces.tuning),
        Target("liveliness token", wire.token_seeds, wire.token, (FormatError,)),
        Target("attachment", wire.attachment_seeds, wire.attachment, (FormatError,)),
        Target("reports of a process", seeds.texts(*wire.NEWS), wire.news),
        Target("terminal input", seeds.texts(*wire.INPUT), wire.terminal_input),
        Target("request of a browser", browser.http_seeds, browser.http, share=0.05),
        Target(
            "message of a page",
            seeds.texts('["stdin", "abc"]', '["resize", {"width": 80, "height": 24}]', '["alive"]'),
            browser.page_message,
        ),
        Target("frames of a browser", sockets.frame_seeds, sockets.frames, share=0.05),
        Target("handshake with a router", sockets.handshake_seeds, sockets.router_handshake, share=0.05),
        Target("answer of a router", sockets.answer_seeds, sockets.router_answer, (SessionError,), share=0.05),
        Target("plug-ins of a package", seeds.texts(*installed.PLUGINS), installed.plugins),
        Target("panes of a workspace", seeds.texts(*installed.SETUP_CFG), installed.panes_of_workspace, (ValueError,)),
        Target("file of an environment", seeds.texts(*installed.FOLDERS), installed.file_of_environment),
        Target("code of a shell", seeds.texts(*installed.FOLDERS), installed.code_of_shell, share=0.05),
        Target("bytes of a command line", seeds.texts(*seeds.WORDS), programs.command_line, share=0.02),
        Target("bytes of the environment", seeds.texts(*seeds.VARIABLES), programs.environment, share=0.02),
    ]


def inputs_of(target: Target, seed: int) -> Iterator[str]:
    """Valid inputs first, then endlessly mutated ones; the same seed gives the same inputs."""
    chance = random.Random(f"{seed} {target.name}")
    good = target.seeds()
    return itertools.chain(good, (mutated(good, chance) for _ in itertools.count()))
