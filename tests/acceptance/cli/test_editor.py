"""`bot-console setup editor`: what an editor with pyright then reports, offers and shows in a workspace."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from bot_console.runtime.workspace import discover
from bot_console.tui.cli.main import main
from language_server import LanguageServer, language_server

COURSE = os.environ.get("BOT_CONSOLE_COURSE", "")
PACKAGE = """<package format="3"><name>{}</name><version>0.0.1</version><description>d</description>
<maintainer email="a@b.c">a</maintainer><license>x</license>
<member_of_group>rosidl_interface_packages</member_of_group></package>"""
PACK = """# A battery, as the charger sees it

std_msgs/Header header
uint8 cells # how many
# what the charger measures [V]
float32 volts 1.5
uint8 FULL=3
"""
PROGRAM = """\
import numpy as np
import rclpy
from example_interfaces.action import Fibonacci
from my_interfaces.msg import Pack
from my_interfaces.srv import GetPacks
from rclpy.node import Node
from sensor_msgs.msg import Imu, LaserScan

rclpy.init()
node = Node("n")
scan = LaserScan(range_max=5)
scan.ranges = np.zeros(3)
scan.ranges = [1.0, 2]
client = node.create_client(GetPacks, "packs")
answer = client.call_async(GetPacks.Request(first=1))
rclpy.spin_until_future_complete(node, answer)
print(answer.result().packs[0].header.stamp.sec, GetPacks.Response().packs[0].volts + Imu().linear_acceleration.x)
print(Fibonacci.Goal(order=3).order, Pack.FULL)
"""
WRONG = """
Pack(cells="three").cels
scan.
"""


@pytest.fixture(scope="module")
def user(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The user's folder, shared by the tests, so that the stubs of the installed version are made only once."""
    return tmp_path_factory.mktemp("user")


@pytest.fixture
def workspace(tmp_path: Path, user: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(user))
    monkeypatch.setattr(discover, "_current", [])
    folder = tmp_path / "ws"
    package = folder / "src" / "my_interfaces"
    for kind in ("msg", "srv"):
        (package / kind).mkdir(parents=True)
    (package / "package.xml").write_text(PACKAGE.format("my_interfaces"))
    (package / "msg" / "Pack.msg").write_text(PACK)
    (package / "srv" / "GetPacks.srv").write_text("uint32 first\n---\nPack[] packs\n")
    (folder / "right.py").write_text(PROGRAM)
    (folder / "wrong.py").write_text(PROGRAM + WRONG)
    return folder


def errors_by_line(server: LanguageServer, file: Path) -> dict[int, list[str]]:
    found: dict[int, list[str]] = {}
    for each in server.reports(file):
        if each["severity"] == 1:
            found.setdefault(each["range"]["start"]["line"] + 1, []).append(each["message"].splitlines()[0])
    return found


@pytest.mark.soak
def test_editor_finds_every_import_offers_fields_and_shows_units(workspace: Path) -> None:
    assert main(["setup", "editor", str(workspace)]) == 0
    if COURSE:
        for each in ("nodes", "launch"):
            shutil.copytree(Path(COURSE, each), workspace / each)
    files = sorted(workspace.rglob("*.py"))
    with language_server(workspace) as server:
        for each in files:
            server.open(each)
        errors = {each.name: found for each in files if (found := errors_by_line(server, each))}
        lines = (PROGRAM + WRONG).splitlines()
        offered = server.at("completion", workspace / "wrong.py", len(lines) - 1, len("scan."))
        hovered = {
            word: server.at("hover", workspace / "right.py", at, PROGRAM.splitlines()[at].index(word) + 1)
            for at, word in ((16, "volts"), (14, "first"), (11, "ranges"))
        }
    assert any("cels" in each for each in errors["wrong.py"][len(lines) - 1])
    assert any("cannot be assigned to parameter" in each for each in errors["wrong.py"][len(lines) - 1])
    del errors["wrong.py"]
    # This listing gives set_parameters messages of rcl_interfaces, which rclpy refuses.
    assert set(errors.pop("dynamic_robot.py", {})) <= {67, 68, 69}
    assert errors == {}
    names = {each["label"] for each in offered["items"]}
    assert names >= {"header", "angle_min", "angle_max", "range_max", "ranges", "intensities"}
    shown = {word: hover["contents"]["value"] for word, hover in hovered.items()}
    assert "what the charger measures [V]" in shown["volts"] and "float32, default 1.5" in shown["volts"]
    assert "range data [m]" in shown["ranges"]


def test_settings_are_completed_and_set_up_again_without_a_change(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = workspace / ".vscode" / "settings.json"
    settings.parent.mkdir()
    settings.write_text('{\n    // mine\n    "editor.rulers": [120],\n}\n')
    (workspace / "pyproject.toml").write_text('[tool.pyright]\ntypeCheckingMode = "strict"\n')
    assert main(["setup", "editor", str(workspace)]) == 0
    pyright = (workspace / "pyrightconfig.json").read_text()
    assert '"extends": "pyproject.toml"' in pyright and "typeCheckingMode" not in pyright
    text = settings.read_text()
    assert "// mine" in text and '"editor.rulers": [120]' in text and "python.analysis.extraPaths" in text
    capsys.readouterr()
    assert main(["setup", "editor", str(workspace)]) == 0
    assert capsys.readouterr().out.count("nothing to change") == 2
    assert settings.read_text() == text


def test_unusable_settings_and_definitions_are_named_and_nothing_is_written(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = workspace / ".vscode" / "settings.json"
    settings.parent.mkdir()
    settings.write_text('{\n"a": }\n')
    assert main(["setup", "editor", str(workspace)]) == 1
    assert "settings.json: line 2: it is not JSON" in capsys.readouterr().err
    settings.unlink()
    (workspace / "src" / "my_interfaces" / "msg" / "Pack.msg").write_text("uint8\n")
    assert main(["setup", "editor", str(workspace)]) == 1
    assert "Pack:1" in capsys.readouterr().err
    assert not (workspace / "pyrightconfig.json").exists() and not settings.exists()
