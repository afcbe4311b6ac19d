"""The settings file: its contents, how it is parsed, and its initial text."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

from bot_console.tui.console.bags.snapshot_size import KEEP_MEGABYTES, KEEP_MINUTES, SnapshotSize
from bot_console.tui.console.graph.hidden_names import TOOL_NAMES
from bot_console.tui.console.launch.restart_policy import DEFAULT_RESTARTS, RestartPolicy
from bot_console.tui.console.robot.stop_means.configured import ConfiguredMeans, configured_means
from bot_console.tui.files.folders import config_folder
from bot_console.tui.files.store_file import read_store
from bot_console.tui.keys.remapping import wrong_keys
from bot_console.tui.settings.names import GLYPHS, THEME_NAMES
from bot_console.tui.settings.yaml_reader import NotPlainData, read_yaml

MAX_FILE_BYTES = 100_000
"""Maximum size of a settings file; a larger one is not read."""

RESTART_WORDS = ("leave-ended", "on-failure")

TEMPLATE = f"""\
# Settings of bot-console. Every line may be left out; `bot-console config` shows this file, `bot-console config --edit`
# opens it in $EDITOR, and `bot-console config --check` says what is wrong with it.

# Colours: {", ".join(THEME_NAMES)}. Without colours at all: set NO_COLOR in the environment.
theme: dark

# Lines, braille and arrows, or ASCII letters in their place: auto (as the locale can), full, plain.
glyphs: auto

# What the first screen shows: last (as it was left), or the name of a layout.
layout: last

# Recording: what the nodes of a system that this console has started say and hear is kept in memory for so many
# minutes, in at most so many megabytes, so that Z can save what was; 0 keeps nothing.
keep_minutes: {KEEP_MINUTES:g}
keep_megabytes: {KEEP_MEGABYTES:g}

# How ! stops a robot that has no emergency stop of this program (see docs/safety.md): tried in this order, each 0.3 s
# after the one before, until one confirms. Zero velocities are sent in any case. Releasing undoes them.
stop_means: []
#  - lock: /e_stop                       # a Bool topic, as the locks of twist_mux; nothing acknowledges it
#  - set_bool: /motors/hold              # a SetBool service; `hold: false` where false holds
#  - trigger: /base/stop                 # a Trigger service, and the one that undoes it
#    release: /base/clear_stop
#  - deactivate: /base_driver            # a lifecycle node
#  - switch: /controller_manager         # controllers of ros2_control
#    controllers: [diff_drive_controller]

# The graph: topics and nodes that are left out until D is pressed; /camera/* is all of a namespace. What ROS hides (a
# part of the name begins with an underscore) is left out anyway.
graph_hides: [{", ".join(TOOL_NAMES)}]

# A file with the rates and ages that topics should have, checked all the time, as `bot-console graph --rates` writes it
# and `graph --check` reads it; empty: none, until E in the Topics pane names one.
expected: ""

# Launched processes that fail: leave-ended, or on-failure to restart them all until P in the Launch pane says otherwise
# for one; at most so many times in a row, after a delay that doubles (s). What its launch file respawns is left to it.
restart: leave-ended
restart_attempts: {DEFAULT_RESTARTS.attempts}
restart_delay: {DEFAULT_RESTARTS.delay:g}
restart_max_delay: {DEFAULT_RESTARTS.max_delay:g}

# Keys: the id of an action, as `bot-console config --keys` lists them, and the keys that do it from now on.
keys: {{}}
#  app.quit: ctrl+d
#  parameters.undo: u,ctrl+u
"""


@dataclass(frozen=True)
class Settings:
    """The contents of the settings file; `problems` has a line for each value that cannot be used."""

    theme: str = "dark"
    glyphs: str = "auto"
    layout: str = "last"
    keys: Mapping[str, str] = field(default_factory=dict[str, str])
    problems: tuple[str, ...] = ()
    keep_minutes: float = KEEP_MINUTES
    keep_megabytes: float = KEEP_MEGABYTES
    stop_means: tuple[ConfiguredMeans, ...] = ()
    graph_hides: tuple[str, ...] = TOOL_NAMES
    """Patterns of the names of topics and nodes that the graph leaves out."""
    expected: str = ""
    """The file with the expected rates of topics; empty: none."""
    restarts: bool = False
    """Whether every process that fails is restarted."""
    restart_policy: RestartPolicy = DEFAULT_RESTARTS

    @property
    def kept(self) -> SnapshotSize | None:
        """How much of the last minutes is kept in memory; None: nothing is kept."""
        size = SnapshotSize(self.keep_minutes * 60, int(self.keep_megabytes * 1_000_000))
        return size if size.seconds and size.bytes else None


def settings_file() -> Path:
    """The path of the file, which may not exist."""
    return config_folder() / "settings.yaml"


def read_settings(path: Path | None = None) -> Settings:
    """Read the settings file. Values that cannot be used stay at their defaults and are listed in `problems`; never
    raises.
    """
    path = path or settings_file()
    try:
        content = read_store(path, MAX_FILE_BYTES)
    except FileNotFoundError:
        return Settings()
    except OSError as error:
        return Settings(problems=(f"{path}: {error.strerror or error}",))
    try:
        data = read_yaml(content)
    except NotPlainData as error:
        return Settings(problems=(f"{path}: {error}",))
    try:
        return _settings(data, str(path))
    except ValueError:  # Python parses no integer of more than 4,300 digits, and no setting is that long
        return Settings(problems=(f"{path}: a whole number has thousands of digits",))


def _settings(data: object, path: str) -> Settings:
    if data is None:
        return Settings()
    if not isinstance(data, Mapping):
        return Settings(problems=(f"{path}: settings are lines such as `theme: dark`",))
    given = dict(cast("Mapping[Any, Any]", data))
    wrong: list[str] = []

    def one(name: str, default: str, check: Callable[[str], str]) -> str:
        value = given.pop(name, default)
        why = check(value) if isinstance(value, str) else "is a word"
        if why:
            wrong.append(f"{path}: {name}: {why}")
        return default if why else value

    theme = one("theme", "dark", lambda name: _one_of(name, THEME_NAMES))
    glyphs = one("glyphs", "auto", lambda name: _one_of(name, GLYPHS))
    layout = one("layout", "last", lambda _: "")
    restart = one("restart", RESTART_WORDS[0], lambda word: _one_of(word, RESTART_WORDS))
    attempts, delay, longest = (
        _number(given.pop(f"restart_{name}", default), maximum, default, f"{path}: restart_{name}", wrong)
        for name, default, maximum in (
            ("attempts", DEFAULT_RESTARTS.attempts, 1000),
            ("delay", DEFAULT_RESTARTS.delay, 3600.0),
            ("max_delay", DEFAULT_RESTARTS.max_delay, 86400.0),
        )
    )
    policy = RestartPolicy(int(attempts), delay, max(delay, longest))
    expected = one("expected", "", lambda _: "")
    keep = [
        _number(given.pop(name, default), maximum, default, f"{path}: {name}", wrong)
        for name, default, maximum in (("keep_minutes", KEEP_MINUTES, 60.0), ("keep_megabytes", KEEP_MEGABYTES, 4096.0))
    ]
    means, wrong_means = configured_means(given.pop("stop_means", None))
    wrong += [f"{path}: stop_means: {each}" for each in wrong_means]
    keys = _keys(given.pop("keys", None), path, wrong)
    hides = _names(given.pop("graph_hides", list(TOOL_NAMES)), f"{path}: graph_hides", wrong)
    wrong += [f"{path}: '{str(name)[:40]}' is not a setting" for name in given]
    return Settings(
        theme,
        glyphs,
        layout,
        keys,
        tuple(wrong),
        keep[0],
        keep[1],
        means,
        hides,
        expected,
        restart == "on-failure",
        policy,
    )


def _names(value: object, name: str, wrong: list[str]) -> tuple[str, ...]:
    if value is None:
        return ()
    if isinstance(value, list):
        items = cast("list[object]", value)
        if all(isinstance(each, str) and each.startswith("/") for each in items):
            return tuple(map(str, items))
    wrong.append(f"{name}: a list of names that begin with a slash, such as [/rosout, /camera/*]")
    return TOOL_NAMES


def _number(value: object, maximum: float, default: float, name: str, wrong: list[str]) -> float:
    if isinstance(value, (int, float)) and not isinstance(value, bool) and 0 <= value <= maximum:
        return float(value)
    wrong.append(f"{name}: a number from 0 to {maximum:g}")
    return default


def _one_of(name: str, known: Sequence[str]) -> str:
    return "" if name in known else f"'{name[:40]}' is not one of {', '.join(known)}"


def _keys(data: object, path: str, wrong: list[str]) -> Mapping[str, str]:
    if data is None:
        return {}
    if not isinstance(data, Mapping):
        wrong.append(f"{path}: keys: lines such as `app.quit: ctrl+d`")
        return {}
    found: dict[str, str] = {}
    for id, keys in cast("Mapping[Any, Any]", data).items():
        given = {**found, str(id): str(keys)}
        why = wrong_keys(given)
        if why:
            wrong.append(f"{path}: keys: {why}")
        else:
            found = given
    return found
