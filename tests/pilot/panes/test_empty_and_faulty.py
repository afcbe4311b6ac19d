"""What each pane shows for an empty system, whatever key is pressed, and for one with faults."""

from __future__ import annotations

import pytest
from piloting import Session, run
from samples import empty, faulty

KEYS_AND_WORDS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "1": (("enter", "plus", "d", "p", "y", "left", "right", "C"), ("waiting for nodes",)),
    "3": (("enter", "right"), ("there are no nodes yet",)),
    "4": (("x", "X", "space", "plus", "left", "right", "f", "K", "up", "down"), ("a  Add /topic",)),
    "5": (("plus", "f"), ("there is no map and no pose yet",)),
    "7": (("a", "w", "down", "r", "u"), ("parameter files were found", "o  Open a parameter file")),
    "9": (("enter", "P", "p", "x", "y", "space"), ("All topics of the system",)),
    "H": (("u", "b", "p", "y", "x", "escape"), ("Every parameter change is listed here",)),
    "M": (("enter", "left", "C", "w"), ("no node publishes",)),
    "B": (("d", "b", "p"), ("Add an alarm",)),
    "I": (("n", "space", "g", "y", "t"), ("no topic of sensor_msgs/msg/Image",)),
}
"""By the key of a pane: keys that act on something missing, and the text that is shown instead."""


def test_keys_of_panes_without_anything_to_act_on_are_harmless() -> None:
    async def play(session: Session) -> None:
        for pane, (keys, words) in KEYS_AND_WORDS.items():
            session.app.clear_notifications()
            await session.press(pane, *keys)
            text = session.text()
            assert all(each in text for each in words), (pane, text)

    run(empty(), play)


@pytest.mark.slow
def test_invalid_pattern_is_explained_even_on_an_empty_log() -> None:
    async def play(session: Session) -> None:
        await session.press("2", "E", "enter", "x", "y", "K", "f", "slash")
        session.app.clear_notifications()
        session.app.focused.value = "re:["
        await session.settle()
        assert "regular expression" in session.text()

    run(empty(), play)


def test_faults_of_the_system_are_named_in_the_panes_that_they_concern() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        assert "does not answer on its parameter services" in session.text()
        await session.press("4")
        assert "no numbers in this window" in session.text()
        await session.press("8")
        assert "broken.launch.py, line 12: invalid syntax" in session.text()
        session.console.change(problem="")
        await session.press("5")
        assert "this system has no world" in session.text()

    run(faulty(), play, (120, 40))
