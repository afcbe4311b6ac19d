"""Determines how the screen looks, from the command line, else the settings file, else the terminal."""

from __future__ import annotations

import locale
import sys
from pathlib import Path

from bot_console.tui.cli.arguments import Options
from bot_console.tui.files.save_file import NotSaved, typed_path
from bot_console.tui.keys.remapping import remap
from bot_console.tui.layout.built_in import OVERVIEW
from bot_console.tui.layout.current_layout import Arrangement
from bot_console.tui.layout.form import LayoutError
from bot_console.tui.learn.layout import NAME as LESSON_LAYOUT
from bot_console.tui.learn.layout import LessonLayoutStore
from bot_console.tui.pane_table import PANES
from bot_console.tui.session.embedded.domain import domain
from bot_console.tui.settings.appearance import Appearance
from bot_console.tui.settings.layouts import FileLayouts
from bot_console.tui.settings.settings import Settings, read_settings
from bot_console.tui.settings.state_files import StateFiles

LAST = "last"


def appearance_of(options: Options) -> Appearance:
    """Read the settings, remap keys, and choose the layout."""
    settings = read_settings()
    keys = remap(settings.keys)
    store = FileLayouts([each.id for each in PANES])
    notes = list(settings.problems)
    if options.layout == LESSON_LAYOUT:
        arrangement = Arrangement(LessonLayoutStore(store), LESSON_LAYOUT)
    else:
        arrangement = _arrangement(options, settings, store, notes)
    store.layouts()
    return Appearance(
        arrangement,
        options.theme or settings.theme,
        _plain(options, settings),
        keys,
        StateFiles(_system(options)),
        (*notes, *store.problems),
        settings.graph_hides,
    )


def _system(options: Options) -> str:
    """An id of the shown system, since the state of the screen is kept separately for each system."""
    if options.attach:
        return f"attach {options.reached_by} {domain()}"
    return str(Path(options.launch).resolve()) if options.launch else "robot"


def _arrangement(options: Options, settings: Settings, store: FileLayouts, notes: list[str]) -> Arrangement:
    if options.opening.perspective:
        try:
            path = typed_path(options.opening.perspective)
            tree, left = store.from_file(path)
        except (LayoutError, NotSaved, OSError) as error:
            reason = error.strerror if isinstance(error, OSError) and error.strerror else error
            notes.append(f"perspective {options.opening.perspective}: {reason}")
        else:
            notes += [f"{each} of the perspective has no pane here" for each in left]
            return Arrangement(store, Path(path).stem, tree)
    name = options.layout or settings.layout
    try:
        return Arrangement(store, *store.last()) if name == LAST else Arrangement(store, name)
    except LookupError as error:
        if name != LAST:
            notes.append(str(error.args[0]))
        return Arrangement(store, OVERVIEW)


def _plain(options: Options, settings: Settings) -> bool:
    if options.plain is not None:
        return options.plain
    return settings.glyphs == "plain" or (settings.glyphs == "auto" and not _can_show())


def _can_show() -> bool:
    """Whether the locale has the characters with which the console draws."""
    encoding = getattr(sys.stdout, "encoding", None) or locale.getpreferredencoding(False)
    try:
        "─⣿→".encode(encoding)
    except (UnicodeEncodeError, LookupError):
        return False
    return True
