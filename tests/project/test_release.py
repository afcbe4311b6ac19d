"""A release needs a tag, a version and a section of the changelog that agree."""

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


def test_notes_are_the_section_of_the_version():
    assert release().notes("v1.2.0", "1.2.0", CHANGELOG) == "- new"


@pytest.mark.parametrize(
    ("tag", "version", "changelog", "why"),
    [
        ("v1.2.1", "1.2.0", CHANGELOG, "the tag is v1.2.1, but tui/__init__.py has version 1.2.0"),
        ("v1.3.0", "1.3.0", CHANGELOG, "0 sections '## 1.3.0 - DATE'"),
        ("v1.2.0", "1.2.0", CHANGELOG + "\n## 1.2.0 - again\n", "2 sections"),
        ("v1.2", "1.2", CHANGELOG, "0 sections"),
    ],
)
def test_disagreement_is_reported(tag, version, changelog, why):
    module = release()
    with pytest.raises(module.NoRelease, match=why.replace("(", r"\(")):
        module.notes(tag, version, changelog)


def test_wheel_is_published_by_a_tag_without_a_stored_secret():
    text = (ROOT / ".github" / "workflows" / "publish.yml").read_text()
    assert "id-token: write" in text and "secrets." not in text and "password" not in text
    assert 'tags: ["v*"]' in text and "tools/release.py" in text
