"""Profiles: how a file applies to the running nodes, where files are found, and that saving loses nothing."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import pytest
from bot_console.runtime.rmw.parameter_precedence import ParameterTable
from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree, Profile, Range, Value
from bot_console.tui.console.parameters.file.patch import new_text, same
from bot_console.tui.console.parameters.file.saving import save
from bot_console.tui.console.parameters.file.text import sections, value_at
from bot_console.tui.console.parameters.profile_store import ProfileStore
from bot_console.tui.console.parameters.profiles import differences, find, load, unmatched

PUBLIC = sorted((Path(__file__).parent / "public").glob("*.yaml"))
KINDS = {bool: Kind.BOOL, int: Kind.INTEGER, float: Kind.DOUBLE, str: Kind.STRING}


def kind_of(value: Value) -> Kind:
    if isinstance(value, tuple):
        return Kind[f"{KINDS[type(value[0])].name}_ARRAY"] if value else Kind.STRING_ARRAY  # type: ignore[index]
    return KINDS[type(value)]


def tree(node: str, values: Mapping[str, Value], **more: object) -> ParameterTree:
    found = (ParameterInfo(node, name, kind_of(value), value, default=value, **more) for name, value in values.items())  # type: ignore[arg-type]
    return ParameterTree(node, tuple(found))


def declare_all(path: Path) -> dict[str, ParameterTree]:
    """Nodes with the parameters of a file; a wildcard becomes one node."""
    values: dict[str, dict[str, Value]] = {}
    for section in sections(path.read_text()):
        node = "/some_node" if "*" in section.key else section.key
        values.setdefault(node, {}).update({name: value_at(name, at) for name, at in section.places.items()})
    return {node: tree(node, found) for node, found in values.items()}


def change_value(value: Value) -> Value:
    if isinstance(value, bool):
        return not value
    if isinstance(value, tuple):
        return (*value[:-1], change_value(value[-1]))  # type: ignore[return-value]
    return f"{value}_2" if isinstance(value, str) else value + 1  # type: ignore[operator]


def with_value(trees: dict[str, ParameterTree], node: str, name: str, value: Value) -> dict[str, ParameterTree]:
    values = {each.name: each.value for each in trees[node].parameters}
    return {**trees, node: tree(node, {**values, name: value})}


@pytest.mark.parametrize("path", PUBLIC, ids=lambda path: path.stem)
def test_a_file_of_a_public_package_previews_applies_and_saves_with_only_the_changed_line_different(
    path: Path, tmp_path: Path
) -> None:
    trees, profile = declare_all(path), load(path)
    assert not profile.problem and not differences(profile, trees)
    assert all("*" in key for key in unmatched(profile, {})) is False
    original = path.read_text()
    for node, found in trees.items():
        for each in found.parameters:
            new = change_value(each.value)
            other = with_value(trees, node, each.name, new)
            (seen,) = differences(profile, other)
            assert (seen.node, seen.name, seen.now, seen.refusal, seen.unknown) == (node, each.name, new, "", False)
            if node == "/some_node":
                continue  # saving adds a section for this node, since the wildcard applies to others, too
            place = tmp_path / "saved.yaml"
            place.write_text(original)
            save(place, {node: other[node]}, (node,))
            before, after = original.splitlines(), place.read_text().splitlines()
            assert len(before) == len(after)
            differing = [one for one, two in zip(before, after, strict=True) if one != two]
            assert len(differing) == 1, (each.name, differing)


@pytest.mark.parametrize("path", PUBLIC, ids=lambda path: path.stem)
def test_a_node_started_with_a_previewed_file_gets_the_previewed_values(path: Path) -> None:
    table = ParameterTable()
    table.add_file(str(path))
    for node, found in declare_all(path).items():
        given = table.for_node(node)
        for each in found.parameters:
            value = given[each.name]
            assert same(tuple(value) if isinstance(value, list) else value, each.value)


EVERYTHING = """\
# All that a parameter file may hold.  \n\
/**:
    ros__parameters:
        use_sim_time: false   # for all
/robot:
  ros__parameters:
    a_bool: yes
    an_int: 0x10
    a_double: 1e3
    infinite: .inf
    less: -.inf
    nothing: .nan
    anchored: &speed 2.5   # an anchor that nobody uses
    text: 'it''s'
    long: "a\\tb"
    group: {x: 1, y: [1, 2]}
    dotted.name: 3
    empty: []
    list:
    - 1.5   # the first
    - 2.5
    words: [a, "b, c"]
    flags: [true, false]
/*/lidar:
  ros__parameters: {beams: 360}
"""


def test_dump_load_dump_is_byte_identical_for_a_comprehensive_file(tmp_path: Path) -> None:
    path = tmp_path / "all.yaml"
    path.write_bytes(EVERYTHING.encode())
    trees = {each: found for each, found in declare_all(path).items() if each == "/robot"}
    save(path, trees)
    assert path.read_bytes() == EVERYTHING.encode()
    table = ParameterTable()
    table.add_file(str(path))
    given = table.for_node("/robot")
    for each in trees["/robot"].parameters:
        value = given[each.name]
        if each.value != ():  # an empty array has no type in ROS, and so no value
            assert same(tuple(value) if isinstance(value, list) else value, each.value)
    text = new_text({"/robot": {each.name: each.value for each in trees["/robot"].parameters if each.value != ()}})
    (tmp_path / "dump.yaml").write_text(text)
    again = declare_all(tmp_path / "dump.yaml")["/robot"]
    assert new_text({"/robot": {each.name: each.value for each in again.parameters}}) == text


def test_keys_and_parameters_without_a_node_are_reported(tmp_path: Path) -> None:
    (tmp_path / "p.yaml").write_text(
        "/**:\n  ros__parameters: {speed: 2.0, other: 1}\n/n:\n  ros__parameters: {speed: 9.0, gone: 1}\n"
        "/x/*:\n  ros__parameters: {a: 1}\n"
    )
    profile = load(tmp_path / "p.yaml")
    trees = {"/n": tree("/n", {"speed": 1.0}, range=Range(0.0, 5.0)), "/m": tree("/m", {"speed": 1.0})}
    found = {(each.node, each.name): each for each in differences(profile, trees)}
    assert set(found) == {("/n", "speed"), ("/n", "gone"), ("/m", "speed")}
    assert "out of range" in found["/n", "speed"].refusal, "the later key counts"
    assert found["/n", "gone"].unknown and found["/m", "speed"].then == 2.0
    assert unmatched(profile, trees) == ("/x/*",)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("launch: !!timestamp x\n", "not YAML: has a value that its tag does not allow"),
        ("launch: !!timestamp 2020-13-45\n", "not YAML: has a value that its tag does not allow"),
        (f"launch: {'[' * 1000}\n", "not YAML: nested too deeply"),
        ("launch: a\0\n", "not YAML: .*characters are not allowed"),
        ('"a\nlaunch: b"\n', "a launch profile has the lines"),
        (f"launch: a\narguments: {{n: 0x{'f' * 5000}}}\n", "an integer with thousands of digits"),
    ],
)
def test_an_unreadable_launch_profile_is_explained_on_one_line(tmp_path: Path, text: str, problem: str) -> None:
    path = tmp_path / "bad.yaml"
    path.write_text(text)
    reported = load(path).problem
    assert re.search(problem, reported)
    assert len(reported.splitlines()) == 1


def test_a_launch_profile_names_a_launch_file_with_its_arguments(tmp_path: Path) -> None:
    (tmp_path / "robot.launch.py").write_text("")
    (tmp_path / "two.yaml").write_text("# Two robots.\nlaunch: robot.launch.py\narguments: {robots: 2, fast: true}\n")
    (tmp_path / "bad.yaml").write_text("launch: nowhere.launch.py\n")
    bad, two = find([tmp_path])
    assert (two.title, two.launch) == ("Two robots.", str(tmp_path / "robot.launch.py"))
    assert dict(two.arguments) == {"robots": "2", "fast": "true"} and not two.problem
    assert "nowhere.launch.py" in bad.problem


def test_profiles_are_found_opened_saved_and_keep_their_comments(tmp_path: Path) -> None:
    for folder, speed in (("ours", 1.0), ("pkg/config", 2.0)):
        (tmp_path / folder).mkdir(parents=True)
        (tmp_path / folder / "indoor.yaml").write_text(f"/n:\n  ros__parameters: {{speed: {speed}}}\n")
    (tmp_path / "pkg/config/map.yaml").write_text("image: map.pgm\n")
    profile_store = ProfileStore([tmp_path / "ours"], tmp_path / "own", [tmp_path / "pkg/config"])
    assert [each.name for each in profile_store.profiles] == ["indoor", "indoor (pkg)"]
    trees = {"/n": tree("/n", {"speed": 3.0})}
    assert profile_store.save("mine", "For the hall.", trees).ok
    path = tmp_path / "own" / "mine.yaml"
    assert path.read_text() == "# For the hall.\n/n:\n  ros__parameters:\n    speed: 3.0\n"
    path.write_text(path.read_text().replace("3.0", "3.0  # tried out"))
    assert profile_store.save("mine", "", with_value(trees, "/n", "speed", 4.0)).ok
    assert path.read_text() == "# For the hall.\n/n:\n  ros__parameters:\n    speed: 4.0  # tried out\n"
    assert not profile_store.save("../mine", "", trees).ok
    assert profile_store.open(str(tmp_path / "pkg/config/map.yaml")).ok is False
    before = profile_store.profiles
    profile_store.poll_again()
    assert profile_store.profiles is before
    (tmp_path / "own" / "theirs.yaml").write_text("/n: {ros__parameters: {speed: 5.0}}\n")
    profile_store.reload_if_changed()
    assert [each.name for each in profile_store.profiles] == ["indoor", "indoor (pkg)", "map", "mine", "theirs"]
    (tmp_path / "own" / "theirs.yaml").write_text("/n: {ros__parameters: {speed: 50.0}}\n")
    profile_store.reload_if_changed()
    assert dict(profile_store.profiles[-1].values) == {("/n", "speed"): 50.0}
    (tmp_path / "own" / "theirs.yaml").unlink()
    profile_store.reload_if_changed()
    assert profile_store.profiles == before


def test_only_changed_values_are_saved_on_request(tmp_path: Path) -> None:
    found = ParameterTree(
        "/n",
        (
            ParameterInfo("/n", "same", Kind.INTEGER, 1, default=1),
            ParameterInfo("/n", "other", Kind.INTEGER, 2, default=1),
        ),
    )
    save(tmp_path / "p.yaml", {"/n": found}, only_changed=True)
    assert (tmp_path / "p.yaml").read_text() == "/n:\n  ros__parameters:\n    other: 2\n"


def test_only_the_users_own_profiles_can_be_renamed_and_deleted(tmp_path: Path) -> None:
    (tmp_path / "ours").mkdir()
    (tmp_path / "ours" / "indoor.yaml").write_text("/n:\n  ros__parameters: {speed: 1.0}\n")
    profile_store = ProfileStore([tmp_path / "ours"], tmp_path / "own")
    trees = {"/n": tree("/n", {"speed": 3.0})}
    for name in ("hall", "attic"):
        assert profile_store.save(name, "", trees).ok
    assert {each.name: each.own for each in profile_store.profiles} == {"indoor": False, "hall": True, "attic": True}
    assert (
        not profile_store.delete("indoor").ok
        and not profile_store.rename("indoor", "mine").ok
        and not profile_store.delete("nobody").ok
    )
    assert (tmp_path / "ours" / "indoor.yaml").is_file()
    taken = profile_store.rename("hall", "attic")
    assert not taken.ok and "already" in taken.text
    for bad in ("", "../up", "a/b"):
        assert not profile_store.rename("hall", bad).ok
    assert profile_store.open(str(tmp_path / "own" / "hall.yaml")).ok, "opened by its path as well"
    assert profile_store.rename("hall", "cellar").ok
    assert [each.name for each in profile_store.profiles] == ["attic", "cellar", "indoor"]
    assert profile_store.delete("cellar").ok and not (tmp_path / "own" / "cellar.yaml").exists()
    assert [each.name for each in profile_store.profiles] == ["attic", "indoor"]
    (tmp_path / "own" / "attic.yaml").unlink()
    gone = profile_store.delete("attic")
    assert not gone.ok and "not deleted" in gone.text


def test_the_last_of_alternating_keys_with_a_name_takes_effect() -> None:
    values: dict[tuple[str, str], Value] = {("/n", "a"): 1, ("/**", "b"): 2, ("/**", "a"): 3, ("/n", "b"): 4}
    found = differences(Profile("p", "", values=values), {"/n": tree("/n", {"a": 0, "b": 0})})
    assert {each.name: each.then for each in found} == {"a": 3, "b": 4}
