"""The node's own modules are imported separately for each node process."""

from __future__ import annotations

import importlib
import sys
import textwrap

import pytest
from bot_console.runtime.process import entry_point_program
from bot_console.runtime.process.virtual.fresh_import import FreshModules


@pytest.fixture
def folder(tmp_path):
    """A folder with a package and loose modules."""
    write(
        tmp_path,
        {
            "rover/__init__.py": "count = 0",
            "rover/wheels.py": "from . import count\nfrom rover import axle as front\nturns = []",
            "rover/axle.py": "import rover\nimport rover.wheels as w\nowner = rover",
            "rover/deep/__init__.py": "",
            "rover/deep/down.py": "from ..axle import owner\nfrom .. import wheels",
            "rover/star.py": "__all__ = ['a']\na = 1\nb = 2",
            "rover/uses_star.py": "from rover.star import *",
            "rover/lazy.py": "def axle():\n    import rover.axle\n    return rover.axle",
            "rover/dynamic.py": "import importlib\nload = lambda: importlib.import_module('.axle', 'rover')",
            "loose/part.py": "name = 'namespace package'",
            "broken.py": "raise ValueError('broken')",
            "needs_missing.py": "import does_not_exist_anywhere",
        },
    )
    return tmp_path


def write(folder, files):
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))


def test_two_sets_share_only_foreign_modules(folder):
    first, second = (FreshModules([str(folder)]) for _ in range(2))
    a, b = first.load("rover.wheels"), second.load("rover.wheels")
    a.turns.append(1)
    assert b.turns == []
    assert a.front is first.load("rover.axle") is not b.front
    assert a.front.owner is first.load("rover")
    assert vars(first.load("rover.dynamic"))["importlib"] is importlib


def test_relative_and_nested_imports_find_own_modules(folder):
    modules = FreshModules([str(folder)])
    down = modules.load("rover.deep.down")
    assert down.owner is modules.load("rover")
    assert down.wheels is modules.load("rover.wheels")
    assert modules.load("rover").deep.down is down


def test_circular_imports_work(folder):
    modules = FreshModules([str(folder)])
    axle = modules.load("rover.axle")
    assert axle.w.front is axle


def test_star_import_respects_all(folder):
    names = vars(FreshModules([str(folder)]).load("rover.uses_star"))
    assert "a" in names and "b" not in names


def test_late_imports_find_own_modules(folder, run):
    sets = [FreshModules([str(folder)]) for _ in range(2)]
    assert sets[0].load("rover.lazy").axle() is sets[0].load("rover.axle")
    assert sets[1].load("rover.lazy").axle() is sets[1].load("rover.axle")
    found = []

    def target():
        from bot_console.runtime.process import current

        current().modules = sets[0]
        found.append(sets[0].load("rover.dynamic").load())

    run(target)
    assert found == [sets[0].load("rover.axle")]


def test_next_set_sees_changed_files(folder):
    assert FreshModules([str(folder)]).load("rover").count == 0
    write(folder, {"rover/__init__.py": "count = 12345", "added.py": "here = True"})
    modules = FreshModules([str(folder)])
    assert modules.load("rover").count == 12345
    assert modules.load("added").here


def test_folders_without_init_are_packages(folder):
    modules = FreshModules([str(folder)])
    assert modules.load("loose.part").name == "namespace package"


def test_only_names_in_the_folders_are_owned(folder):
    modules = FreshModules([str(folder)], shared=lambda name: name == "broken")
    assert modules.owns("rover.wheels")
    assert not modules.owns("json")
    assert not modules.owns("broken")


def test_sys_modules_does_not_contain_them(folder):
    before = set(sys.modules)
    FreshModules([str(folder)]).load("rover.wheels")
    assert not any(name.startswith("rover") for name in set(sys.modules) - before)


def test_installed_packages_can_be_owned():
    modules = FreshModules(packages=["json"])
    own = modules.load("json.decoder")
    assert own is not importlib.import_module("json.decoder")
    assert modules.load("json").decoder is own


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("rover.nothing", "No module named 'rover.nothing'"),
        ("rover.star.a", "No module named 'rover.star.a'; 'rover.star' is not a package"),
        ("needs_missing", "No module named 'does_not_exist_anywhere'"),
    ],
)
def test_missing_modules_raise_import_errors(folder, name, message):
    with pytest.raises(ModuleNotFoundError) as caught:
        FreshModules([str(folder)]).load(name)
    assert str(caught.value) == message


def test_failed_import_is_forgotten(folder):
    modules = FreshModules([str(folder)])
    for _ in range(2):
        with pytest.raises(ValueError, match="broken"):
            modules.load("broken")


def test_traceback_of_a_failing_import_shows_only_user_files(folder, run):
    write(folder, {"rover/main.py": "import broken\ndef main(): pass"})
    ended = run(entry_point_program("rover.main:main", FreshModules([str(folder)])))
    lines = ended.stderr.splitlines()
    files = [line.split('"')[1] for line in lines if line.startswith("  File")]
    assert files == [str(folder / "rover" / "main.py"), str(folder / "broken.py")]
    assert lines[-1] == "ValueError: broken"
