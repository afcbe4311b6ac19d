"""`ros2 daemon`: there is no daemon, but lines in scripts and tutorials that query, start or stop it still work."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

NOT_NEEDED = "no daemon is started: each program sees the whole graph itself"


def run(words: Sequence[str]) -> int:
    """Answer `ros2 daemon WORDS` as if no daemon were running; always returns 0."""
    parser = argparse.ArgumentParser("ros2 daemon", description="Various daemon related sub-commands")
    verbs = parser.add_subparsers(required=True, metavar="VERB", dest="verb")
    for name, text in (("start", "Start the daemon"), ("status", "Its status"), ("stop", "Stop the daemon")):
        verbs.add_parser(name, help=f"{text}; there is none here")
    if parser.parse_args(words).verb == "start":
        print(NOT_NEEDED, file=sys.stderr)
    else:
        print("The daemon is not running")
    return 0
