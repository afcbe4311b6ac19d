"""Saving: the true ROS format, and a patch that leaves every other line alone."""

from pathlib import Path

import pytest
import yaml
from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree, Value
from bot_console.tui.console.parameter_file import dumped, patched, save
from hypothesis import given
from hypothesis import strategies as st

FILE = """\
# indoor: slow and careful
robot_navigator:
  ros__parameters:
    max_speed: 1.0   # (m/s)
    robot_name: "Robo"
    gains:
      kp: 2.0
    waypoints:
      - 1.0
      - 2.0
    enable_safety: true
"""


def tree(node: str, **values: Value) -> ParameterTree:
    return ParameterTree(node, tuple(ParameterInfo(node, name, Kind.DOUBLE, value) for name, value in values.items()))


def test_only_the_changed_value_is_written() -> None:
    text = patched(FILE, {"/robot_navigator": {"max_speed": 2.5, "robot_name": "Robo"}})
    assert text == FILE.replace("1.0   #", "2.5   #")


def test_nested_names_and_sequences() -> None:
    text = patched(FILE, {"/robot_navigator": {"gains.kp": 3.0, "waypoints": (4.0, 5.0)}})
    data = yaml.safe_load(text)["robot_navigator"]["ros__parameters"]
    assert data["gains"] == {"kp": 3.0}
    assert data["waypoints"] == [4.0, 5.0]
    assert data["enable_safety"] is True
    assert text.startswith("# indoor")


def test_a_new_node_is_added_and_a_missing_line_is_named() -> None:
    text = patched(FILE, {"/safety_monitor": {"warning_distance": 1.0}})
    assert text.startswith(FILE)
    assert yaml.safe_load(text)["/safety_monitor"] == {"ros__parameters": {"warning_distance": 1.0}}
    with pytest.raises(ValueError, match="lacks /robot_navigator: turn_rate"):
        patched(FILE, {"/robot_navigator": {"turn_rate": 1.0}})


def test_saving_writes_a_file_that_ros_reads(tmp_path: Path) -> None:
    path = tmp_path / "deep" / "file.yaml"
    count = save(path, {"/a": tree("/a", speed=1.0, use_sim_time=False), "/b": tree("/b", x=2.0)}, ("/a",))
    assert count == 1
    assert yaml.safe_load(path.read_text()) == {"/a": {"ros__parameters": {"speed": 1.0}}}
    assert [each.name for each in path.parent.iterdir()] == ["file.yaml"]


def test_a_broken_file_is_left_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "broken.yaml"
    path.write_text("a: [")
    with pytest.raises(ValueError, match="not YAML"):
        save(path, {"/a": tree("/a", speed=1.0)})
    assert path.read_text() == "a: ["


NAMES = st.text("abc_", min_size=1, max_size=5)
VALUES = st.one_of(
    st.booleans(),
    st.integers(-(2**63), 2**63 - 1),
    st.floats(allow_nan=False),
    st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cs"]), max_size=12),
    st.lists(st.floats(allow_nan=False, allow_infinity=False), max_size=4).map(tuple),
)


@given(st.dictionaries(NAMES, VALUES, min_size=1, max_size=5), st.data())
def test_patching_reads_back_as_the_new_values(values: dict[str, Value], data: st.DataObject) -> None:
    changed = {name: data.draw(VALUES) for name in values}
    text = patched(dumped({"/n": values}), {"/n": changed})
    read = yaml.safe_load(text)["/n"]["ros__parameters"]
    assert read == {name: list(value) if isinstance(value, tuple) else value for name, value in changed.items()}
