"""Component styles of a widget are computed when they are drawn, and again whenever that widget is styled again."""

from __future__ import annotations

import asyncio
from typing import Any, ClassVar
from unittest.mock import patch

import pytest
from bot_console.tui.terminal.styling import StyledByPart, StyledOnceApp
from rich.segment import Segment
from textual.app import ComposeResult
from textual.color import Color
from textual.geometry import Region
from textual.strip import Strip
from textual.widget import Widget


class Parts(StyledByPart):
    """A widget with two component classes."""

    COMPONENT_CLASSES: ClassVar[set[str]] = {"parts--first", "parts--second"}


class Plain(StyledOnceApp):
    CSS = """
    .parts--first { color: red; }
    .changed .parts--first { color: blue; }
    .parts--second { color: green; }
    """

    def compose(self) -> ComposeResult:
        yield Parts()


def test_component_style_is_computed_on_demand_and_then_follows_the_rules() -> None:
    async def main() -> None:
        app = Plain()
        async with app.run_test() as pilot:
            parts = app.query_one(Parts)
            assert not parts._component_styles
            assert parts.get_component_styles("parts--first").color == Color.parse("red")
            assert list(parts._component_styles) == ["parts--first"]
            part = parts.get_component_styles("parts--first").node
            with patch.object(Widget, "refresh", autospec=True, side_effect=Widget.refresh) as drawn:
                parts.add_class("changed")
                await pilot.pause()
                assert [call for call in drawn.call_args_list if call.args == (parts,) and not call.kwargs]
            assert parts.get_component_styles("parts--first").color == Color.parse("blue")
            assert parts.get_component_styles("parts--first").node is part, (
                "a new one would leave garbage for the collector"
            )
            with pytest.raises(KeyError):
                parts.get_component_styles("parts--third")

    asyncio.run(main())


def test_cached_component_style_follows_the_rules_and_is_computed_once_for_all_lines() -> None:
    async def main() -> None:
        app = Plain()
        async with app.run_test() as pilot:
            parts = app.query_one(Parts)
            red = parts.part_style("parts--first")
            assert red.color is not None and red == parts.get_component_rich_style("parts--first", partial=True)
            parts.refresh()
            assert parts.part_style("parts--first") is red
            parts.add_class("changed")
            await pilot.pause()
            assert parts.part_style("parts--first") == parts.get_component_rich_style("parts--first", partial=True)
            assert parts.part_style("parts--first").color != red.color
            with pytest.raises(KeyError):
                parts.part_style("parts--third")

            asked: list[object] = []
            found: Any = Parts.rich_style
            line = Strip([Segment("x")])
            with (
                patch.object(Parts, "rich_style", property(lambda self: asked.append(self) or found.fget(self))),
                patch.object(Parts, "render_line", lambda self, y: [line, self.own_style][0]),
            ):
                parts.refresh()
                parts.render_lines(Region(0, 0, 10, 5))
                assert asked == [parts]
                assert parts.own_style == parts.rich_style

    asyncio.run(main())
