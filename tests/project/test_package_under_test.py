"""Tests refuse to run against a package that is not that of their checkout."""

from collections.abc import Callable
from pathlib import Path

import pytest
from package_under_test import FOLDERS, difference


@pytest.fixture
def trees(tmp_path: Path) -> tuple[Path, Path]:
    """An installed package and the checkout from which it was installed."""
    made = tmp_path / "site-packages" / "bot_console", tmp_path / "checkout"
    for tree in made:
        for folder in FOLDERS:
            (tree / folder / "part").mkdir(parents=True)
            (tree / folder / "part" / "module.py").write_text("VALUE = 1\n")
    return made


def test_copy_of_the_checkout_is_accepted(trees: tuple[Path, Path]) -> None:
    package, checkout = trees
    generated = package / "runtime" / "rosidl" / "generated"
    generated.mkdir(parents=True)
    (generated / "made_by_the_build.py").touch()
    (checkout / "tui" / "notes.txt").touch()
    assert difference(package, checkout) == ""


def test_links_to_the_checkout_are_accepted(trees: tuple[Path, Path], tmp_path: Path) -> None:
    _, checkout = trees
    package = tmp_path / "editable"
    package.mkdir()
    for folder in FOLDERS:
        (package / folder).symlink_to(checkout / folder)
    assert difference(package, checkout) == ""


@pytest.mark.parametrize(
    ("change", "named"),
    [
        (lambda package, checkout: (checkout / "runtime/part/module.py").write_text("VALUE = 2\n"), "part/module.py"),
        (lambda package, checkout: (checkout / "nodes/new.py").touch(), "nodes/new.py"),
        (lambda package, checkout: (checkout / "launch/part/module.py").unlink(), "launch/part/module.py"),
    ],
    ids=["edited", "added", "removed"],
)
def test_copy_from_before_a_change_is_named(
    trees: tuple[Path, Path], change: Callable[[Path, Path], object], named: str
) -> None:
    change(*trees)
    found = difference(*trees)
    assert named in found and "install the project again" in found
