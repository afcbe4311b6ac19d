"""`ros2 daemon`: there is none, and lines of scripts and tutorials that ask for it, start it or stop it go on."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

NOT_NEEDED = "no daemon is started: each program sees the whole graph itself"


def run(words: Sequence[str]) -> int:
    """Answer `ros2 daemon WORDS` as where none runs; always 0."""
    parser = argparse.ArgumentParser("ros2 daemon", description="Various daemon related sub-commands")
    verbs = parser.add_subparsers(required=True, metavar="VERB", dest="verb")
    for name, text in (("start", "Start the daemon"), ("status", "Its status"), ("stop", "Stop the daemon")):
        verbs.add_parser(name, help=f"{text}; there is none here")
    if parser.parse_args(words).verb == "start":
        print(NOT_NEEDED, file=sys.stderr)
    else:
        print("The daemon is not running")
    return 0
