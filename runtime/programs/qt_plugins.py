"""Recognises plug-ins of rqt, which draw with Qt and are therefore not loaded."""

from __future__ import annotations

import ast

QT = ("rqt_gui", "rqt_gui_py", "python_qt_binding", "qt_gui")
QT_PLUGIN = (
    "{} is a plug-in of rqt and draws with Qt, which a terminal does not have: bot-console does not load it. What its "
    "buttons do can be done here: set parameters in the pane Parameters, plot topics in Plot, and call services by a "
    "ros2 line after a colon. The file is for rqt on a machine with ROS 2; what it does without Qt can be a node"
)
"""The message for rqt plug-ins."""


def imports_qt(tree: ast.Module) -> bool:
    """Return whether a module imports Qt, or what rqt draws with."""
    names = [each.module or "" for each in tree.body if isinstance(each, ast.ImportFrom)]
    names += [each.name for node in tree.body if isinstance(node, ast.Import) for each in node.names]
    return any(name.partition(".")[0] in QT for name in names)
