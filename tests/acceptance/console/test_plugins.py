"""Panes of other packages: found in a workspace and where they are installed, used, and isolated from each other."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console.runtime.workspace.discover import Workspace, default_folders, use, workspace
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.arrangement.plugin_pane import PluginPane
from bot_console.tui.panes.broken_pane import BrokenPane
from bot_console.tui.session.plugins import find_plugins
from piloting import asyncio
from samples import live
from textual.widgets import Button, Label

EXAMPLE = Path(__file__).resolve().parents[3] / "docs" / "examples" / "my_robot_control"
BAD = {
    "raises": "class Pane_(Static):\n    def __init__(self, console): raise RuntimeError('no luck')",
    "shows": "class Pane_(Static):\n    def __init__(self, console): super().__init__('fine')\n"
    "    def show(self, snapshot): raise RuntimeError('no luck')",
    "no_widget": "Pane_ = 3",
    "missing": "import nothing_of_the_kind",
}


@pytest.fixture
def source(tmp_path: Path):
    """The folder of the workspace in use."""
    before = workspace()
    (tmp_path / "src").mkdir()
    path = list(sys.path)
    yield tmp_path / "src"
    use(before)
    sys.path[:] = path


def drive(play) -> None:
    async def main() -> None:
        console, _ = live()
        app = BotConsoleApp(console, refresh_hz=0, plugins=find_plugins)
        async with app.run_test(size=(120, 40)) as pilot:
            await pilot.pause()
            await pilot.pause()
            await play(app, pilot, console)

    asyncio.run(main())


def test_example_in_a_workspace_starts_and_stops_the_robot(source: Path) -> None:
    shutil.copytree(EXAMPLE, source / "my_robot_control")
    use(Workspace(default_folders(source.parent)))

    async def play(app, pilot, console) -> None:
        app.call_later(app.stage.go, "plugin_my_robot_control")
        await pilot.pause()
        pane = app.query_one(PluginPane)
        label = pane.query_one(Label)
        assert pane.display and str(label.content) == "Robot Status: OK"
        assert [str(each.label) for each in pane.query(Button)] == ["Start Robot", "Stop Robot"]
        await pilot.click("#stop")
        await pilot.pause()
        assert str(label.content) == "Robot Status: Stopped"
        assert ("all_stop", True) in console.asked
        await pilot.click("#start")
        await pilot.pause()
        assert str(label.content) == "Robot Status: Running"
        assert console.asked[-1][0] == "set" and ("all_stop", False) in console.asked
        assert not app.controls.faults.seen

    drive(play)


@pytest.mark.soak
def test_example_is_built_installed_and_found(tmp_path: Path) -> None:
    copy = tmp_path / "my_robot_control"
    shutil.copytree(EXAMPLE, copy)
    words = [sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--no-build-isolation", "--target"]
    built = subprocess.run(
        [*words, str(tmp_path / "site"), str(copy)], check=False, capture_output=True, text=True, timeout=240
    )
    assert built.returncode == 0, built.stderr
    program = (
        "from bot_console.tui.session.plugins import find_plugins; each, = find_plugins(); print(each.load().TITLE)"
    )
    line = [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(tmp_path / 'site')!r}); {program}"]
    found = subprocess.run(line, capture_output=True, text=True, timeout=240, check=False, cwd=tmp_path / "site")
    assert found.stdout.strip() == "My robot", found.stderr


@pytest.mark.parametrize(
    "fault", [pytest.param(each, marks=() if each in ("raises", "no_widget") else pytest.mark.slow) for each in BAD]
)
def test_faulty_plugin_ends_alone(source: Path, fault: str) -> None:
    package = source / f"bad_{fault}"
    shutil.copytree(EXAMPLE, package)
    setup = (
        (package / "setup.py")
        .read_text()
        .replace("my_robot_control", f"bad_{fault}")
        .replace("MyRobotControl", "Pane_")
    )
    (package / "setup.py").write_text(setup)
    text = (package / "package.xml").read_text()
    (package / "package.xml").write_text(text.replace("my_robot_control", f"bad_{fault}"))
    (package / "my_robot_control").rename(package / f"bad_{fault}")
    code = "from textual.widgets import Static\n" + BAD[fault]
    (package / f"bad_{fault}" / "pane.py").write_text(code)
    use(Workspace(default_folders(source.parent)))

    async def play(app, pilot, console) -> None:
        app.call_later(app.stage.go, f"plugin_bad_{fault}")
        await pilot.pause()
        await pilot.pause()
        broken = app.query_one(BrokenPane)
        assert broken.display
        message = {"no_widget": "not a Textual widget class", "missing": "nothing_of_the_kind"}.get(fault, "no luck")
        assert message in "\n".join(strip.text for strip in app.screen._compositor.render_strips())
        await pilot.press("1")
        assert app.current_pane.id == "parameters", "everything else goes on"

    drive(play)


def test_plugins_cannot_take_built_in_names(source: Path) -> None:
    shutil.copytree(EXAMPLE, source / "my_robot_control")
    setup = source / "my_robot_control" / "setup.py"
    setup.write_text(setup.read_text().replace("my_robot_control = ", "logs = "))
    use(Workspace(default_folders(source.parent)))
    assert [each.id for each in find_plugins()] == ["plugin_logs"]
