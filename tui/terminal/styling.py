"""A style sheet that matches the rules for a part of a widget (a component class) when the part is first drawn.

Textual matches them for every part of a widget whenever the widget is styled, mostly for lists that are not visible
yet. If Textual's private parts have other names, Textual styles all parts itself.
"""

from __future__ import annotations

from typing import Any, cast

from rich.style import Style
from textual.app import App
from textual.css.model import RuleSet
from textual.css.styles import RenderStyles
from textual.css.stylesheet import Stylesheet
from textual.dom import DOMNode
from textual.geometry import Region
from textual.screen import Screen
from textual.strip import Strip
from textual.widget import Widget


class Rules(RuleSet):
    """A rule set hashed by identity in C; Textual does that in Python, a hundred times for each widget."""

    __hash__ = object.__hash__


class PartwiseStylesheet(Stylesheet):
    """A style sheet that leaves styling the parts of a `StyledByPart` to that widget."""

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
    """A widget whose parts are styled when they are drawn; its own style is computed once for all lines of a frame."""

    _own_style: Style | None = None

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._drawn_parts: dict[str, Style] = {}

    @property
    def own_style(self) -> Style:
        """A cached `rich_style`: Textual's asks all ancestors, at twenty times the cost of the rest of a line."""
        return self.rich_style if self._own_style is None else self._own_style

    def render_lines(self, crop: Region) -> list[Strip]:
        """The lines in a region."""
        self._own_style = self.rich_style
        try:
            return super().render_lines(crop)
        finally:
            self._own_style = None

    def get_component_styles(self, *names: str) -> RenderStyles:
        """The styles of parts; raises `KeyError` for a name that is not in `COMPONENT_CLASSES`."""
        for name in names:
            if name not in self._component_styles and name in self._get_component_classes():
                self._style_part(self.app.stylesheet, name)  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic
        return super().get_component_styles(*names)

    def part_style(self, name: str) -> Style:
        """The style of a part by the rules alone, without the widget's own; cached until they are matched again.

        Textual's own cache is cleared with every redraw, even of a single character. Raises `KeyError` for a name that
        is not in `COMPONENT_CLASSES`.
        """
        style = self._drawn_parts.get(name)
        if style is None:
            style = self._drawn_parts[name] = self.get_component_styles(name).partial_rich_style
        return style

    def style_parts_again(self, sheet: Stylesheet) -> None:
        """Match the rules again for the parts that were drawn, and redraw if one has changed.

        Parts keep their nodes: a new one each time would stay in memory until the next garbage collection.
        """
        changed = False
        for styles in self._component_styles.values():
            before = styles.get_rules()
            cast(Any, sheet).apply(styles.node, animate=False)
            changed = changed or styles.get_rules() != before
        if changed:
            self._drawn_parts.clear()
            self.refresh()

    def _style_part(self, sheet: Stylesheet, name: str) -> None:
        part, rules = cast(Any, DOMNode(classes=name)), cast(Any, sheet)
        part._attach(self)
        rules.apply(part, animate=False)
        self._component_styles[name] = part.styles


class StyledOnceApp(App[None]):
    """An app whose style sheets are parsed only once, with the colours of the chosen theme."""

    def __init__(self) -> None:
        super().__init__()
        self.stylesheet = PartwiseStylesheet(variables=self.get_css_variables())

    def use_colours(self) -> None:
        """Make the first parsing of the style sheets use the colours of the chosen theme."""
        self.stylesheet.set_variables(self.get_css_variables())


class StyledOnceScreen(Screen[Any]):
    """A screen whose widgets are not styled again when it is shown for the first time."""

    _was_shown = False

    def update_node_styles(self, animate: bool = True) -> None:
        """Match the rules again for this screen and its widgets, except when it is first shown: they have just been."""
        is_shown = self.stack_updates > 0
        if self._was_shown or not is_shown:
            super().update_node_styles(animate)
        self._was_shown = is_shown or self._was_shown
