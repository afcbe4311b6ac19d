"""`ros2 param` with nodes written in the test."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent

import pytest

NODE = """
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
node = Node('tuned')
limits = FloatingPointRange(from_value=0.5, to_value=2.0, step=0.5)
node.declare_parameter('gain', 1.0, ParameterDescriptor(description='Gain', floating_point_range=[limits]))
whole = IntegerRange(from_value=0, to_value=9)
node.declare_parameter('count', 3, ParameterDescriptor(integer_range=[whole], additional_constraints='odd'))
node.declare_parameter('fixed', 'x', ParameterDescriptor(read_only=True))
node.declare_parameter('a.b.c', True)
node.declare_parameter('list', [1, 2])
node.declare_parameter('doubles', [1.0, 2.5])
node.declare_parameter('words', ['a', 'b c'])
node.declare_parameter('free', None, ParameterDescriptor(dynamic_typing=True))
"""
LISTED = ["a.b.c", "count", "doubles", "fixed", "free", "gain", "list", "start_type_description_service",
          "use_sim_time", "words"]  # fmt: skip


def test_list_shows_parameters_of_all_nodes_or_one(ros) -> None:
    ros.node(NODE)
    ros.node("node = Node('plain', namespace='ns')")
    own = "\n".join(f"  {each}" for each in LISTED)
    both = f"/ns/plain:\n  start_type_description_service\n  use_sim_time\n/tuned:\n{own}\n"
    assert sorted(ros.ask("param", "list").stdout.splitlines()) == sorted(both.splitlines())
    assert ros.ask("param", "list", "tuned").stdout == f"{own}\n"
    assert ros.ask("param", "list", "/tuned", "--param-prefixes", "a.b").stdout == "  a.b.c\n"
    assert ros.ask("param", "list", "/tuned", "--filter", "^(gain|count)$", "--param-type").stdout == (
        "  count (type: integer)\n  gain (type: double)\n"
    )


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("gain", "Double value is: 1.0"),
        ("count", "Integer value is: 3"),
        ("fixed", "String value is: x"),
        ("a.b.c", "Boolean value is: True"),
        ("list", "Integer values are: [1, 2]"),
        ("doubles", "Double values are: [1.0, 2.5]"),
        ("words", "String values are: ['a', 'b c']"),
        ("free", "Parameter not set."),
    ],
)
def test_get_prints_type_and_value(ros, name: str, shown: str) -> None:
    ros.node(NODE)
    assert ros.ask("param", "get", "/tuned", name).stdout == f"{shown}\n"


@pytest.mark.parametrize(
    ("name", "value", "refusal"),
    [
        ("gain", "1.5", ""),
        ("gain", "0.7", "The parameter value for gain is not close enough to a valid step. Min: 0.5, max: 2.0, "
                        "value: 0.7, step: 0.5"),
        ("gain", "3.0", "Parameter gain out of range Min: 0.5, Max: 2.0, value: 3.0"),
        ("gain", "1", "Wrong parameter type, expected 'Type.DOUBLE' got 'Type.INTEGER'"),
        ("count", "10", "Parameter count out of range. Min: 0, Max: 9, value: 10"),
        ("fixed", "y", "Trying to set a read-only parameter: fixed."),
        ("list", "[4, 5]", ""),
        ("words", "[c, d]", ""),
        ("free", "7", ""),
        ("free", "seven", ""),
    ],
)  # fmt: skip
def test_set_reports_success_or_refusal(ros, name: str, value: str, refusal: str) -> None:
    ros.node(NODE)
    answer = ros.ask("param", "set", "/tuned", name, value)
    assert answer.exit == 0
    if refusal:
        assert (answer.stdout, answer.stderr) == ("", f"Setting parameter failed: {refusal}\n")
    else:
        assert (answer.stdout, answer.stderr) == ("Set parameter successful\n", "")


def test_negative_numbers_need_no_quotes(ros) -> None:
    ros.node("node = Node('n')\nnode.declare_parameter('x', 1.0)\nnode.declare_parameter('i', 1)")
    ros.ask("param", "set", "/n", "x", "-1.5")
    ros.ask("param", "set", "/n", "i", "-4")
    assert ros.ask("param", "get", "/n", "x", "--hide-type").stdout == "-1.5\n"
    assert ros.ask("param", "get", "/n", "i", "--hide-type").stdout == "-4\n"


def test_describe_prints_type_description_and_constraints(ros) -> None:
    ros.node(NODE)
    assert ros.ask("param", "describe", "/tuned", "gain", "count", "fixed", "free").stdout == dedent("""\
        Parameter name: gain
          Type: double
          Description: Gain
          Constraints:
            Min value: 0.5
            Max value: 2.0
            Step: 0.5
        Parameter name: count
          Type: integer
          Constraints:
            Min value: 0
            Max value: 9
            Additional constraints: odd
        Parameter name: fixed
          Type: string
          Constraints:
            Read only: true
        Parameter name: free
          Type: not set
          Constraints:
        """)


def test_dumped_file_can_be_loaded(ros, tmp_path: Path) -> None:
    ros.node(NODE)
    ros.ask("param", "delete", "/tuned", "free")
    dumped = ros.ask("param", "dump", "/tuned").stdout
    assert dumped.startswith("/tuned:\n  ros__parameters:\n    a:\n      b:\n        c: true\n    count: 3\n")
    assert dumped.endswith("    - b c\n\n")
    file = tmp_path / "tuned.yaml"
    file.write_text(dumped.replace("gain: 1.0", "gain: 2.0"), "utf-8")
    loaded = ros.ask("param", "load", "/tuned", str(file))
    assert "Set parameter gain successful\n" in loaded.stdout
    assert "Set parameter fixed failed: Trying to set a read-only parameter: fixed.\n" in loaded.stderr
    assert loaded.exit == 0
    assert ros.ask("param", "get", "/tuned", "gain").stdout == "Double value is: 2.0\n"


def test_delete_refuses_static_parameters(ros) -> None:
    ros.node(NODE)
    ros.ask("param", "set", "/tuned", "free", "1")
    assert ros.ask("param", "delete", "/tuned", "free").stdout == "Deleted parameter successfully\n"
    refused = ros.ask("param", "delete", "/tuned", "gain")
    assert (refused.exit, refused.stderr) == (0, "Deleting parameter failed: Static parameter cannot be undeclared\n")


def test_load_applies_wildcard_sections_by_default(ros, tmp_path: Path) -> None:
    ros.node(NODE)
    file = tmp_path / "all.yaml"
    file.write_text("/**:\n  ros__parameters:\n    gain: 0.5\n", "utf-8")
    assert ros.ask("param", "load", "/tuned", str(file)).stdout == "Set parameter gain successful\n"
    without = ros.ask("param", "load", "/tuned", str(file), "--no-use-wildcard")
    assert (without.exit, without.stderr) == (1, "Param file does not contain selected parameters\n")
    nowhere = ros.ask("param", "load", "/tuned", str(tmp_path / "none.yaml"))
    assert (nowhere.exit, nowhere.stderr) == (1, f"{tmp_path}/none.yaml: No such file or directory\n")


@pytest.mark.parametrize("verb", [["get"], ["describe"], ["delete"], ["set", "x"]])
def test_late_node_is_waited_for_until_timeout(ros, verb: list[str]) -> None:
    late = ros.ros2("param", verb[0], "/late", "x", *verb[1:], "--timeout", "3")
    ros.run(1.0)
    assert late.exit is None
    ros.node("node = Node('late')\nnode.declare_parameter('x', 'y')")
    assert ros.finish(late).exit == 0
    missing = ros.ask("param", verb[0], "/nobody", "x", *verb[1:])
    assert (missing.exit, missing.stderr) == (1, "Node not found\n")


def test_hidden_nodes_are_included_on_request(ros) -> None:
    ros.node("node = Node('_hidden')\nnode.declare_parameter('x', 1)")
    assert ros.ask("param", "get", "/_hidden", "x").stderr == "Node not found\n"
    assert ros.ask("param", "get", "/_hidden", "x", "--include-hidden-nodes").stdout == "Integer value is: 1\n"
    assert ros.ask("param", "list").stdout == ""


def test_refusal_by_a_callback_is_reported(ros) -> None:
    ros.node("""
from rcl_interfaces.msg import SetParametersResult
node = Node('strict')
node.declare_parameter('x', 1)
node.add_on_set_parameters_callback(lambda parameters: SetParametersResult(successful=False, reason='never'))
""")
    assert ros.ask("param", "set", "/strict", "x", "2").stderr == "Setting parameter failed: never\n"
    assert ros.ask("param", "get", "/strict", "x", "--hide-type").stdout == "1\n"


def test_node_that_ends_in_its_callback_is_reported(ros) -> None:
    node = ros.node("""
node = Node('careless')
node.declare_parameter('x', 1)
node.add_on_set_parameters_callback(lambda parameters: 1 / 0)
""")
    asked = ros.ask("param", "set", "/careless", "x", "2", stop_after=20.0)
    assert (asked.exit, asked.stdout) == (1, "")
    assert "/careless" in asked.stderr and "ended" in asked.stderr
    assert node.exit == 1
    assert "ZeroDivisionError: division by zero\n" in node.stderr
    assert ros.ask("node", "list").stdout == ""


@pytest.mark.filterwarnings("ignore:Callback returned", "ignore:coroutine")
@pytest.mark.parametrize("result", ["None", "True", "[SetParametersResult(successful=True)]", "wait()"])
def test_invalid_callback_result_refuses_the_set_and_node_survives(ros, result: str) -> None:
    node = ros.node(f"""
from rcl_interfaces.msg import SetParametersResult
async def wait(): return SetParametersResult(successful=True)
node = Node('careless')
node.declare_parameter('x', 1)
node.add_on_set_parameters_callback(lambda parameters: {result})
""")
    asked = ros.ask("param", "set", "/careless", "x", "2")
    assert asked.stderr == "Setting parameter failed: Callback returned an invalid type\n"
    assert ros.ask("param", "get", "/careless", "x", "--hide-type").stdout == "1\n"
    assert node.exit is None


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("9" * 30, "must be an integer in [-9223372036854775808, 9223372036854775807]"),
        ("0x" + "f" * 5000, "(which cannot be written)"),
        ("!!timestamp x", "The passed value is not valid YAML"),
        ("!!int", "The passed value is not valid YAML"),
    ],
    ids=["long", "endless", "timestamp", "empty tag"],
)
def test_unsupported_value_is_refused_on_one_line(ros, tmp_path, value, words) -> None:
    ros.node(NODE)
    given = ros.ask("param", "set", "/tuned", "count", value)
    assert given.exit == 1
    assert words in given.stderr
    assert given.stderr.count("\n") == 1


@pytest.mark.parametrize(
    "value",
    ["9" * 30, "0x" + "f" * 5000, "!!int", "!!timestamp x"],
    ids=["long", "endless", "empty tag", "timestamp"],
)
def test_file_with_unsupported_value_is_refused_on_one_line(ros, tmp_path, value) -> None:
    ros.node(NODE)
    (tmp_path / "a.yaml").write_text(f"/**:\n  ros__parameters:\n    count: {value}\n")
    given = ros.ask("param", "load", "/tuned", str(tmp_path / "a.yaml"))
    assert given.exit == 1
    assert "a.yaml: " in given.stderr
    assert given.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "not a parameter file"),
        (b"42\n", "not a parameter file"),
        (b"- a\n- b\n", "not a parameter file"),
        (b"Dear diary\n", "not a parameter file"),
        (b"/tuned:\n  ros__parameters:\n", "not a parameter file"),
        (b"/tuned:\n  ros__parameters:\n    1: 2\n", "not a parameter file"),
        (b"a: 1\n---\na: 2\n", "not YAML: line 2: but found another document"),
        (b"? [a]\n: 1\n", "not YAML: line 1: found unhashable key"),
        (b"/tuned:\n  ros__parameters:\n    name: !!python/name:os.system\n", "not YAML: line 3: could not determine"),
        (b"a: \0\n", "not YAML: special characters are not allowed"),
        (b"/tuned: M\xfcller\n", "not UTF-8 text"),
        (b"[" * 1000, "nested too deeply"),
        (b"/tuned:\n  ros__parameters: &a\n    name: *a\n", "contains itself"),
        (b"/tuned:\n  ros__parameters:\n    name: 'a: b: c'\n", "a string in it, which ROS parses as YAML again"),
    ],
    ids=lambda value: value[:30] if isinstance(value, str) else "",
)
def test_file_without_parameters_is_refused_on_one_line(ros, tmp_path, content, words) -> None:
    ros.node(NODE)
    (tmp_path / "a.yaml").write_bytes(content)
    given = ros.ask("param", "load", "/tuned", str(tmp_path / "a.yaml"))
    assert given.exit == 1
    assert given.stderr.startswith(f"{tmp_path}/a.yaml: ")
    assert words in given.stderr
    assert given.stderr.count("\n") == 1
