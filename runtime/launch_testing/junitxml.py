"""Reports for JUnit."""

from __future__ import annotations

import time
import unittest
from typing import Any
from xml.etree import ElementTree


class TimedResult(unittest.TextTestResult):
    """A result that records its tests and their durations (s)."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.seconds: dict[unittest.TestCase, float] = {}
        self._begin = 0.0

    def startTest(self, test: unittest.TestCase) -> None:
        """Record the start of a test."""
        self._begin = time.monotonic()
        super().startTest(test)

    def stopTest(self, test: unittest.TestCase) -> None:
        """Record the end of a test."""
        self.seconds[test] = time.monotonic() - self._begin
        super().stopTest(test)


def write_report(path: str, name: str, result: TimedResult) -> None:
    """Write the outcomes of a result's tests, including those that never began, for example because the launch died."""
    reported = [("failure", result.failures), ("error", result.errors), ("skipped", result.skipped)]
    tests = list(dict.fromkeys([*result.seconds, *(test for _, pairs in reported for test, _ in pairs)]))
    numbers = {
        "tests": str(len(tests)),
        "failures": str(len(result.failures)),
        "errors": str(len(result.errors)),
        "time": str(round(sum(result.seconds.values()), 3)),
    }
    root = ElementTree.Element("testsuites", {"name": name, **numbers})
    skipped = {"skipped": str(len(result.skipped))}
    suite = ElementTree.SubElement(root, "testsuite", {"name": f"{name}.launch_tests", **numbers, **skipped})
    for test in tests:
        where, _, method = test.id().rpartition(".")
        seconds = str(round(result.seconds.get(test, 0.0), 3))
        case = ElementTree.SubElement(suite, "testcase", {"classname": where, "name": method, "time": seconds})
        for kind, pairs in reported:
            for text in (text for which, text in pairs if which is test):
                ElementTree.SubElement(case, kind, {"message": text})
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)
