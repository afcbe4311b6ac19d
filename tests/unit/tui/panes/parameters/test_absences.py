"""How the Parameters pane names nodes that have left or do not answer."""

from __future__ import annotations

from types import MappingProxyType

from bot_console.tui.console.model import ConsoleSnapshot, GraphInfo, LinkInfo, ParameterTree
from bot_console.tui.panes.parameters.absences import Absences

HERE, GONE = ParameterTree("/here"), ParameterTree("/gone")
BEFORE = ConsoleSnapshot(parameters=MappingProxyType({"/here": HERE, "/gone": GONE}))
LEFT = MappingProxyType({"/here": HERE})


def text_over(link: LinkInfo) -> str:
    absences = Absences()
    after = ConsoleSnapshot(parameters=LEFT, graph=GraphInfo(silent=("/here",)), link=link)
    absences.note(BEFORE, after, 1.0)
    return absences.text(after, 1.0)


def test_nodes_behind_a_silent_link_have_neither_left_nor_fallen_silent() -> None:
    assert text_over(LinkInfo()) == "⚠ /gone has left  ⚠ /here does not answer"
    assert not text_over(LinkInfo(to="tcp/robot:7447", silent_s=3))
