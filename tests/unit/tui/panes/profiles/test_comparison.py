"""Profiles side by side: the rows and columns, their order, and their marks."""

from __future__ import annotations

from dataclasses import replace

from bot_console.tui.console.model import ConsoleSnapshot, Profile, ProfileDifference
from bot_console.tui.panes.profiles.comparison import ComparedValue, Comparison, columns_in, compare_profiles
from samples import differences, live

SLOW = (
    ProfileDifference("/robot_navigator", "max_speed", 1.0, 0.5),
    ProfileDifference("/robot_navigator", "seed_of_nobody", None, 1, "no such parameter", unknown=True),
)


def snapshot() -> ConsoleSnapshot:
    return live()[0].current


def profile(name: str) -> Profile:
    return Profile(name, f"/opt/profiles/{name}.yaml")


def compare(selected: str = "", width: int = 100, **changes: object) -> Comparison:
    given = {"competition": differences(), "slow": SLOW, **changes}
    profiles = [profile("indoor"), *(profile(name) for name in given)]
    chosen = next((each for each in profiles if each.name == selected), None)
    return compare_profiles(snapshot(), profiles, chosen, lambda name: given.get(name, ()), width)  # type: ignore[call-overload]


def row(comparison: Comparison, name: str) -> ComparedValue:
    return next(each for each in comparison.rows if each.name == name)


def test_columns_are_the_running_values_and_each_other_profile() -> None:
    assert compare().titles == ("● indoor", "competition", "slow")
    changed = replace(snapshot(), profile_changes=2)
    found = compare_profiles(changed, [profile("indoor"), profile("slow")], None, lambda name: SLOW, 100)
    assert found.titles == ("now", "● indoor", "slow")


def test_unreadable_and_launch_profiles_have_no_column() -> None:
    broken, launch = replace(profile("broken"), problem="not YAML"), replace(profile("two"), launch="two.launch.py")
    assert compare_profiles(snapshot(), [broken, launch, profile("slow")], None, lambda _: SLOW, 100).titles == (
        "● indoor",
        "slow",
    )


def test_values_are_marked_less_safe_refused_or_as_they_are() -> None:
    found = compare()
    assert [each.mark for each in row(found, "max_speed").cells] == ["", "⚠", ""]
    assert [each.value for each in row(found, "max_speed").cells] == [1.0, 3.0, 0.5]
    assert [each.mark for each in row(found, "turn_rate").cells] == ["", "✗", ""]
    assert [each.stays for each in row(found, "turn_rate").cells] == [False, False, True]
    assert row(found, "max_speed").unit == "m/s"


def test_less_safe_values_come_first_and_unknown_ones_not_at_all() -> None:
    names = [each.name for each in compare().rows]
    assert names == ["max_speed", "enable_safety", "turn_rate"]
    safe = [replace(each, unsafe="") for each in differences()]
    assert compare(competition=safe).rows[0].name == "max_speed"
    assert "seed_of_nobody" not in names


def test_bars_grow_with_the_numbers_and_texts_have_none() -> None:
    cells = row(compare(), "max_speed").cells
    assert cells[2].bar < cells[0].bar < cells[1].bar == "█"
    assert {each.bar for each in row(compare(), "enable_safety").cells} == {" "}
    for value in (float("inf"), float("nan"), -1e308):
        odd = row(compare(competition=[replace(differences()[0], then=value)]), "max_speed")
        assert [each.bar for each in odd.cells] == ["█", " ", "▅"], value


def test_nodes_with_the_same_values_share_a_row() -> None:
    tree = snapshot().parameters["/robot_navigator"]
    other = replace(tree, node="/other", parameters=tuple(replace(each, node="/other") for each in tree.parameters))
    both = replace(snapshot(), parameters={**snapshot().parameters, "/other": other})
    same = (differences()[0], replace(differences()[0], node="/other"))
    found = compare_profiles(both, [profile("competition")], None, lambda _: same, 100)
    assert [each.nodes for each in found.rows] == [("/other", "/robot_navigator")]
    unequal = (differences()[0], replace(differences()[0], node="/other", then=2.0))
    assert len(compare_profiles(both, [profile("competition")], None, lambda _: unequal, 100).rows) == 2


def test_selected_profile_is_among_the_columns_that_fit_and_only_these_are_computed() -> None:
    many = {f"profile_{at:02}": SLOW for at in range(20)}
    asked: list[str] = []

    def changes(name: str) -> tuple[ProfileDifference, ...]:
        asked.append(name)
        return SLOW

    profiles = [profile(name) for name in many]
    found = compare_profiles(snapshot(), profiles, profiles[-1], changes, 80)
    assert found.titles[found.shown] == "profile_19"
    assert len(found.titles) == columns_in(80) and found.left_out == 20 - len(asked)
    assert asked == list(found.titles[1:])
