"""Says how many rows of the course page the tests covered and how many were skipped; reads a JUnit file.

Run as the last step of the checks: `python tests/course/count_rows.py junit.xml`.
"""

import sys
import xml.etree.ElementTree as ElementTree


def main(path: str) -> None:
    """Print one line."""
    cases = [each for each in ElementTree.parse(path).iter("testcase") if "course" in (each.get("classname") or "")]
    skipped = sum(each.find("skipped") is not None for each in cases)
    print(f"course rows: {len(cases) - skipped} checked, {skipped} skipped")


if __name__ == "__main__":
    main(sys.argv[1])
