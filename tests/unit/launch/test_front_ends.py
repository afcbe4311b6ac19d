"""Launch files in XML and YAML: the same trees as in Python, and the errors for invalid ones. Contract, section 2."""

from __future__ import annotations

import inspect
import io
import re
import sys
from pathlib import Path
from typing import Any

import pytest
from launch.actions import ExecuteProcess, GroupAction, IncludeLaunchDescription, LogInfo, TimerAction
from launch.conditions import IfCondition, UnlessCondition
from launch.frontend.parse_substitution import parse_substitution
from launch.frontend.process_attributes import parse_command_line
from launch.utilities import perform_substitutions
from launch_ros.actions import LifecycleNode, Node
from launch_ros.descriptions import ParameterFile, ParameterValue
from launch_xml import Parser as XmlParser
from launch_yaml import Parser as YamlParser
from launching import Launch

from launch import LaunchContext, LaunchDescription

PYTHON = """
    from launch import LaunchDescription
    from launch.actions import *
    from launch.conditions import IfCondition, UnlessCondition
    from launch.substitutions import *
    from launch_ros.actions import *

    def generate_launch_description():
        x = LaunchConfiguration("x")
        return LaunchDescription([
            DeclareLaunchArgument("x", default_value="1", description="a number", choices=["1", "2"]),
            SetLaunchConfiguration("y", ["a", x]),
            LogInfo(msg=["x ", x]),
            LogInfo(msg="never", condition=IfCondition(NotSubstitution("true"))),
            LogInfo(msg="always", condition=UnlessCondition("0")),
            GroupAction([
                SetLaunchConfiguration("x", "in"),
                PushRosNamespace("n"),
                LogInfo(msg=LaunchConfiguration("ros_namespace")),
                LogInfo(msg=x),
            ]),
            GroupAction([SetLaunchConfiguration("z", "leaks")], scoped=False),
            GroupAction(
                [LogInfo(msg=LaunchConfiguration("z", default="gone")), LogInfo(msg=LaunchConfiguration("k"))],
                forwarding=False, launch_configurations={"k": x},
            ),
            SetEnvironmentVariable("BC_E", "1"),
            AppendEnvironmentVariable("BC_E", "2", separator=","),
            LogInfo(msg=EnvironmentVariable("BC_E")),
            UnsetEnvironmentVariable("BC_E"),
            LogInfo(msg=EnvironmentVariable("BC_E", default_value="none")),
            LogInfo(msg=PythonExpression(["'", x, "' == '1'"])),
            LogInfo(msg=ThisLaunchFileDir()),
            TimerAction(period=0.01, actions=[LogInfo(msg="timer"), Shutdown(reason="done")]),
            ForLoop("2", name="i", function=lambda i: [LogInfo(msg=["round ", str(i)])]),
        ])
"""

XML = """
    <launch>
      <arg name="x" default="1" description="a number"><choice value="1"/><choice value="2"/></arg>
      <let name="y" value="a$(var x)"/>
      <log message="x $(var x)"/>
      <log message="never" if="$(not true)"/>
      <log message="always" unless="0"/>
      <group>
        <let name="x" value="in"/>
        <push-ros-namespace namespace="n"/>
        <log message="$(var ros_namespace)"/>
        <log message="$(var x)"/>
      </group>
      <group scoped="false"><let name="z" value="leaks"/></group>
      <group forwarding="false">
        <keep name="k" value="$(var x)"/>
        <log message="$(var z gone)"/>
        <log message="$(var k)"/>
      </group>
      <set_env name="BC_E" value="1"/>
      <append_env name="BC_E" value="2" separator=","/>
      <log message="$(env BC_E)"/>
      <unset_env name="BC_E"/>
      <log message="$(env BC_E none)"/>
      <log message="$(eval &quot;'$(var x)' == '1'&quot;)"/>
      <log message="$(dirname)"/>
      <timer period="0.01"><log message="timer"/><shutdown reason="done"/></timer>
      <for len="2" name="i"><log message="round $(index i)"/></for>
    </launch>
"""

YAML = """
    launch:
      - arg: {name: x, default: "1", description: a number, choice: [{value: "1"}, {value: "2"}]}
      - let: {name: y, value: a$(var x)}
      - log: {message: x $(var x)}
      - log: {message: never, if: $(not true)}
      - log: {message: always, unless: "0"}
      - group:
          - let: {name: x, value: in}
          - push_ros_namespace: {namespace: n}
          - log: {message: $(var ros_namespace)}
          - log: {message: $(var x)}
      - group:
          scoped: false
          children: [{let: {name: z, value: leaks}}]
      - group:
          forwarding: false
          keep: [{name: k, value: $(var x)}]
          children: [{log: {message: $(var z gone)}}, {log: {message: $(var k)}}]
      - set_env: {name: BC_E, value: "1"}
      - append_env: {name: BC_E, value: "2", separator: ","}
      - log: {message: $(env BC_E)}
      - unset_env: {name: BC_E}
      - log: {message: $(env BC_E none)}
      - log: {message: "$(eval \\"'$(var x)' == '1'\\")"}
      - log: {message: $(dirname)}
      - timer: {period: 0.01, children: [{log: {message: timer}}, {shutdown: {reason: done}}]}
      - for: {len: "2", name: i, children: [{log: {message: round $(index i)}}]}
"""


@pytest.mark.parametrize(("name", "text"), [("x.launch.py", PYTHON), ("x.launch.xml", XML), ("x.launch.yaml", YAML)])
def test_python_xml_and_yaml_launch_files_are_equivalent(run_file: Launch, tmp_path: Any, name: str, text: str) -> None:
    outcome = run_file(text, name)
    assert outcome.message == [
        "x 1", "always", "/n", "in", "gone", "1", "1,2", "none", "True", str(tmp_path), "round 0", "round 1", "timer",
    ], outcome.text  # fmt: skip


def xml(text: str) -> list[Any]:
    return parse_entities(XmlParser, f"<launch>{text}</launch>")


def yaml(text: str) -> list[Any]:
    return parse_entities(YamlParser, f"launch:\n{text}")


def parse_entities(kind: Any, text: str) -> list[Any]:
    root, parser = kind.load(io.StringIO(text))
    description: LaunchDescription = parser.parse_description(root)
    return description.entities


def test_xml_node_accepts_all_attributes() -> None:
    [node] = xml(
        """<node pkg="p" exec="e" name="n" namespace="s" exec_name="l" args="-a $(var b) c"
        ros_args="--log-level debug"
        output="screen" respawn="true" respawn_delay="2.5" respawn_max_retries="3" launch-prefix="nice" cwd="/tmp"
        on_exit="shutdown" if="true" sigterm_timeout="7">
          <param name="i" value="7"/><param name="t" value="'7'"/><param name="s" value="7" type="str"/>
          <param name="l" value="[1, 2]"/><param name="d" value="1;2" value-sep=";"/>
          <param name="g"><param name="a" value="true"/></param>
          <param from="f.yaml" allow_substs="true"/><remap from="a" to="b"/><env name="A" value="$(var x)"/>
        </node>"""
    )
    assert isinstance(node, Node)
    assert isinstance(node.condition, IfCondition)
    values: list[Any] = []
    for each in node.parameters:
        values += [each] if isinstance(each, ParameterFile) else list(each.values())
    integer, quoted, text, items, split, nested, file = values
    assert [each.value for each in (integer, quoted, items, split, nested)] == [7, "7", [1, 2], [1, 2], True]
    assert isinstance(text, ParameterValue)
    assert text.value_type is str
    assert isinstance(file, ParameterFile)
    words = [" ".join(each.describe() for each in word) for word in node.cmd]
    assert words[1:6] == ["'-a'", "LaunchConfig('b')", "'c'", "'--ros-args'", "'--log-level'"]


def test_lifecycle_node_may_start_itself() -> None:
    [node] = xml('<lifecycle_node pkg="p" exec="e" name="n" namespace="" autostart="$(var x)"/>')
    assert isinstance(node, LifecycleNode)
    assert [each.describe() for each in node.node_autostart] == ["LaunchConfig('x')"]


def test_yaml_executable_accepts_its_attributes() -> None:
    [process] = yaml(
        "  - executable: {cmd: \"echo a 'b c'\", name: e, shell: true, output: screen, env: [{name: A, value: b}]}"
    )
    assert isinstance(process, ExecuteProcess)
    assert process.shell
    assert [word[0].describe() for word in process.cmd] == ["'echo'", "'a'", "'b c'"]


def command_words(text: str) -> list[str]:
    """Return the parts of each word of a command."""
    [process] = xml(f"<executable cmd={text!r}/>")
    return [" ".join(part.describe() for part in word) for word in process.cmd]


def test_command_is_split_into_words_with_substitutions() -> None:
    variable = "LaunchConfig('a')"
    assert command_words("$(var a) $(var a)b 'c d'$(var a) ") == [
        variable,
        f"{variable} 'b'",
        f"'c d' {variable}",
    ]
    assert command_words("$(var a) x") == [variable, "'x'"]
    assert command_words("x$(var a)  y") == [f"'x' {variable}", "'y'"]


def test_empty_args_give_one_empty_word() -> None:
    [node] = xml('<node exec="e" args=""/>')
    assert node.cmd[1] == []


def test_signal_timeouts_may_be_numbers() -> None:
    [process] = yaml("  - executable: {cmd: e, sigterm_timeout: 4.0, sigkill_timeout: 2.5}")
    context = LaunchContext()
    assert process.sigterm_timeout[0].perform(context) == "4.0"
    assert process.sigkill_timeout[0].perform(context) == "2.5"


def test_timer_may_continue_during_shutdown() -> None:
    [timer] = xml('<timer period="1" cancel_on_shutdown="false"><log message="a"/></timer>')
    assert isinstance(timer, TimerAction)
    assert timer.describe_conditional_sub_entities()[0][0] == "1.0 seconds pass without being canceled"


def test_unless_becomes_a_condition() -> None:
    [log] = xml('<log message="a" unless="$(var x)"/>')
    assert isinstance(log.condition, UnlessCondition)


def test_yaml_group_may_be_a_map() -> None:
    [group] = yaml("  - group: {scoped: false, children: [{log: {message: a}}]}")
    assert isinstance(group, GroupAction)
    assert [type(each) for each in group.get_sub_entities()] == [LogInfo]


XML_ERRORS: list[tuple[str, type[Exception], str]] = [
    (
        '<node exec="e" node-name="n"/>',  # upstream took it for `name` until launch_ros 0.26.12, and failed later
        ValueError,
        "Unexpected attribute(s) found in `node`: {'node-name'}",
    ),
    ('<node exec="e" bogus="1"/>', ValueError, "Unexpected attribute(s) found in `node`: {'bogus'}"),
    ('<node exec="e"><bogus/></node>', ValueError, "Unexpected nested tag(s) found in `node`: {'bogus'}"),
    ("<nodes/>", RuntimeError, "Unrecognized entity of the type: nodes"),
    ('<node pkg="p"/>', AttributeError, "Attribute 'exec' of type '<class 'str'>' not found in Entity 'node'"),
    ('<log message="a" if="1" unless="1"/>', RuntimeError, "if and unless conditions can't be used simultaneously"),
    (
        '<node exec="e" on_exit="restart"/>',
        ValueError,
        "Attribute on_exit of Entity node expected to be shutdown but got `restart`"
        "Other on_exit actions not yet supported",
    ),
    (
        '<executable cmd="e" on_exit="restart"/>',
        ValueError,
        "Attribute on_exit of Entity node expected to be shutdown but got `restart`"
        "Other on_exit actions not yet supported",
    ),
    *(
        (
            f'<executable cmd="e" {name}="-1"/>',
            ValueError,
            f"Attribute {name} of Entity node expected to be a non-negative value but got `-1.0`",
        )
        for name in ("respawn_delay", "sigterm_timeout", "sigkill_timeout")
    ),
    (
        '<node exec="e" sigterm_timeout="$(var t)"/>',
        TypeError,
        "'<' not supported between instances of 'str' and 'float'",
    ),
    ('<node exec="e"><param value="a"/></node>', ValueError, "param Entity should have name or from attribute"),
    (
        '<node exec="e"><param name="a" value="b" allow_substs="true"/></node>',
        RuntimeError,
        "'allow_substs' can only be used together with 'from' attribute",
    ),
    (
        '<node exec="e"><param name="a" value="1" type="double"/></node>',
        ValueError,
        "Got invalid type identifier 'double'",
    ),
    (
        '<node exec="e"><param name="a" value="2.5" type="int"/></node>',
        TypeError,
        "value='2.5' is not an instance of <class 'int'>",
    ),
    ('<node exec="e"><param name="a"/></node>', RuntimeError, "either a value attribute or nested params are needed"),
    (
        '<node exec="e"><param name="a" from="b"/></node>',
        RuntimeError,
        "name and from attributes are mutually exclusive",
    ),
    ('<node exec="e"><param name="a" value="[1, a]"/></node>', ValueError, "The result is a non-uniform list"),
    (
        '<node exec="e"><param name="a" value="null"/></node>',
        TypeError,
        "Attribute 'value' of Entity 'param' expected to be of type 'None'.'null' can not be converted to one of "
        "those types",
    ),
]


@pytest.mark.parametrize(("text", "kind", "message"), XML_ERRORS, ids=[row[2][:50] for row in XML_ERRORS])
def test_invalid_xml_is_rejected(text: str, kind: type[Exception], message: str) -> None:
    with pytest.raises(kind) as caught:
        xml(text)
    assert str(caught.value) == message


YAML_ERRORS: list[tuple[str, type[Exception], str]] = [
    (
        "  - log: {message: true}",
        TypeError,
        "Attribute 'message' of Entity 'log' expected to be of type '<class 'str'>', got '<class 'bool'>'",
    ),
    (
        "  - log: {message: a, if: true}",
        TypeError,
        "Attribute 'if' of Entity 'log' expected to be of type '<class 'str'>', got '<class 'bool'>'",
    ),
    ("  - node: {pkg: p}", AttributeError, "Can not find attribute 'exec' in Entity 'node'"),
    ("  - node: {exec: e, bogus: 1}", ValueError, "Unexpected key(s) found in `node`: {'bogus'}"),
    (
        "  - {log: {message: a}, let: {}}",
        RuntimeError,
        "Subentities must be a dictionary with only one key, which is the entity type",
    ),
    (
        "  group: {}",
        ValueError,
        "Expected entity `launch` to have children entities."
        "That can be a list of subentities or a dictionary with a `children` list element",
    ),
]


@pytest.mark.parametrize(("text", "kind", "message"), YAML_ERRORS, ids=[row[2][:50] for row in YAML_ERRORS])
def test_invalid_yaml_is_rejected(text: str, kind: type[Exception], message: str) -> None:
    with pytest.raises(kind) as caught:
        yaml(text)
    assert str(caught.value) == message


SUBSTITUTIONS: list[tuple[str, list[str]]] = [
    ("plain", ["'plain'"]),
    ("", ["''"]),
    ("costs 5$", ["'costs 5$'"]),
    (r"\$(var x)", ["'$(var x)'"]),
    ("a $(var x)b", ["'a '", "LaunchConfig('x')", "'b'"]),
    ("$(var x 'a b')", ["LaunchConfig('x')"]),
    ("$(env HOME)", ["EnvVar('HOME')"]),
    ("$(find-exec ls)", ["FindExec('ls')"]),
    ("$(command 'echo a')", ["Command('echo a')"]),
    ("$(eval '1 + $(var x)')", ["PythonExpr('1 + ' + LaunchConfig('x'), ['math'])"]),
    ("$(find-pkg-share $(var p))/x", ["FindPackageShare(pkg=LaunchConfig('p'))", "'/x'"]),
    ("$(find-pkg-prefix p)", ["FindPackagePrefix(pkg='p')"]),
    ("$(exec-in-pkg e p)", ["ExecInPkg(pkg='p', exec='e')"]),
    ("$(dirname)", ["ThisLaunchFileDir()"]),
    ("$(anon a)", ["AnonName('a')"]),
    ("$(and true $(var x))", ["AndSubstitution('true' LaunchConfig('x'))"]),
    ("$(path-join a b)", ["PathJoin(''a' + 'b'')"]),
    ("$(param speed '1 2')", ["Parameter('speed')"]),
    ("$(env A '$(env B \"c\")')", ["EnvVar('A')"]),
    ('$(var x "$(var y it\'s)")', ["LaunchConfig('x')"]),
]


@pytest.mark.parametrize(("text", "pieces"), SUBSTITUTIONS, ids=[row[0] for row in SUBSTITUTIONS])
def test_substitutions_are_parsed_from_text(text: str, pieces: list[str]) -> None:
    XmlParser.load_launch_extensions()
    assert [each.describe() for each in parse_substitution(text)] == pieces


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("$(var  x)", "column 7"),
        ("$(var x", "ends where"),
        ("$()", "name of a substitution"),
        ("$(nosuch a)", "Unknown substitution: nosuch"),
        ("$(eval $(var i) == 1)", "eval substitution expects 1 or 2 arguments"),
        ("$(var)", "var substitution expects 1 or 2 arguments"),
        ("$(param a b c)", "param substitutions expect 1 or 2 arguments"),
        ("$(env A \"$(env B 'c d')\")", "env substitution expects 1 or 2 arguments"),
        ("$(eval f(1))", "No terminal matches '('"),
    ],
)
def test_malformed_substitutions_are_rejected(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        parse_substitution(text)


def test_quotes_of_the_other_kind_are_literal_within_quotes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("B", raising=False)
    XmlParser.load_launch_extensions()
    found = parse_substitution('$(env NO_A \'$(env NO_B "c") == "d e"\')')
    assert perform_substitutions(LaunchContext(), found) == '"c" == "d e"'


def test_param_substitution_falls_back_to_its_default() -> None:
    XmlParser.load_launch_extensions()
    context = LaunchContext()
    found = parse_substitution("$(param speed 1.5)")
    assert perform_substitutions(context, found) == "1.5"
    context.launch_configurations["global_params"] = [("speed", 2)]
    assert perform_substitutions(context, found) == "2"


def test_version_attribute_is_allowed() -> None:
    root, parser = XmlParser.load(io.StringIO('<launch version="0.1.0"><log message="x"/></launch>'))
    assert len(parser.parse_description(root).entities) == 1


def test_value_of_a_substitution_stays_one_word() -> None:
    words = parse_command_line("-a=$(var x)b c'd e'  $(var y)", XmlParser())
    assert [[each.describe() for each in word] for word in words] == [
        ["'-a='", "LaunchConfig('x')", "'b'"],
        ["'cd e'"],
        ["LaunchConfig('y')"],
    ]


FILES: list[tuple[str, str, list[str]]] = [
    (
        "x.launch.xml",
        "<launch><nodes/></launch>",
        [r"format \[xml\]:", r" - RuntimeError: Unrecognized entity of the type: nodes", r" - SyntaxError: .*"],
    ),
    (
        "x.launch.xml",
        "<launch>",
        [
            r"format \[xml\]:",
            r" - InvalidFrontendLaunchFileError: .* format \[xml\]:",
            r" - ParseError: no element found.*",
            r" - RuntimeError: Expected only one root",
            r" - SyntaxError: .*",
        ],
    ),
    ("x.launch.yaml", "other: []", [r"format \[yaml\]:", r" - RuntimeError: Expected 'launch' as root tag", r".*"]),
    (
        "x.launch.py",
        "x = 1",
        [
            r"format \[py\]:",
            r" - InvalidPythonLaunchFileError: launch file at '.*' does not contain the required function "
            r"'generate_launch_description\(\)'",
            r" - InvalidFrontendLaunchFileError: The launch file may have a syntax error, or its format is unknown",
        ],
    ),
    ("x.launch.py", "import no_such_module", [r"format \[py\]:", r" - ModuleNotFoundError: .*", r".*"]),
    ("x.launch.py", "def f(:", [r"format \[py\]:", r" - SyntaxError: .*", r".*"]),
]


@pytest.mark.parametrize(("name", "text", "patterns"), FILES, ids=[f"{row[0]} {row[1]}" for row in FILES])
def test_unreadable_files_are_reported_line_by_line(
    run_file: Launch, name: str, text: str, patterns: list[str]
) -> None:
    outcome = run_file(text, name)
    lines = outcome.caught.splitlines()
    assert outcome.code == 1
    assert len(lines) >= len(patterns)
    for line, pattern in zip(lines, patterns, strict=False):
        assert re.search(pattern + "$", line), (line, pattern)


def test_recursive_include_ends_with_recursion_error(run_file: Launch, tmp_path: Any) -> None:
    outcome = run_file('<launch><include file="$(dirname)/x.launch.xml"/></launch>', "x.launch.xml")
    assert outcome.code == 1
    assert "recursion" in outcome.caught


def test_sys_exit_in_a_launch_file_exits_the_program(run_file: Launch) -> None:
    with pytest.raises(SystemExit) as stop:
        run_file("import sys; sys.exit(7)")
    assert stop.value.code == 7


def test_too_deeply_nested_substitutions_are_rejected() -> None:
    with pytest.raises(ValueError, match="has too many substitutions in one another"):
        parse_substitution("$(var " * 5000)


def test_deep_call_stack_raises_recursion_error_not_a_parse_error() -> None:
    text = "$(var " * 15 + "name" + ")" * 15

    def below(frames: int) -> Any:
        return parse_substitution(text) if frames <= 0 else below(frames - 1)

    assert parse_substitution(text)
    with pytest.raises(RecursionError):
        below(sys.getrecursionlimit() - len(inspect.stack(0)) - 30)


XML = "<launch>\n<log message='caf\u00e9'/>\n</launch>\n"
ENCODED = [
    ("x.launch.xml", XML.encode("latin-1"), 2),
    ("x.launch.xml", b"<?xml version='1.0' encoding='latin-1'?>\n" + XML.encode("latin-1"), 3),
    ("x.launch.xml", b"<launch>\n" + b"<!-- long -->\n" * 2000 + b"<!-- \xe9 --></launch>", 2002),
    ("x.launch.yaml", "launch:\n\n- log: {message: \u00e9}\n".encode("cp1252"), 3),
    ("x.launch.yaml", "launch: []\n".encode("utf-16"), 1),
    ("x.launch.yml", "launch:\r\n# \u042f\n".encode("koi8-r"), 2),
]


@pytest.mark.parametrize(("name", "content", "line"), ENCODED)
def test_file_in_another_encoding_is_refused_with_its_line(
    run: Launch, tmp_path: Path, name: str, content: bytes, line: int
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    text = run([IncludeLaunchDescription(str(path))]).text
    assert f"line {line} is not in UTF-8, which launch files are: save it in that encoding" in text
