"""A style sheet that matches the rules for a part of a widget (a component class) when the part is first drawn.

Textual matches them for each part of each widget whenever the widget is styled, and most of that is for lists that
nobody has looked at yet. Where it names what it does otherwise, all parts are styled as Textual does it.
"""

from __future__ import annotations

from typing import Any, cast

from textual.css.model import RuleSet
from textual.css.styles import RenderStyles
from textual.css.stylesheet import Stylesheet
from textual.dom import DOMNode
from textual.widget import Widget


class Rules(RuleSet):
    """A rule set that is found in a set by what it is; Textual says so in Python, a hundred times for each widget."""

    __hash__ = object.__hash__


class PartwiseStylesheet(Stylesheet):
    """Leaves the parts of a `StyledByPart` to it."""

    def _parse_rules(self, *css: Any, **how: Any) -> list[RuleSet]:
        rules: list[RuleSet] = super()._parse_rules(*css, **how)
        for each in rules:
            each.__class__ = Rules
        return rules

    def _process_component_classes(self, node: DOMNode) -> None:
        if isinstance(node, StyledByPart):
            node.style_parts_again(self)
        else:
            super()._process_component_classes(node)


class StyledByPart(Widget):
    """A widget whose parts are styled as they are drawn."""

    def get_component_styles(self, *names: str) -> RenderStyles:
        """The styles of parts; raises `KeyError` for a name that is none of `COMPONENT_CLASSES`."""
        for name in names:
            if name not in self._component_styles and name in self._get_component_classes():
                self._style_part(self.app.stylesheet, name)  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic
        return super().get_component_styles(*names)

    def style_parts_again(self, sheet: Stylesheet) -> None:
        """Match the rules anew for those parts that were drawn, and draw again if one has changed."""
        before = dict(self._component_styles)
        self._component_styles.clear()
        for name in before:
            self._style_part(sheet, name)
        if any(self._component_styles[name] != styles for name, styles in before.items()):
            self.refresh()

    def _style_part(self, sheet: Stylesheet, name: str) -> None:
        part, rules = cast(Any, DOMNode(classes=name)), cast(Any, sheet)
        part._attach(self)
        rules.apply(part, animate=False)
        self._component_styles[name] = part.styles
