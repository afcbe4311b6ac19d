"""What the tests of the screen look up once is what Textual would find each time."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import zip_longest
from typing import Any
from unittest.mock import patch

import pytest
import textual_lookups
from piloting import Session, run
from samples import live
from textual import on
from textual.message import Message
from textual.message_pump import MessagePump
from textual.reactive import Reactive, reactive
from textual.widget import Widget
from textual_lookups import looked_up_once


class Asked(Message):
    """A message with a handler in both classes below."""


class First(Widget):
    count: Reactive[int] = reactive(1)

    def on_asked(self, message: Asked) -> None: ...


class Second(First):
    double: Reactive[int] = reactive(0)

    def compute_double(self) -> int:
        return 2 * self.count

    def on_asked(self, message: Asked) -> None: ...


class Chosen(First):
    @on(Asked)
    def answer(self) -> None: ...


@pytest.mark.parametrize(
    ("pump", "is_prevented", "names"),
    [
        (Second, False, ["Second.on_asked", "First.on_asked"]),
        (Second, True, ["Second.on_asked"]),
        (Chosen, False, ["Chosen.answer", "First.on_asked"]),
    ],
)
def test_handlers_are_found_in_order_until_one_prevents_the_others(
    pump: type[First], is_prevented: bool, names: list[str]
) -> None:
    found = []
    message = Asked()
    with looked_up_once():
        for cls, method in pump()._get_dispatch_methods("on_asked", message):
            assert method.__qualname__ == f"{cls.__name__}.{method.__name__}"
            found.append(method.__qualname__)
            if is_prevented:
                message.prevent_default()
    assert found == names


def test_handler_that_a_test_replaces_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    widget = Second()

    def found() -> list[object]:
        return [method.__func__ for _, method in widget._get_dispatch_methods("on_asked", Asked())]

    def other(self: Second, message: Asked) -> None: ...

    original = [Second.on_asked, First.on_asked]
    for _ in range(2):  # before the block begins
        with looked_up_once():
            assert found() == original
            with monkeypatch.context() as changed:
                changed.setattr(Second, "on_asked", other)
                changed.setattr(Second, "_on_asked", First.on_asked, raising=False)
                assert found() == [First.on_asked, First.on_asked]
                changed.delattr(Second, "_on_asked")
                assert found() == [other, First.on_asked]
            assert found() == original
        monkeypatch.setattr(Second, "on_asked", other)
        original = [other, First.on_asked]


def test_reactive_attributes_have_their_values_whether_set_or_computed() -> None:
    with looked_up_once():
        widget = Second()
        assert (widget.count, widget.double) == (1, 2)
        widget.set_reactive(First.count, 3)
        assert (widget.count, widget.double) == (3, 6)
        assert isinstance(Second.count, reactive)


def test_app_gets_the_answers_of_textual() -> None:
    asked: dict[str, int] = {"handlers": 0, "values": 0}
    differing: list[object] = []
    ours, value = textual_lookups._bound_handlers, textual_lookups._value

    def both(pump: MessagePump, name: str, message: Message) -> Iterator[Any]:
        asked["handlers"] += 1
        theirs = textual_lookups._get_dispatch_methods(pump, name, message)
        for mine, other in zip_longest(ours(pump, name, message), theirs):
            if mine != other:
                differing.append((pump, message, mine, other))
            yield mine

    def both_values(attribute: Any, node: Any, kind: type) -> Any:
        asked["values"] += 1
        mine, other = value(attribute, node, kind), textual_lookups._get(attribute, node, kind)
        if mine is not other and mine != other:
            differing.append((attribute, node, mine, other))
        return mine

    async def play(session: Session) -> None:
        await session.press("1", "j", "slash", *"max", "enter", "8", "question_mark", "escape", "colon", "x", "escape")

    with (
        patch.object(textual_lookups, "_bound_handlers", both),
        patch.object(textual_lookups, "_value", both_values),
    ):
        run(live(), play)
    assert min(asked.values()) > 500 and differing == []
