"""Sets the program's version to that of a tag, and prints its section of the changelog.

    python tools/release.py v0.1.0

Prints the reason and exits with 1 if the tag names no version, or `CHANGELOG.md` has no section for it.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


TAG = re.compile(r"v(\d+\.\d+\.\d+(?:(?:a|b|rc)\d+)?)")
VERSION = re.compile(r'^__version__ = ".+"$', re.MULTILINE)


class NoRelease(ValueError):
    """The tag cannot be released; the message says why."""


def version_of(tag: str) -> str:
    """The version that a tag names; raises `NoRelease`."""
    named = TAG.fullmatch(tag)
    if named is None:
        raise NoRelease(f"the tag is {tag}, which names no version; tags are like v1.2.0 or v1.2.0rc1")
    return named[1]


def notes(version: str, changelog: str) -> str:
    """The section of the changelog for a version; raises `NoRelease`."""
    sections = re.split(r"^## ", changelog, flags=re.MULTILINE)[1:]
    found = [text for text in sections if re.match(rf"\[?{re.escape(version)}\]?(?: |$)", text.splitlines()[0])]
    if len(found) != 1:
        raise NoRelease(f"CHANGELOG.md has {len(found)} sections '## {version} - DATE'; it needs one")
    return found[0].partition("\n")[2].strip()


def main(words: list[str], root: Path = ROOT) -> int:
    """Write the version and print the notes, or print why there are none."""
    if len(words) != 1:
        print("usage: python tools/release.py TAG", file=sys.stderr)
        return 2
    module = root / "tui" / "__init__.py"
    try:
        version = version_of(words[0])
        text = notes(version, (root / "CHANGELOG.md").read_text(encoding="utf-8"))
    except NoRelease as error:
        print(error, file=sys.stderr)
        return 1
    module.write_text(VERSION.sub(f'__version__ = "{version}"', module.read_text(encoding="utf-8")), encoding="utf-8")
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
