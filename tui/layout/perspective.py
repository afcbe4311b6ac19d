"""Reads rqt perspectives: finds the plug-ins of a window and shows the matching panes. Their positions are not used.

rqt writes JSON (`.perspective`) or an INI file; both name each open plug-in as `plugin__<package>__<class>__<number>`,
or in a list `'<package>/<class>': [1, 2]` of those that are running.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from bot_console.tui.layout.form import LayoutError
from bot_console.tui.layout.tree import Tree, below, beside

RUNNING = re.compile(r"""['"](rqt_[a-z0-9_]{1,60})/\w{1,60}\\?['"]\s*:\s*\[\s*\d""")
OPEN = re.compile(r"plugin__(rqt_[a-z0-9_]{1,60}?)__[A-Z]\w{0,60}?__\d")


def perspective_tree(text: str, panes: Mapping[str, str]) -> tuple[Tree, list[str]]:
    """The panes that match a perspective's plug-ins, and the plug-ins that have no match.

    `panes` maps a package of rqt to a pane. Raises `LayoutError` if the text is not a perspective, or no pane is left.
    """
    packages = list(dict.fromkeys(RUNNING.findall(text) or OPEN.findall(text)))
    if not packages:
        raise LayoutError("no plug-in of rqt is named in it; a layout file or a perspective of rqt is needed")
    wanted = list(dict.fromkeys(panes[each] for each in packages if each in panes))
    unknown = [each for each in packages if each not in panes]
    if not wanted:
        raise LayoutError(f"there is no pane for {', '.join(unknown)}")
    return tiled(wanted), unknown


def tiled(panes: list[str]) -> Tree:
    """A tree of equal tiles, two in each row, from the upper left."""
    pairs = [panes[at : at + 2] for at in range(0, len(panes), 2)]
    rows: list[Tree] = [beside(*pair) if len(pair) == 2 else pair[0] for pair in pairs]
    return rows[0] if len(rows) == 1 else below(*rows)
