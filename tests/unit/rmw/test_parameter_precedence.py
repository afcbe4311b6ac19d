"""Parameter files and `-p` values: types, structure, node keys, order, error messages. Rows of the rcl contract."""

import math
from pathlib import Path
from typing import Any

import pytest
from bot_console.runtime.rmw.parameter_node_keys import key_matches
from bot_console.runtime.rmw.parameter_precedence import ParameterTable, ParameterYamlError
from bot_console.runtime.rmw.parameter_value import read_parameter_value

NAN = "nan"


def by_word(text: str) -> Any:
    table = ParameterTable()
    table.add_value("/**", "v", text)
    return table.for_node("/n")["v"]


def by_file(tmp_path: Path, content: str, node: str = "/n", *more: str) -> dict[str, Any]:
    table = ParameterTable()
    for number, each in enumerate((content, *more)):
        path = tmp_path / f"{number}.yaml"
        path.write_bytes(each.encode())
        table.add_file(str(path))
    return table.for_node(node)


SCALARS: dict[str, Any] = {
    **dict.fromkeys(("true", "True", "TRUE", "yes", "Yes", "YES", "y", "Y", "on", "On", "ON"), True),
    **dict.fromkeys(("false", "False", "FALSE", "no", "No", "NO", "n", "N", "off", "Off", "OFF"), False),
    "tRue": "tRue",
    "1": 1,
    "+5": 5,
    "-0": 0,
    "0x10": 16,
    "-0xFF": -255,
    "010": 8,
    "0": 0,
    "9223372036854775807": 2**63 - 1,
    "-9223372036854775808": -(2**63),
    "9223372036854775808": 2.0**63,
    "0x8000000000000000": 2.0**63,
    "1.0": 1.0,
    ".5": 0.5,
    "1.": 1.0,
    "-.5": -0.5,
    "1e3": 1000.0,
    "1.0e3": 1000.0,
    "1E-3": 0.001,
    "08": 8.0,
    "0x1p3": 8.0,
    "0x.8": 0.5,
    "inf": math.inf,
    "-Infinity": -math.inf,
    ".inf": math.inf,
    "+.Inf": math.inf,
    "-.INF": -math.inf,
    ".iNF": ".iNF",
    ".nan": NAN,
    "nan": NAN,
    "NaN": NAN,
    "-.nan": "-.nan",
    "1e400": "1e400",
    "1e-400": "1e-400",
    "0x1p9999": "0x1p9999",
    "0e0": 0.0,
    "1_000": "1_000",
    "0o17": "0o17",
    "0b11": "0b11",
    "0x": "0x",
    "1.2.3": "1.2.3",
    "12:30:45": "12:30:45",
    "2024-01-01": "2024-01-01",
    "null": "null",
    "~": "~",
    "hello world": "hello world",
    '"5"': "5",
    "'true'": "true",
    '""': "",
    "!!str 5": "5",
    "!!float 5": 5,
    "&x 5": 5,
    "5 ": 5,
    "# c": None,
    "[]": None,
    "[1, 2]": [1, 2],
    "[1.0, .inf]": [1.0, math.inf],
    "[a, b]": ["a", "b"],
    "[true, no]": [True, False],
    '["1", "2"]': ["1", "2"],
    "[[1, 2]]": [1, 2],
    "[1, [2]]": [2],
    "[[1], [2, 3]]": [2, 3],
}


@pytest.mark.parametrize("text", SCALARS)
def test_values_are_typed_as_in_rcl(text: str) -> None:
    expected, found = SCALARS[text], by_word(text)
    if expected == NAN:
        assert isinstance(found, float)
        assert math.isnan(found)
    else:
        assert (type(found), found) == (type(expected), expected)


WORD_ERRORS = {
    "": "error not set",
    "''x": "Error parsing an event",
    "@foo": "Error parsing an event",
    "...": "Error parsing an event",
    "-": "No value at line 1",
    "`x": "Error parsing an event",
    "%x": "Error parsing an event",
    '"x': "Error parsing an event",
    "\tx": "Error parsing an event",
    "a: b": "Unknown YAML event",
    "{a: 1}": "Unknown YAML event",
    "[{a: 1}]": "Unknown YAML event",
    "*x": "Unknown YAML event",
    "[1, 2.0]": "Sequence should be of same type. Value type 'double' do not belong at line_num 1",
    "[1.0, true]": "Sequence should be of same type. Value type 'bool' do not belong at line_num 1",
    "[null, 1]": "Sequence should be of same type. Value type 'integer' do not belong at line_num 1",
    "[1, x]": "Sequence should be of same type. Value type 'string' do not belong at line_num 1",
}


@pytest.mark.parametrize("text", WORD_ERRORS)
def test_invalid_values_are_rejected(text: str) -> None:
    with pytest.raises(ParameterYamlError) as refused:
        by_word(text)
    assert str(refused.value) == WORD_ERRORS[text]


def section(body: str, key: str = "n") -> str:
    return f"{key}:\n  ros__parameters:\n{body}"


FILES: dict[str, tuple[str, dict[str, Any]]] = {
    "nested maps": (section("    a:\n      b:\n        c: 1\n      d: 2\n    e: 3\n"), {"a.b.c": 1, "a.d": 2, "e": 3}),
    "dots": (section("    a.b: 1\n"), {"a.b": 1}),
    "dots and maps": (section("    a.b:\n      c: 1\n    d: 2\n"), {"a.b.c": 1, "d": 2}),
    "prefix of the keyword": ("n:\n  ros__parametersX:\n    a: 1\n", {"a": 1}),
    "block list": (section("    a:\n      - 1\n      - 2\n"), {"a": [1, 2]}),
    "map in a list": (section("    a: [{x: 1}]\n"), {"a.x": [1]}),
    "map as value": (section("    v: {a: 1}\n"), {"v.a": 1}),
    "empty list": (section("    a: []\n"), {"a": None}),
    "empty text": ("", {}),
    "only a comment": ("# nothing\n", {}),
    "only a scalar": ("5\n", {}),
    "no parameters": ("n: {ros__parameters: {}}\n", {}),
    "another node": (section("    a: 1\n", "m"), {}),
    "two documents": (section("    a: 1\n") + "---\n" + section("    b: 2\n"), {"a": 1, "b": 2}),
    "key twice": (section("    a: 1\n    a: 2\n"), {"a": 2}),
    "key twice, types differ": (section("    a: 1\n    a: text\n"), {"a": 1}),
    "bool before text": (section("    a: text\n    a: true\n"), {"a": True}),
    "scalar before list": (section("    a: [1]\n    a: text\n"), {"a": "text"}),
    "node twice": (section("    a: 1\n") + section("    b: 2\n"), {"a": 1, "b": 2}),
    "flow": ("{n: {ros__parameters: {a: 1, b: [1, 2]}}}\n", {"a": 1, "b": [1, 2]}),
    "names of any kind": (section("    a-b: 1\n    5: 2\n    a b: 3\n"), {"a-b": 1, "5": 2, "a b": 3}),
    "unicode": (section('    a: "grün ✓"\n'), {"a": "grün ✓"}),
    "tags are ignored": (section("    a: !!binary aGk=\n"), {"a": "aGk="}),
    "literal text": (section("    a: |\n      5\n"), {"a": "5\n"}),
    "anchor alone": (section("    a: &x 5\n"), {"a": 5}),
}


@pytest.mark.parametrize("case", FILES)
def test_files_are_read_as_in_rcl(case: str, tmp_path: Path) -> None:
    content, expected = FILES[case]
    assert by_file(tmp_path, content) == expected


FILE_ERRORS = {
    "wrong keyword": ("n:\n  ros_parameters:\n    a: 1\n", "Cannot have a value before ros__parameters at line 3"),
    "no keyword": ("n:\n  x: 1\n", "Cannot have a value before ros__parameters at line 2"),
    "nothing below": ("n:\n  ros__parameters:\n", "Cannot have a value before ros__parameters at line 2"),
    "scalar below": ("n:\n  ros__parameters: 5\n", "Cannot have a value before ros__parameters at line 2"),
    "list below": ("n:\n  ros__parameters: [5]\n", "Cannot have a value before ros__parameters at line 2"),
    "no node": ("ros__parameters:\n  a: 1\n", "There are no node names before ros__parameters at line 1"),
    "no value": (section("    speed:\n"), "No value at line 3"),
    "no key": (section('    "": 1\n'), "No key at line 3"),
    "mixed list": (
        section("    a: [1, 2.0]\n"),
        "Sequence should be of same type. Value type 'double' do not belong at line_num 3",
    ),
    "list of lists": (section("    a: [[1], [2]]\n"), "Sequences cannot be key at line 3"),
    "list as key": (section("    [1]: 2\n"), "Sequences cannot be key at line 3"),
    "list at the top": ("- a\n- b\n", "Sequences cannot be key at line 1"),
    "alias": (section("    a: &x 5\n    b: *x\n"), "Will not support aliasing at line 4\n"),
    "syntax": (section("    a: @x\n"), "Error parsing a event near line 3"),
    "tab": (section("\ta: 1\n"), "Error parsing a event near line 2"),
    "node below parameters": (
        section("    a: 1\n  child:\n    ros__parameters:\n      b: 2\n"),
        "Internal error creating param namespace at line 6",
    ),
    "node name with a dash": (
        section("    a: 1\n", "my-node"),
        "node name must not contain characters other than alphanumerics or '_'",
    ),
    "node name with a digit": (section("    a: 1\n", "1n"), "node name must not start with a number"),
    "namespace with a dash": (
        section("    a: 1\n", "/a-b/n"),
        "namespace must not contain characters other than alphanumerics, '_', or '/'",
    ),
    "repeated slash": (section("    a: 1\n", "/a//n"), "/a// contains repeated forward slash"),
    "wildcard in a token": (
        section("    a: 1\n", "/n*"),
        "node name must not contain characters other than alphanumerics or '_'",
    ),
    "three stars": (
        section("    a: 1\n", "/***"),
        "node name must not contain characters other than alphanumerics or '_'",
    ),
}


@pytest.mark.parametrize("case", FILE_ERRORS)
def test_invalid_files_are_rejected(case: str, tmp_path: Path) -> None:
    content, expected = FILE_ERRORS[case]
    with pytest.raises(ParameterYamlError) as refused:
        by_file(tmp_path, content)
    assert str(refused.value) == expected


@pytest.mark.parametrize(
    ("content", "hint"),
    [
        (section("\ta: 1\n"), ":3: it is indented by a tab, and YAML takes spaces alone"),
        (section("    a: @x\n"), ":3: found character"),
        ("n:\n  ros_parameters:\n    a: 1\n", ":2: ros_parameters has one underscore, ros__parameters has two"),
        (section("    [1]: 2\n"), ""),
    ],
)
def test_hint_explains_what_rcl_does_not_report(content: str, hint: str, tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text(content)
    with pytest.raises(ParameterYamlError) as refused:
        ParameterTable().add_file(str(path))
    assert refused.value.hint.startswith(f"{path}{hint}") if hint else refused.value.hint == ""


def test_unreadable_file_is_rejected(tmp_path: Path) -> None:
    with pytest.raises(ParameterYamlError, match=r"^Error opening YAML file$"):
        ParameterTable().add_file(str(tmp_path / "none.yaml"))
    with pytest.raises(ParameterYamlError, match=r"^Error parsing a event near line 0$"):
        ParameterTable().add_file(str(tmp_path))


@pytest.mark.parametrize("name", ["a\0b.yaml", "half \ud800.yaml"])
def test_impossible_file_name_is_rejected(name: str, tmp_path: Path) -> None:
    with pytest.raises(ParameterYamlError, match=r"^Error opening YAML file$"):
        ParameterTable().add_file(str(tmp_path / name))


@pytest.mark.parametrize("text", ["[half \ud800]", "'half \ud800'"])
def test_value_with_a_lone_surrogate_is_rejected(text: str) -> None:
    with pytest.raises(ParameterYamlError, match=r"^Error parsing an event$"):
        read_parameter_value(text, {})


MATCHES = {
    "/**": {"/a": True, "/x/y/a": True},
    "**": {"/a": True, "/x/a": True},
    "/*": {"/a": True, "/ns/a": False},
    "*": {"/a": True, "/ns/a": False},
    "a": {"/a": True, "/ns/a": False, "/ab": False},
    "/a": {"/a": True, "/A": False},
    "/**/a": {"/a": True, "/x/y/a": True, "/x/b": False},
    "/ns/*": {"/ns/a": True, "/ns/x/a": False, "/ns": False},
    "/ns/**": {"/ns": True, "/ns/a": True, "/ns/x/a": True, "/a": False, "/nsa": False},
    "/*/a": {"/x/a": True, "/x/y/a": False, "/a": False},
    "/**/foo/*/bar/n": {"/a/b/foo/d/bar/n": True, "/foo/d/bar/n": True, "/foo/bar/n": False},
    "/a//n": {"/a/n": False},
}


@pytest.mark.parametrize("key", MATCHES)
def test_node_keys_match_as_in_rcl(key: str) -> None:
    assert {name: key_matches(key, name) for name in MATCHES[key]} == MATCHES[key]


def test_nested_namespaces_and_trailing_slash_are_accepted(tmp_path: Path) -> None:
    assert by_file(tmp_path, "a:\n  b:\n    n:\n      ros__parameters:\n        x: 1\n", "/a/b/n") == {"x": 1}
    assert by_file(tmp_path, "/a/:\n  n:\n    ros__parameters:\n      x: 1\n", "/a/n") == {"x": 1}


def two(first: str, second: str) -> str:
    return section("    a: 1\n    only1: 1\n", first) + section("    a: 2\n    only2: 2\n", second)


@pytest.mark.parametrize(
    ("first", "second", "expected"), [("/n", "/**", 2), ("/**", "/n", 2), ("n", "/n", 2), ("/n", "n", 2)]
)
def test_later_key_takes_precedence_however_exact(first: str, second: str, expected: int, tmp_path: Path) -> None:
    assert by_file(tmp_path, two(first, second)) == {"a": expected, "only1": 1, "only2": 2}


def test_key_keeps_its_first_position(tmp_path: Path) -> None:
    wild, exact = section("    a: 1\n", "/**"), section("    a: 2\n")
    assert by_file(tmp_path, wild, "/n", exact)["a"] == 2
    assert by_file(tmp_path, exact, "/n", wild)["a"] == 1
    assert by_file(tmp_path, wild + exact, "/n", section("    a: 3\n", "/**"))["a"] == 2


ORDER: dict[str, tuple[list[tuple[str, str]], Any]] = {
    "type change keeps the bool": ([("/**", "true"), ("/**", "5")], True),
    "int before text": ([("/**", "text"), ("/**", "5")], 5),
    "list after scalar": ([("/**", "5"), ("/**", "[1, 2]")], 5),
    "empty list after list": ([("/**", "[1, 2]"), ("/**", "[]")], [1, 2]),
    "another list": ([("/**", "[1, 2]"), ("/**", "[3]")], [3]),
    "node after all": ([("/**", "1"), ("n", "2")], 2),
    "all after node": ([("n", "2"), ("/**", "1")], 1),
}


@pytest.mark.parametrize("case", ORDER)
def test_last_value_takes_precedence(case: str) -> None:
    given, expected = ORDER[case]
    table = ParameterTable()
    for key, text in given:
        table.add_value(key, "v", text)
    assert table.for_node("/n")["v"] == expected


def test_each_node_gets_its_own_list() -> None:
    table = ParameterTable()
    table.add_value("/**", "v", "[1, 2]")
    table.for_node("/n")["v"].append(3)
    assert table.for_node("/m")["v"] == [1, 2]
