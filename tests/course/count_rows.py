"""Prints how many rows of the course page the tests covered, and how many were skipped for which reason.

Reads the JUnit files of the default run and of any further runs, since rows may name tests of those; it is the last
step of the checks: `python tests/course/count_rows.py junit.xml junit-slow.xml`.
"""

import sys
import xml.etree.ElementTree as ElementTree
from collections import Counter
from collections.abc import Iterable, Sequence


def main(paths: Sequence[str]) -> str:
    """Print one line, and one for each reason; return what is wrong with the tests that rows name, or an empty text."""
    tests = [each for path in paths for each in ElementTree.parse(path).iter("testcase")]
    cases = [each for each in tests if (each.get("name") or "").startswith("test_row_of_the_course_holds[C")]
    skipped = [each.find("skipped") for each in cases]
    reasons = Counter(str(each.get("message")) for each in skipped if each is not None)
    named = [str(each.get("value")) for case in cases for each in case.iter("property")]
    numbers = len(cases) - sum(reasons.values()) - len(named), len(named), sum(reasons.values())
    print("course rows: {} checked, {} shown by tests of screens, {} skipped".format(*numbers))
    for reason, count in reasons.most_common():
        print(f"  {count:3} {reason}")
    missing = sorted(set(named) - passed(tests))
    return "\n".join(f"{each} shows rows of the course, and was not run or did not pass" for each in missing)


def passed(tests: Iterable[ElementTree.Element]) -> set[str]:
    """The ids of all tests that passed, without their parameters."""
    bad = {"skipped", "failure", "error"}
    found = [each for each in tests if not bad & {part.tag for part in each}]
    names = ((each.get("classname", "").replace(".", "/"), each.get("name", "").partition("[")[0]) for each in found)
    return {f"{path}.py::{name}" for path, name in names}


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]) or 0)
