"""A stop key holds the robot as soon as it is read, under a separate id, unless it turns out to be text."""

from __future__ import annotations

from typing import Any

import pytest
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.remapping import remap
from bot_console.tui.safety.early_stop import TURN_TIMEOUT_S, EarlyStop
from textual import events


class Rig:
    """An early stop, and a robot that records its requests."""

    def __init__(self, *, attached: bool = True) -> None:
        self.idle, self.typing, self.now = True, False, 0.0
        self.shown = self.own = frozenset[str]()
        self.asked: list[Any] = []
        self.early = EarlyStop(lambda: self.idle, lambda: self.typing, lambda: self.shown, lambda: self.now)
        if attached:
            self.attach()

    def attach(self) -> None:
        self.early.attach(self, lambda: self.asked.append("stop"), lambda: self.own)

    def held_by(self, *ids: str, shown: bool = True) -> None:
        """Change the console's stops, and unless `shown` is false let the screen show them."""
        self.own = frozenset(ids)
        self.shown = self.own if shown else self.shown

    def hold_early(self, press: str) -> None:
        self.asked.append(("hold", press))

    def settle_early(self, press: str, *, keep: bool) -> None:
        self.asked.append(("keep" if keep else "withdraw", press))

    def press(self, key: str = "exclamation_mark", character: str | None = "!", *, alone: bool = True) -> events.Key:
        event = events.Key(key, character)
        assert self.early.is_stop(event)
        self.early.typed(event, alone=alone)
        return event

    def wait(self) -> None:
        """Let the time pass in which a key may have its turn."""
        assert self.early.due is not None
        self.now = self.early.due
        self.early.poll()


def test_key_without_earlier_input_stops_in_its_turn() -> None:
    rig = Rig()
    event = rig.press()
    rig.early.poll()
    assert rig.early.due == TURN_TIMEOUT_S and not rig.asked
    assert rig.early.has_acted(event) and rig.asked == ["stop"] and rig.early.due is None


def test_key_with_nothing_before_it_is_a_character_in_a_text_field() -> None:
    rig = Rig()
    rig.typing = True
    assert not rig.early.has_acted(rig.press()) and not rig.asked


@pytest.mark.parametrize("typing", [False, True])
def test_key_behind_other_input_holds_at_once(typing: bool) -> None:
    for alone, idle in ((False, True), (True, False)):
        rig = Rig()
        rig.idle, rig.typing = idle, typing
        rig.press(alone=alone)
        assert rig.asked == [("hold", "1")]


@pytest.mark.parametrize("typing", [False, True])
def test_key_that_a_hung_screen_does_not_handle_holds(typing: bool) -> None:
    rig = Rig()
    rig.typing = typing
    rig.press()
    rig.wait()
    assert rig.asked == [("hold", "1")] and rig.early.due is None


def test_key_handled_after_its_early_stop_keeps_that_stop() -> None:
    rig = Rig()
    event = rig.press(alone=False)
    assert rig.early.has_acted(event)
    assert rig.asked == [("hold", "1"), ("keep", "1"), "stop"]


def test_only_the_press_that_turns_out_to_be_text_is_withdrawn() -> None:
    rig = Rig()
    first, second = rig.press(alone=False), rig.press()
    rig.typing = True
    assert not rig.early.has_acted(first), "it is text"
    rig.typing = False
    assert rig.early.has_acted(second)
    assert rig.asked == [("hold", "1"), ("hold", "2"), ("withdraw", "1"), ("keep", "2"), "stop"]


def test_stop_that_nobody_has_seen_yet_is_not_released_by_pressing_again() -> None:
    rig = Rig()
    first, second = rig.press(alone=False), rig.press(alone=False)
    assert rig.early.has_acted(first)
    rig.held_by("a")
    assert rig.early.has_acted(second) and rig.asked.count("stop") == 2


def test_key_that_was_to_release_the_shown_stop_still_does() -> None:
    rig = Rig()
    rig.held_by("a")
    event = rig.press(alone=False)
    assert not rig.early.has_acted(event) and rig.asked == [("hold", "1"), ("withdraw", "1")]


def test_key_that_was_to_release_holds_if_somebody_else_has_released_before_its_turn() -> None:
    rig = Rig()
    rig.held_by("a")
    event = rig.press(alone=False)
    rig.held_by()
    assert rig.early.has_acted(event) and "stop" in rig.asked


@pytest.mark.parametrize("alone", [False, True])
def test_key_pressed_after_a_release_that_the_screen_does_not_show_yet_stops(alone: bool) -> None:
    rig = Rig()
    rig.held_by("a")
    assert not rig.early.has_acted(rig.press()), "the first press releases"
    rig.held_by(shown=False)
    event = rig.press(alone=alone)
    rig.wait() if alone else None
    assert rig.early.has_acted(event) and rig.asked == [("hold", "2"), ("keep", "2"), "stop"]


def test_key_pressed_while_another_one_is_about_to_release_stops() -> None:
    rig = Rig()
    rig.held_by("a")
    assert not rig.early.has_acted(rig.press()), "the first press is going to release"
    event = rig.press(alone=False)
    rig.held_by()
    assert rig.early.has_acted(event) and "stop" in rig.asked


def test_key_does_not_release_a_stop_that_is_newer_than_what_the_screen_showed() -> None:
    rig = Rig()
    rig.held_by("a")
    event = rig.press(alone=False)
    rig.held_by("b", shown=False)
    assert rig.early.has_acted(event) and "stop" in rig.asked


def test_key_pressed_before_there_is_a_robot_holds_it_as_soon_as_there_is_one() -> None:
    rig = Rig(attached=False)
    rig.press(alone=False)
    rig.attach()
    assert rig.asked == [("hold", "1")]


def test_key_stops_in_its_turn_if_the_early_stop_fails() -> None:
    rig = Rig()
    event = rig.press()
    rig.early.attach(object(), lambda: None, frozenset)  # type: ignore[arg-type] # any failure
    rig.wait()
    rig.attach()
    assert rig.early.has_acted(event) and rig.asked == ["stop"]


@pytest.fixture
def restored_key_table(monkeypatch: pytest.MonkeyPatch) -> None:
    for scope, keys in list(TABLE.items()):
        monkeypatch.setitem(TABLE, scope, keys)


@pytest.mark.usefixtures("restored_key_table")
def test_key_that_is_not_a_character_stops_in_a_text_field_too() -> None:
    remap({"app.stop": "f9"})
    rig = Rig()
    rig.typing = True
    assert rig.early.has_acted(rig.press("f9", None)) and "stop" in rig.asked


@pytest.mark.usefixtures("restored_key_table")
def test_escape_and_own_key_that_arrive_as_one_key_stop() -> None:
    remap({"app.stop": "Q", "topics.qos": "f12"})
    rig = Rig()
    both = rig.press("alt+shift+q", "Q", alone=False)
    parted = [events.Key("escape", "\x1b"), events.Key("Q", "Q")]
    for each in parted:
        each.time = both.time
    assert [rig.early.has_acted(each) for each in parted] == [False, True]


@pytest.mark.usefixtures("restored_key_table")
def test_alt_with_own_key_that_means_something_else_is_withdrawn() -> None:
    remap({"app.stop": "Q", "topics.qos": "f12"})
    rig = Rig()
    assert not rig.early.has_acted(rig.press("alt+shift+q", "Q", alone=False))
    assert rig.asked == [("hold", "1"), ("withdraw", "1")]
