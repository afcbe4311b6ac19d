"""Says how many rows of the course page the tests covered, and how many were skipped for which reason.

Reads a JUnit file; run as the last step of the checks: `python tests/course/count_rows.py junit.xml`.
"""

import sys
import xml.etree.ElementTree as ElementTree
from collections import Counter


def main(path: str) -> None:
    """Print one line, and one for each reason."""
    cases = [
        each for each in ElementTree.parse(path).iter("testcase") if (each.get("name") or "").startswith("test_row[C")
    ]
    skipped = [each.find("skipped") for each in cases]
    reasons = Counter(str(each.get("message")) for each in skipped if each is not None)
    print(f"course rows: {len(cases) - sum(reasons.values())} checked, {sum(reasons.values())} skipped")
    for reason, count in reasons.most_common():
        print(f"  {count:3} {reason}")


if __name__ == "__main__":
    main(sys.argv[1])
