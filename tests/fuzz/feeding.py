"""Feeds one parser and collects every outcome except refusals."""

from __future__ import annotations

import signal
import time
import traceback
from pathlib import Path
from typing import Any

from targets import Target, inputs_of

LIMIT = 5.0
"""Seconds of CPU time that one input may take."""
SHOWN = 300
"""Characters of an input that are shown."""


class Hang(BaseException):
    """An input took too long."""


def feed(target: Target, count: int, seed: int, findings: dict[str, dict[str, Any]]) -> float:
    """Feed one parser; return the seconds of CPU time it took."""
    began = time.process_time()
    for number, text in enumerate(inputs_of(target, seed)):
        if number >= count:
            break
        signal.setitimer(signal.ITIMER_VIRTUAL, LIMIT)
        try:
            target.run(text)
        except target.refusals:
            pass
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            _record_finding(target.name, error, text, findings)
        finally:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    return time.process_time() - began


def _record_finding(name: str, error: BaseException, text: str, findings: dict[str, dict[str, Any]]) -> None:
    frames = [each for each in traceback.extract_tb(error.__traceback__) if "bot_console" in each.filename]
    where = frames[-1] if frames else traceback.extract_tb(error.__traceback__)[-1]
    kind = f"{name}: {type(error).__name__} at {Path(where.filename).name}:{where.lineno}"
    known = findings.setdefault(kind, {"times": 0, "input": text, "error": str(error)[-SHOWN:]})
    known["times"] += 1
    known["input"] = min(known["input"], text, key=len)
