"""A release has the version of its tag, and a section in the changelog."""

import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CHANGELOG = (
    "# Changelog\n\n## Unreleased\n\n- later\n\n## 1.2.0 - 2026-12-01\n\n- new\n\n## 1.1.0 - 2026-11-01\n\n- old\n"
)


def release():
    spec = importlib.util.spec_from_file_location("release", ROOT / "tools" / "release.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def tree(tmp_path):
    """A tree whose version is older than the tag."""
    (tmp_path / "tui").mkdir()
    (tmp_path / "tui" / "__init__.py").write_text('"""Text."""\n\n__version__ = "0.1.0"\n')
    (tmp_path / "CHANGELOG.md").write_text(CHANGELOG)
    return tmp_path


def test_version_is_that_of_the_tag_and_notes_are_its_section(tree, capsys):
    assert release().main(["v1.2.0"], tree) == 0
    assert (tree / "tui" / "__init__.py").read_text() == '"""Text."""\n\n__version__ = "1.2.0"\n'
    assert capsys.readouterr().out == "- new\n"


def test_this_tree_has_the_line_that_is_replaced():
    assert len(release().VERSION.findall((ROOT / "tui" / "__init__.py").read_text("utf-8"))) == 1


@pytest.mark.parametrize(
    ("tag", "changelog", "why"),
    [
        ("1.2.0", CHANGELOG, "the tag is 1.2.0, which names no version"),
        ("v1.2", CHANGELOG, "the tag is v1.2, which names no version"),
        ('v1.2.0"; x', CHANGELOG, "which names no version"),
        ("v1.3.0", CHANGELOG, "0 sections '## 1.3.0 - DATE'"),
        ("v1.2.0", CHANGELOG + "\n## 1.2.0 - again\n", "2 sections"),
    ],
)
def test_tag_that_cannot_be_released_changes_nothing_and_is_reported(tree, capsys, tag, changelog, why):
    (tree / "CHANGELOG.md").write_text(changelog)
    assert release().main([tag], tree) == 1
    assert why in capsys.readouterr().err
    assert '"0.1.0"' in (tree / "tui" / "__init__.py").read_text()


def test_wheel_is_published_by_a_tag_without_a_stored_secret():
    text = (ROOT / ".github" / "workflows" / "publish.yml").read_text()
    assert "id-token: write" in text and "secrets." not in text and "password" not in text
    assert 'tags: ["v*"]' in text and "tools/release.py" in text
