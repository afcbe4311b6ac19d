"""The key table is correct: every action exists, no key has two meanings, and a terminal can send every key."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from string import ascii_letters

import pytest
from bot_console import tui
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.bag_app import BagApp
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.key import Key
from bot_console.tui.pane_table import PANES, PaneEntry
from bot_console.tui.panes.broken_pane import BrokenPane
from bot_console.tui.panes.lesson.pane import LessonPane
from bot_console.tui.panes.logs.levels_screen import LevelsScreen
from bot_console.tui.panes.logs.rules_screen import RulesScreen
from bot_console.tui.screens.arrange_mode import ArrangeScreen
from bot_console.tui.screens.array_editor import ElementsScreen
from bot_console.tui.screens.box import WithScrollBox
from bot_console.tui.screens.confirm import ConfirmScreen
from bot_console.tui.screens.help import HelpScreen
from bot_console.tui.screens.launch_arguments import ArgumentsScreen
from bot_console.tui.screens.message_form import FillScreen
from bot_console.tui.screens.overlay import Overlay
from bot_console.tui.screens.picker import PickerScreen
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.screens.tuning_progress import TuningScreen
from bot_console.tui.widgets.command_line import CommandField
from bot_console.tui.widgets.diagram_view import DiagramView
from bot_console.tui.widgets.prompt.filtered import Filterable, Searchable
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.row_list import RowList
from textual.keys import Keys

SCREENS = {
    "arrange": ArrangeScreen,
    "overlay": Overlay,
    "help": HelpScreen,
    "question": QuestionScreen,
    "confirm": ConfirmScreen,
    "elements": ElementsScreen,
    "box": WithScrollBox,
    "picker": PickerScreen,
    "form": ArgumentsScreen,
    "fill": FillScreen,
    "rules": RulesScreen,
    "levels": LevelsScreen,
    "tuning": TuningScreen,
}
OWNERS = {
    "app": BotConsoleApp,
    "player": BagApp,
    "list": RowList,
    "diagram": DiagramView,
    "find": Searchable,
    "narrowed": Filterable,
    "prompt": Prompt,
    "command": CommandField,
    "broken": BrokenPane,
    **SCREENS,
    **{each.id: each.load() for each in PANES},
    "lesson": LessonPane,
}
KEYS = [(scope, key) for scope, keys in TABLE.items() for key in keys]
ROOT = Path(tui.__path__[0])
KEY_TABLE = ROOT / "keymap.py"
HANDLERS = {"on_key", "_on_key", *(f"key_{each.value}" for each in Keys), *map("key_{}".format, ascii_letters)}
"""Methods that Textual calls with a key."""
STOLEN = {"ctrl+x", "ctrl+b", "ctrl+a", "ctrl+s", "ctrl+h", "ctrl+i", "ctrl+m", "ctrl+j"}


@pytest.mark.parametrize(("scope", "key"), KEYS, ids=[key.id for _, key in KEYS])
def test_every_action_exists_and_every_key_is_usable(scope: str, key: Key) -> None:
    name = re.match(r"\w+", key.action.removeprefix("app."))
    owner = BotConsoleApp if key.action.startswith("app.") else OWNERS[scope]
    assert name and hasattr(owner, f"action_{name[0]}")
    keys = key.keys.split(",")
    assert not STOLEN & set(keys)
    assert not [each for each in keys if re.fullmatch(r"f\d+", each) and each != "f1"]
    assert key.id.startswith(f"{scope}.") and key.text


@pytest.mark.parametrize("scope", TABLE)
def test_no_key_has_two_meanings_in_one_scope(scope: str) -> None:
    keys = [each for key in TABLE[scope] for each in key.keys.split(",")]
    assert len(keys) == len(set(keys))


def test_every_pane_has_its_digit_keys_and_help() -> None:
    digits = {key.keys: key.action for key in TABLE["app"] if key.action.startswith("pane(")}
    for each in PANES:
        assert digits[each.key] == f"pane('{each.id}')"
        assert each.load().HELP and each.id in TABLE


def test_every_scope_of_the_table_is_used() -> None:
    assert set(TABLE) == set(OWNERS)


@pytest.mark.parametrize("each", PANES, ids=[each.id for each in PANES])
def test_a_pane_names_the_scopes_that_act_in_it_and_overrides_no_key_of_them(each: PaneEntry) -> None:
    kind = each.load()
    merged = kind._merge_bindings().key_to_bindings
    for scope in (each.id, *kind.SCOPES):
        if scope in ("list", "diagram"):
            continue  # these belong to widgets in the pane
        for key in TABLE[scope]:
            for name in key.keys.split(","):
                assert [binding.id for binding in merged[name]] == [key.id]


def outside_of_table(path: Path) -> list[str]:
    """The places in a file that bind keys without the table."""
    found: list[str] = []
    text = path.read_text(encoding="utf-8")
    if not re.search(rf"Binding|BINDINGS|event\s*\.\s*key|{'|'.join(HANDLERS)}", text):  # quicker than parsing
        return found
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.Call(func=ast.Name(id="Binding") | ast.Attribute(attr="Binding")):
                found.append(f"{path.name}:{node.lineno} makes a binding")
            case ast.Assign(targets=[ast.Name(id="BINDINGS")]) | ast.AnnAssign(target=ast.Name(id="BINDINGS")):
                if not (node.value and is_of_table(node.value)):
                    found.append(f"{path.name}:{node.lineno} binds keys that are not in the table")
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name) if name in HANDLERS:
                found.append(f"{path.name}:{node.lineno} handles a key itself")
            case ast.Compare(left=ast.Attribute(value=ast.Name(id="event"), attr="key"), comparators=[right]) if any(
                isinstance(each, ast.Constant) for each in ast.walk(right)
            ):
                found.append(f"{path.name}:{node.lineno} compares a key")
    return found


def is_of_table(value: ast.expr) -> bool:
    """Whether an expression consists of `bindings("scope")` only."""
    match value:
        case ast.Call(func=ast.Name(id="bindings") | ast.Attribute(attr="bindings")):
            return True
        case ast.Starred(value=inside):
            return is_of_table(inside)
        case ast.List(elts=parts) | ast.Tuple(elts=parts):
            return all(map(is_of_table, parts))
        case ast.BinOp(left=left, right=right):
            return is_of_table(left) and is_of_table(right)
    return False


def test_no_key_is_bound_outside_the_table() -> None:
    files = [each for each in sorted(ROOT.rglob("*.py")) if each != KEY_TABLE]
    assert [place for each in files for place in outside_of_table(each)] == []
