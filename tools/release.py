"""Checks that a tag names the version of the program, and prints what the changelog says about it.

    python tools/release.py v0.1.0

Ends with 1 and the reason if the tag, `tui/__init__.py` and `CHANGELOG.md` do not agree.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


class NoRelease(ValueError):
    """The tag cannot be released."""


def notes(tag: str, version: str, changelog: str) -> str:
    """The section of the changelog for a tag; raises `NoRelease`."""
    if tag != f"v{version}":
        raise NoRelease(f"the tag is {tag}, but tui/__init__.py has version {version}: tag v{version}")
    sections = re.split(r"^## ", changelog, flags=re.MULTILINE)[1:]
    found = [text for text in sections if re.match(rf"\[?{re.escape(version)}\]?(?: |$)", text.splitlines()[0])]
    if len(found) != 1:
        raise NoRelease(f"CHANGELOG.md has {len(found)} sections '## {version} - DATE'; it needs one")
    return found[0].partition("\n")[2].strip()


def main(words: list[str]) -> int:
    """Print the notes, or why there are none."""
    if len(words) != 1:
        print("usage: python tools/release.py TAG", file=sys.stderr)
        return 2
    text = (ROOT / "tui" / "__init__.py").read_text(encoding="utf-8")
    version = re.search(r'^__version__ = "(.+)"$', text, re.MULTILINE)
    try:
        if version is None:
            raise NoRelease("tui/__init__.py has no version")
        print(notes(words[0], version[1], (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")))
    except NoRelease as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
