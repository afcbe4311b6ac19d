"""The changelog has one entry per fact: a merge can bring back an old wording beside the new one."""

import re
from itertools import combinations
from pathlib import Path

CHANGELOG = (Path(__file__).resolve().parents[2] / "CHANGELOG.md").read_text(encoding="utf-8")
ENTRY = re.compile(r"^- .*(?:\n  .*)*", re.MULTILINE)
WORD = re.compile(r"[\w:/~-]{4,}")
SAME_FACT = 0.75
"""Share of common words from which two entries count as one fact: different facts stay below 0.65."""
MIN_WORDS = 6


def repeated(text):
    """The pairs of entries that have most of their words in common, by their first lines."""
    entries = [(entry.split("\n")[0], set(WORD.findall(entry.lower()))) for entry in ENTRY.findall(text)]
    return [
        (first, second)
        for (first, words), (second, others) in combinations(entries, 2)
        if (fewest := min(len(words), len(others))) >= MIN_WORDS and len(words & others) / fewest >= SAME_FACT
    ]


def test_no_fact_is_listed_twice():
    assert repeated(CHANGELOG) == []


def test_no_group_occurs_twice():
    groups = re.findall(r"^#+ .+$", CHANGELOG, re.MULTILINE)
    assert len(groups) == len(set(groups))


def test_reworded_fact_is_noticed():
    again = "- History (`H`): every change and refusal, also of earlier runs; back to a row; export as CSV or YAML.\n"
    assert len(repeated(CHANGELOG + again)) == 1
