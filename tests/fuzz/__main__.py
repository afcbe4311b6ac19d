"""Feeds mutated inputs to every parser: `python tests/fuzz [--inputs 1000000] [--seed 1] [--only filter]`.

An input is a finding if it causes anything but a refusal, or takes longer than five seconds of CPU time. Prints JSON:
for each parser the number of inputs and the time they took, and the findings with the shortest input of each. The same
seed gives the same inputs. The exit code is 1 if there are findings.
"""

from __future__ import annotations

import argparse
import json
import logging
import os
import shutil
import signal
import sys
from collections.abc import Sequence
from pathlib import Path
from types import FrameType
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))
from feeding import LIMIT, SHOWN, Hang, feed
from files import FOLDER
from targets import targets


def run(inputs: int, seed: int, only: Sequence[str] = ()) -> dict[str, Any]:
    """Feed all parsers, or those whose names contain one of the words in `only`, with `inputs` inputs in total."""
    from bot_console.runtime.importer import install

    install()
    os.environ["BOT_CONSOLE_USER_DIR"] = str(FOLDER / "user")
    logging.disable(logging.CRITICAL)

    def hang(number: int, frame: FrameType | None) -> None:
        where = f"{frame.f_code.co_filename}:{frame.f_lineno}" if frame else "an unknown place"
        raise Hang(f"longer than {LIMIT:g} s, at {where}")

    before = signal.signal(signal.SIGVTALRM, hang)

    chosen = [each for each in targets() if not only or any(word in each.name for word in only)]
    findings: dict[str, dict[str, Any]] = {}
    report: dict[str, dict[str, float]] = {}
    shares = [each.share for each in chosen]
    try:
        for index, target in enumerate(chosen):
            before_it, with_it = (round(inputs * sum(shares[:end]) / sum(shares)) for end in (index, index + 1))
            count = with_it - before_it
            seconds = feed(target, count, seed, findings)
            report[target.name] = {"inputs": count, "CPU s": round(seconds, 1)}
            print(f"{target.name}: {count} inputs, {seconds:.1f} s, {len(findings)} findings", file=sys.stderr)
    finally:
        signal.signal(signal.SIGVTALRM, before)
        logging.disable(logging.NOTSET)
        shutil.rmtree(FOLDER, ignore_errors=True)
    for each in findings.values():
        each["input"] = ascii(each["input"])[:SHOWN]
    return {"seed": seed, "inputs": inputs, "parsers": report, "findings": findings}


def main() -> None:
    """Run according to the command line."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--inputs", type=int, default=1_000_000, help="in all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="*", default=(), help="words of the names of parsers")
    parser.add_argument("--report", type=Path, help="file for the report; standard output unless given")
    parser.add_argument("--nice", type=int, default=0)
    options = parser.parse_args()
    os.nice(options.nice)
    report = run(options.inputs, options.seed, options.only)
    text = json.dumps(report, indent=2)
    if options.report:
        options.report.write_text(text)
    else:
        print(text)
    sys.exit(bool(report["findings"]))


if __name__ == "__main__":
    main()
