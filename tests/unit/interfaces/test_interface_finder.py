"""Interfaces of workspace packages, imported from source."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.rosidl.cdr import deserialize, serialize
from bot_console.runtime.rosidl.texts import interface_names
from bot_console.runtime.workspace import discover
from bot_console.runtime.workspace.discover import Workspace, default_folders

XML = "<package format='3'><name>{}</name><export><build_type>ament_cmake</build_type></export></package>"
FILES = {
    "finder_msgs/msg/Num.msg": "int64 num 7\n",
    "finder_msgs/msg/Sphere.msg": "geometry_msgs/Point center\nNum[] nums\nuint8 KIND=3\n",
    "finder_msgs/msg/Bad.msg": "int32 good\nint32 badName\n",
    "finder_msgs/srv/AddThree.srv": "int64 a\n---\nint64 sum\n",
    "finder_msgs/action/Roll.action": "int32 goal\n---\n---\nfinder_msgs/Sphere sphere\n",
    "finder_more/msg/Outer.msg": "finder_msgs/Sphere sphere\n",
    "turtlesim/msg/Shell.msg": "float32 width\n",
    "finder_mixed/msg/Own.msg": "string text\n",
    "finder_mixed/finder_mixed/__init__.py": "HERE = 1\n",
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    for name, text in FILES.items():
        path = tmp_path / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    for name in ("finder_msgs", "finder_more", "finder_mixed", "turtlesim"):
        (tmp_path / "src" / name / "package.xml").write_text(XML.format(name))
    monkeypatch.setattr(discover, "_current", [Workspace(default_folders(tmp_path))])
    for name in [each for each in sys.modules if each.startswith("turtlesim")]:
        monkeypatch.delitem(sys.modules, name)
    # Where the interpreter would take the folder for a namespace package.
    monkeypatch.syspath_prepend(str(tmp_path / "src"))
    yield tmp_path / "src"
    for name in [each for each in sys.modules if each.startswith(("finder_m", "turtlesim"))]:
        del sys.modules[name]


def test_messages_services_and_actions_are_imported(folder: Path) -> None:
    from finder_msgs.action import Roll  # type: ignore[import-not-found]
    from finder_msgs.msg import Num, Sphere  # type: ignore[import-not-found]
    from finder_msgs.srv import AddThree  # type: ignore[import-not-found]

    assert repr(Sphere(nums=[Num()])) == (
        "finder_msgs.msg.Sphere(center=geometry_msgs.msg.Point(x=0.0, y=0.0, z=0.0), nums=[finder_msgs.msg.Num(num=7)])"
    )
    assert Sphere.KIND == 3
    assert AddThree.Response(sum=1).sum == 1
    assert Roll.Feedback().sphere == Sphere()
    assert deserialize(serialize(Sphere(nums=[Num(num=1)])), Sphere).nums == [Num(num=1)]


def test_package_may_use_another_packages_messages(folder: Path) -> None:
    outer = importlib.import_module("finder_more.msg").Outer()
    assert type(outer.sphere).__module__ == "finder_msgs.msg._sphere"


def test_python_package_of_the_same_name_has_its_messages_too(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(folder / "finder_mixed"))
    assert importlib.import_module("finder_mixed").HERE == 1
    assert importlib.import_module("finder_mixed.msg").Own(text="a").text == "a"


def test_invalid_definition_is_reported_with_its_line(folder: Path) -> None:
    module = importlib.import_module("finder_msgs.msg")
    with pytest.raises(ImportError) as caught:
        _ = module.Bad
    assert str(caught.value).startswith(f"{folder}/finder_msgs/msg/Bad.msg:2: 'badName' is not a field name")


def test_workspace_package_takes_precedence_over_the_tutorials(folder: Path) -> None:
    assert importlib.import_module("turtlesim.msg").Shell().width == 0.0
    assert interface_names("turtlesim") == ["msg/Shell"]


def test_missing_interfaces_raise_import_errors(folder: Path) -> None:
    with pytest.raises(ImportError, match="cannot import name 'Nope'"):
        from finder_msgs.msg import Nope  # type: ignore[import-not-found]  # noqa: F401
    with pytest.raises(ModuleNotFoundError, match=r"No module named 'finder_more\.srv'"):
        importlib.import_module("finder_more.srv")
    with pytest.raises(ModuleNotFoundError, match="No module named 'finder_nowhere'"):
        importlib.import_module("finder_nowhere")
