"""Saving parameters: ROS reads the values back, and nothing else in an existing file is lost."""

from __future__ import annotations

import os
import stat
from collections.abc import Mapping
from pathlib import Path

import pytest
import yaml
from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree, Value
from bot_console.tui.console.parameters.file.patch import new_text, patched, same
from bot_console.tui.console.parameters.file.saving import SaveResult, save
from bot_console.tui.files.save_file import NotSaved

FILE = """\
# indoor: slow and careful
robot_navigator:
  ros__parameters:
    max_speed: 1.0   # (m/s)
    robot_name: "Robo"
    gains:
      kp: 2.0
    waypoints:   # in m
      - 1.0  # the door
      - 2.0  # the window
    enable_safety: true
# the end
"""
ROBOT = "/robot_navigator"


def tree(node: str, **values: Value) -> ParameterTree:
    return ParameterTree(node, tuple(ParameterInfo(node, name, Kind.DOUBLE, value) for name, value in values.items()))


def read(text: str, node: str = "robot_navigator") -> Mapping[str, object]:
    return yaml.safe_load(text)[node]["ros__parameters"]


def test_only_the_changed_value_is_written() -> None:
    text = patched(FILE, {ROBOT: {"max_speed": 2.5, "robot_name": "Robo"}})
    assert text == FILE.replace("1.0   #", "2.5   #")


def test_comments_stay_behind_the_elements_of_a_list() -> None:
    assert patched(FILE, {ROBOT: {"waypoints": (1.0, 5.0)}}) == FILE.replace("- 2.0", "- 5.0")
    longer = FILE.replace("# the window\n", "# the window\n      - 3.0\n      - 4.0\n")
    assert patched(FILE, {ROBOT: {"waypoints": (1.0, 2.0, 3.0, 4.0)}}) == longer
    assert patched(FILE, {ROBOT: {"waypoints": (7.0,)}}) == FILE.replace("- 1.0", "- 7.0").replace(
        "      - 2.0  # the window\n", ""
    )


def test_missing_parameters_are_added_below_their_node() -> None:
    text = patched(FILE, {ROBOT: {"turn_rate": 0.5, "gains.kd": 0.1, "names": ("a", "b, c")}})
    new = '    turn_rate: 0.5\n    gains.kd: 0.1\n    names:\n    - a\n    - "b, c"\n'
    assert text == FILE.replace("# the end\n", new + "# the end\n")


def test_a_new_node_is_added_at_the_end() -> None:
    text = patched(FILE, {ROBOT: {"max_speed": 1.0, "last": 1}, "/safety_monitor": {"warning_distance": 1.0}})
    assert text == FILE.replace(
        "# the end\n", "    last: 1\n/safety_monitor:\n  ros__parameters:\n    warning_distance: 1.0\n# the end\n"
    )


def test_saving_writes_a_file_that_ros_reads(tmp_path: Path) -> None:
    path = tmp_path / "deep" / "file.yaml"
    assert save(
        path, {"/a": tree("/a", speed=1.0, use_sim_time=False), "/b": tree("/b", x=2.0)}, ("/a",)
    ) == SaveResult(1)
    assert path.read_text() == "/a:\n  ros__parameters:\n    speed: 1.0\n"
    assert [each.name for each in path.parent.iterdir()] == ["file.yaml"]


def test_values_that_no_parameter_file_can_hold_are_reported(tmp_path: Path) -> None:
    path = tmp_path / "file.yaml"
    data = ParameterInfo("/a", "data", Kind.BYTE_ARRAY, (b"\x01",))
    names = ParameterInfo("/a", "names", Kind.STRING_ARRAY, ())
    speed = ParameterInfo("/a", "speed", Kind.DOUBLE, 1.0)
    tiny = ParameterInfo("/a", "tiny", Kind.DOUBLE, 5e-324)
    saved = save(path, {"/a": ParameterTree("/a", (data, names, speed, tiny))})
    assert saved.text(path) == (
        f"1 parameter saved to {path}; left out: /a data is a byte array, which ROS parameter files cannot hold; "
        "left out: /a names is an empty array, to which ROS parameter files give no type; "
        "left out: /a tiny is too close to zero for the readers of ROS parameter files"
    )
    assert path.read_text() == "/a:\n  ros__parameters:\n    speed: 1.0\n"
    with pytest.raises(NotSaved, match="there are no parameters to save"):
        save(tmp_path / "other.yaml", {"/a": ParameterTree("/a", (data,))})
    assert not (tmp_path / "other.yaml").exists()


NODE = "robot_navigator:\n  ros__parameters:\n    "
KINDS: dict[str, tuple[str | bytes, str | bytes]] = {
    "empty": ("", f"/{NODE}max_speed: 2.5\n"),
    "only comments": ("# mine\n", f"# mine\n/{NODE}max_speed: 2.5\n"),
    "only comments, no line end": ("# mine", f"# mine\n/{NODE}max_speed: 2.5\n"),
    "a document start": (f"---\n{NODE}max_speed: 1.0\n", f"---\n{NODE}max_speed: 2.5\n"),
    "a document end": (f"{NODE}a: 1\n...\n", f"{NODE}a: 1\n    max_speed: 2.5\n...\n"),
    "a directive": (f"%YAML 1.1\n---\n{NODE}max_speed: 1.0\n", f"%YAML 1.1\n---\n{NODE}max_speed: 2.5\n"),
    "flow style": (
        "{robot_navigator: {ros__parameters: {a: 1, max_speed: 1.0}}}\n",
        "{robot_navigator: {ros__parameters: {a: 1, max_speed: 2.5}}}\n",
    ),
    "flow style without it": (
        "{other: {ros__parameters: {a: 1}}} # mine\n",
        "{other: {ros__parameters: {a: 1}}, /robot_navigator: {ros__parameters: {max_speed: 2.5}}} # mine\n",
    ),
    "a node in flow style": (
        "robot_navigator: {ros__parameters: {}} # mine\n",
        "robot_navigator: {ros__parameters: {max_speed: 2.5}} # mine\n",
    ),
    "an anchor": (f"{NODE}max_speed: &fast 1.0\n", f"{NODE}max_speed: 2.5\n"),
    "a block scalar": (
        f"{NODE}text: |\n      one # two\n      max_speed: 3\n    max_speed: 1.0\n",
        f"{NODE}text: |\n      one # two\n      max_speed: 3\n    max_speed: 2.5\n",
    ),
    "a block scalar at the end": (f"{NODE}text: >\n      one\n", f"{NODE}text: >\n      one\n    max_speed: 2.5\n"),
    "an empty value": (f"{NODE}max_speed:   # later\n", f"{NODE}max_speed: 2.5   # later\n"),
    "CRLF": (
        f"# a\n{NODE}max_speed: 1.0 # b\n".replace("\n", "\r\n").encode(),
        f"# a\n{NODE}max_speed: 2.5 # b\n".replace("\n", "\r\n").encode(),
    ),
    "CRLF, and something to add": (
        f"{NODE}a: 1\n".replace("\n", "\r\n").encode(),
        f"{NODE}a: 1\n    max_speed: 2.5\n".replace("\n", "\r\n").encode(),
    ),
    "a byte order mark": (f"{NODE}max_speed: 1.0\n".encode("utf-8-sig"), f"{NODE}max_speed: 2.5\n".encode("utf-8-sig")),
    "UTF-16": (f"{NODE}max_speed: 1.0\n".encode("utf-16"), f"{NODE}max_speed: 2.5\n".encode("utf-16")),
    "letters of four bytes": (
        f"# 🤖 ü\n{NODE}a: 🤖\n    max_speed: 1.0\n",
        f"# 🤖 ü\n{NODE}a: 🤖\n    max_speed: 2.5\n",
    ),
    "no line end": (f"{NODE}max_speed: 1.0", f"{NODE}max_speed: 2.5"),
    "no line end, and something to add": (f"{NODE}a: 1", f"{NODE}a: 1\n    max_speed: 2.5"),
    "namespaces": (
        "/:\n  robot_navigator:\n    ros__parameters:\n      max_speed: 1.0\n",
        "/:\n  robot_navigator:\n    ros__parameters:\n      max_speed: 2.5\n",
    ),
    "a wildcard": (
        "/**:\n  ros__parameters:\n    max_speed: 1.0\n",
        f"/**:\n  ros__parameters:\n    max_speed: 1.0\n/{NODE}max_speed: 2.5\n",
    ),
    "the node twice": (
        f"{NODE}max_speed: 1.0\n/{NODE}max_speed: 1.5\n",
        f"{NODE}max_speed: 1.0\n/{NODE}max_speed: 2.5\n",
    ),
    "another type": (f"{NODE}max_speed: '2.5'\n", f"{NODE}max_speed: 2.5\n"),
    "the same value": (f"{NODE}max_speed: 25e-1\n", f"{NODE}max_speed: 25e-1\n"),
}

REFUSED: dict[str, tuple[str | bytes, str]] = {
    "plain text": ("Milk, bread\nand butter\n", "it contains only text"),
    "Python": ("import rclpy\n\ndef main():\n    rclpy.init()\n", "line 3: not YAML"),
    "a list": ("- 1\n- 2\n", "it contains a list"),
    "a scalar": ("42\n", "it contains only text"),
    "another YAML": ("version: 3\nservices: {}\n", "line 1: 'version' is not a parameter"),
    "a map of maps": ("a: {b: {}}\n", "it sets nothing"),
    "one underscore": ("a:\n  ros_parameters:\n    x: 1\n", "two underscores"),
    "no node": ("ros__parameters:\n  x: 1\n", "no node name"),
    "an alias": (f"{NODE}a: &x 1\n    b: *x\n", r"line 4: there is an alias \(\*x\)"),
    "a cyclic alias": ("a: &a\n  ros__parameters: *a\n", "line 2: there is an alias"),
    "billion laughs": ("a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n", "line 2: there is an alias"),
    "a merge": (f"base: &b\n  x: 1\n{NODE}<<: *b\n", "an alias"),
    "a sequence as key": (f"{NODE}? [a, b]\n    : 1\n", "line 3: a key has to be a name"),
    "another empty value": (f"{NODE}a:\n", "line 3: a has no value"),
    "no parameters": ("robot_navigator:\n  ros__parameters:\n", "line 2: there are no 'name: value' lines"),
    "a name twice": (f"{NODE}a: 1\n    a: 2\n", "line 4: 'a' appears for the second time"),
    "a name twice, dotted": (f"{NODE}a: {{b: 1}}\n    a.b: 2\n", "line 4: 'a.b' appears for the second time"),
    "a list in a list": (f"{NODE}a: [[1], [2]]\n", "line 3: a contains a list or a mapping in a list"),
    "a mixed list": (f"{NODE}a: [1, x]\n", "line 3: the elements of a are not of one type"),
    "two documents": (f"{NODE}a: 1\n---\n{NODE}a: 2\n", "line 4: a second document"),
    "broken": ("a: [", "not YAML"),
    "a tab": ("a:\n\tros__parameters:\n", "line 2: not YAML"),
    "a NUL": ("a: 1\0\n", "not YAML: .*characters are not allowed"),
    "bytes": (b"\x89PNG\r\n\x1a\n\0\0", "it is not a text file"),
    "Latin-1": ("# für\n".encode("latin-1"), "it is not a text file"),
    "deep": ("[" * 1000, "not YAML|too deeply"),
    "a wildcard behind it": (
        f"{NODE}a: 1\n/**:\n  ros__parameters:\n    max_speed: 1.0\n",
        r"/robot_navigator would get the max_speed that is below '/\*\*'",
    ),
}


def as_bytes(content: str | bytes) -> bytes:
    return content if isinstance(content, bytes) else content.encode()


@pytest.mark.parametrize("kind", KINDS)
def test_a_valid_file_is_patched_with_the_value(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "file.yaml"
    path.write_bytes(as_bytes(KINDS[kind][0]))
    save(path, {ROBOT: tree(ROBOT, max_speed=2.5)})
    assert path.read_bytes() == as_bytes(KINDS[kind][1])


@pytest.mark.parametrize("kind", REFUSED)
def test_an_invalid_file_is_refused_and_stays_unchanged(kind: str, tmp_path: Path) -> None:
    content, why = REFUSED[kind]
    path = tmp_path / "file.txt"
    path.write_bytes(as_bytes(content))
    (tmp_path / "file-parameters.yaml").touch()
    with pytest.raises(NotSaved, match=why) as caught:
        save(path, {ROBOT: tree(ROBOT, max_speed=2.5)})
    assert path.read_bytes() == as_bytes(content)
    assert str(caught.value).endswith(f"give another name, such as {tmp_path / 'file-parameters2.yaml'}")
    assert len(str(caught.value).splitlines()) == 1
    assert len(list(tmp_path.iterdir())) == 2


def test_a_refused_file_with_a_name_of_maximum_length_suggests_a_shorter_one(tmp_path: Path) -> None:
    path = tmp_path / f"{'n' * 250}.yaml"
    path.write_text("- 1\n")
    with pytest.raises(NotSaved, match=r"it contains a list; .* give another name, such as a shorter one$"):
        save(path, {ROBOT: tree(ROBOT, max_speed=2.5)})
    assert path.read_text() == "- 1\n"


@pytest.mark.skipif(os.name != "posix", reason="needs POSIX permissions and links")
def test_link_and_mode_of_a_patched_file_are_kept(tmp_path: Path) -> None:
    real, link = tmp_path / "real.yaml", tmp_path / "link.yaml"
    real.write_text(FILE)
    real.chmod(0o640)
    link.symlink_to("real.yaml")
    save(link, {ROBOT: tree(ROBOT, max_speed=2.5)})
    assert link.is_symlink()
    assert stat.S_IMODE(real.stat().st_mode) == 0o640
    assert read(real.read_text())["max_speed"] == 2.5


def test_ambiguous_text_is_written_in_quotes() -> None:
    texts = (
        "1",
        "yes",
        "null",
        "1e3",
        "2020-01-01",
        "~",
        "",
        "a: b",
        "#",
        "inf",
        ".nan",
        "infinity",
        "0x1",
        "a\nb",
        "'",
        '"',
    )
    data = yaml.safe_load(new_text({"/a": {"texts": texts, "1": 1, "a.b": 1, "a.b.c": 2, "x..y": 3, "-": 4}}))
    below = data["/a"]["ros__parameters"]
    assert below.pop("texts") == list(texts)
    assert below == {"1": 1, "a": {"b": 1}, "a.b.c": 2, "x..y": 3, "-": 4}


def test_values_are_equal_only_with_the_same_type() -> None:
    assert same(float("nan"), float("nan")) and same((1.0, float("inf")), (1.0, float("inf")))
    assert not same(1, 1.0) and not same(True, 1) and not same((1,), (1.0,)) and not same((), None)
