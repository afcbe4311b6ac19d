"""Layouts as files: saved, read back, refused with the reason; perspectives of rqt."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.cli.appearance import appearance_of
from bot_console.tui.cli.arguments import attach_parser, parse, parse_attach
from bot_console.tui.files.folders import config_folder
from bot_console.tui.layout.built_in import BUILT_IN
from bot_console.tui.layout.current_layout import Arrangement
from bot_console.tui.layout.tree import below, beside
from bot_console.tui.settings.layouts import FileLayouts

PANES = ("parameters", "logs", "plot", "world", "graph", "steering")
TREE = below(beside("plot", "logs", shares=(2, 1)), "world", shares=(3, 1))
PERSPECTIVE = "{\"repr\": \"{'rqt_graph/RosGraph': [1], 'rqt_console/Console': [1], 'rqt_bag/Bag': [1]}\"}"


def test_layout_is_saved_and_loaded() -> None:
    store = FileLayouts(PANES)
    file = store.save("mine", TREE)
    assert store.layouts()["mine"].tree == TREE
    assert Path(file).read_text().startswith("# A layout") and "plot" in Path(file).read_text()


def test_last_layout_is_restored() -> None:
    store = FileLayouts(PANES)
    assert Arrangement(store, *store.last()).title == "overview"
    arrangement = Arrangement(store)
    arrangement.change(TREE)
    arrangement.remember()
    again = Arrangement(store, *store.last())
    assert again.title == "overview*" and again.tree(120, 40) == TREE


def test_invalid_file_is_named_and_others_are_loaded() -> None:
    store = FileLayouts(PANES)
    store.save("mine", TREE)
    folder = config_folder() / "layouts"
    (folder / "bad.yaml").write_text("layout: {beside: [plot, nothing]}")
    (folder / "worse.yaml").write_text("layout: [")
    (folder / "list.yaml").write_text("- 1")
    assert set(store.layouts()) == {"mine"}
    reported = "\n".join(store.problems)
    assert (
        "there is no pane 'nothing'" in reported and "worse.yaml: line 2" in reported and "a line `layout:`" in reported
    )


def test_built_in_layouts_fit_their_stated_size() -> None:
    for name, layout in BUILT_IN.items():
        assert Arrangement(name=name).tree(120, 40) == layout.form(120, 40), name
    overview = BUILT_IN["overview"]
    for size, tree in (*overview.forms, ((60, 20), overview.tree)):
        assert Arrangement().tree(*size) == tree
    assert Arrangement().tree(39, 19) is None


def test_filters_are_kept_separately_for_the_systems_of_each_domain(monkeypatch: pytest.MonkeyPatch) -> None:
    kept = {}
    for domain in ("21", "22", "21"):
        monkeypatch.setenv("ROS_DOMAIN_ID", domain)
        store = appearance_of(parse_attach([], attach_parser())[0]).state_store
        kept[domain] = store.get("parameters")
        store.put("parameters", {"filter": domain})
    assert kept == {"21": {"filter": "21"}, "22": None}


def test_command_line_takes_precedence_over_settings() -> None:
    config_folder().mkdir(parents=True)
    (config_folder() / "settings.yaml").write_text("layout: tuning\ntheme: light\nglyphs: plain\n")
    assert appearance_of(parse([])).arrangement.name == "tuning"
    poll = appearance_of(parse(["--layout", "watching", "--theme", "dark", "--no-plain"]))
    assert (poll.arrangement.name, poll.theme, poll.plain) == ("watching", "dark", False)
    assert appearance_of(parse_attach(["--layout", "watching"], attach_parser())[0]).arrangement.name == "watching"
    wrong = appearance_of(parse(["--layout", "none"]))
    assert wrong.arrangement.name == "overview" and "there is no layout 'none'" in wrong.notes[0]


@pytest.mark.parametrize(
    "line", [["rqt", "--perspective-file", "{}"], ["--perspective-file", "{}"], ["rqt_gui", "-p", "{}"]]
)
def test_rqt_perspective_is_opened(tmp_path: Path, line: list[str]) -> None:
    path = tmp_path / "my.perspective"
    path.write_text(PERSPECTIVE)
    poll = appearance_of(parse([each.format(path) for each in line]))
    assert poll.arrangement.tree(120, 40) == beside("graph", "logs") and poll.arrangement.name == "my"
    assert poll.notes == ("rqt_bag of the perspective has no pane here",)


def test_a_layout_file_as_perspective_and_one_that_is_missing(tmp_path: Path) -> None:
    file = FileLayouts(PANES).save("mine", TREE)
    assert appearance_of(parse(["--perspective-file", file])).arrangement.tree(120, 40) == TREE
    poll = appearance_of(parse(["--perspective-file", str(tmp_path / "none")]))
    assert poll.arrangement.name == "overview" and "No such file" in poll.notes[0]
