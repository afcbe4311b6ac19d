"""The settings file: valid settings are applied, invalid ones are named, and neither prevents a start."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.remapping import remap, wrong_keys
from bot_console.tui.settings.names import THEME_NAMES
from bot_console.tui.settings.settings import TEMPLATE, Settings, read_settings
from bot_console.tui.theme import THEMES
from hypothesis import given
from hypothesis import strategies as st


@pytest.fixture
def table(monkeypatch: pytest.MonkeyPatch) -> None:
    """Restores the key table after a test has changed it."""
    for scope, keys in list(TABLE.items()):
        monkeypatch.setitem(TABLE, scope, keys)


def write_settings(folder: Path, text: str) -> Path:
    path = folder / "settings.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_missing_file_and_generated_file_yield_the_defaults(tmp_path: Path) -> None:
    assert read_settings(tmp_path / "none.yaml") == Settings()
    assert read_settings(write_settings(tmp_path, TEMPLATE)) == Settings()
    assert read_settings(write_settings(tmp_path, "")) == Settings()


def test_settings_are_read(tmp_path: Path) -> None:
    text = "theme: light\nglyphs: plain\nlayout: tuning\nkeys: {parameters.undo: 'U2,ctrl+u'}\n"
    assert read_settings(write_settings(tmp_path, text)) == Settings(
        "light", "plain", "tuning", {"parameters.undo": "U2,ctrl+u"}
    )


def test_topics_hidden_in_the_graph_can_be_configured(tmp_path: Path) -> None:
    assert read_settings(write_settings(tmp_path, "graph_hides: [/tf, /camera/*]")).graph_hides == ("/tf", "/camera/*")
    assert read_settings(write_settings(tmp_path, "graph_hides: []")).graph_hides == ()


@pytest.mark.parametrize(
    ("text", "message_of"),
    [
        ("theme: pink", "theme: 'pink' is not one of dark"),
        ("theme: 3", "theme: is a word"),
        ("colour: red", "'colour' is not a setting"),
        ("- 1", "settings are lines such as"),
        ("a: b: c", "line 1"),
        ("keys: 3", "keys: lines such as"),
        ("keys: {app.fly: f}", "there is no action 'app.fly'"),
        ("keys: {app.quit: '?'}", "not a list of keys"),
        ("keys: {parameters.undo: slash}", "slash is taken by"),
        ("keys: {parameters.undo: q}", "q is taken by parameters.undo and app.quit"),
        ("keys: {app.quit: '1'}", "1 is taken by"),
        ("theme: !!python/object:os.system x", "settings.yaml"),
        ("graph_hides: /rosout", "graph_hides: a list of names that begin with a slash"),
        ("graph_hides: [rosout]", "graph_hides: a list of names that begin with a slash"),
        ("a: &a [*a]", "is not a setting"),
        ("\x00", "settings.yaml"),
        (f"keys: {{app.quit: 0x{'f' * 5000}}}", "a whole number has thousands of digits"),
    ],
)
def test_invalid_settings_are_named_and_the_others_used(tmp_path: Path, text: str, message_of: str) -> None:
    found = read_settings(write_settings(tmp_path, text))
    assert len(found.problems) == 1 and message_of in found.problems[0], found.problems
    assert found.theme == "dark"


def test_unreadable_or_too_large_file_is_reported(tmp_path: Path) -> None:
    assert "irectory" in read_settings(tmp_path).problems[0]
    assert "larger than" in read_settings(write_settings(tmp_path, "#" * 200_000)).problems[0]


@given(st.binary(max_size=200))
def test_any_content_lets_the_console_start(content: bytes) -> None:
    import tempfile

    with tempfile.NamedTemporaryFile(suffix=".yaml") as file:
        file.write(content)
        file.flush()
        assert isinstance(read_settings(Path(file.name)), Settings)


def test_remapping_keeps_the_stop_key(table: None) -> None:
    given = remap({"app.quit": "ctrl+d", "app.stop": "f12"})
    assert given == {"app.quit": "ctrl+d", "app.stop": "exclamation_mark,f12"}
    keys = {key.id: key.keys for key in TABLE["app"]}
    assert keys["app.quit"] == "ctrl+d" and keys["app.stop"] == "exclamation_mark,f12"
    with pytest.raises(ValueError, match="no action"):
        remap({"x": "y"})


def test_key_table_has_no_conflicts() -> None:
    assert wrong_keys({}) == ""
    assert wrong_keys({"app.quit": "ctrl+d"}) == ""


def test_every_theme_of_the_settings_exists() -> None:
    assert set(THEMES) == set(THEME_NAMES)


def test_means_of_stopping_are_read_in_their_order_and_wrong_ones_named(tmp_path: Path) -> None:
    text = "stop_means:\n- set_bool: /hold\n- brake: /b\n- trigger: base/stop\n  release: /clear\n"
    found = read_settings(write_settings(tmp_path, text))
    assert [each.name for each in found.stop_means] == ["set_bool /hold", "trigger /base/stop"]
    assert len(found.problems) == 1 and "stop_means: entry 2: names exactly one of lock" in found.problems[0]
