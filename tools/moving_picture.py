"""Makes the animation of the README from a real run: a value is refused, another one slows the robot, and is undone.

python tools/moving_picture.py [docs/images]

It is an SVG whose frames a style sheet shows one after the other; for readers who prefer reduced motion, only the last.
"""

from __future__ import annotations

import asyncio
import contextlib
import re
import sys
from pathlib import Path

from screenshots import FOLDER, Photographer, main

SIZE = (104, 26)
NAME = "tuning-loop"
OUTER = re.compile(r'<svg class="rich-terminal" viewBox="([^"]+)"[^>]*>')


class Film:
    """Frames with their durations (s)."""

    def __init__(self, at: Photographer) -> None:
        self._at = at
        self._frames: list[tuple[str, float]] = []

    def take(self, seconds: float) -> None:
        """Add the screen as a frame that is shown for `seconds`."""
        self._frames.append((self._at.picture(f"f{len(self._frames)}-"), seconds))

    def svg(self) -> str:
        """All frames in one picture, in a loop."""
        total = sum(seconds for _, seconds in self._frames)
        view = next(iter(OUTER.findall(self._frames[0][0])))
        styles = [".frame { visibility: hidden }"]
        groups: list[str] = []
        begin = 0.0
        for number, (frame, seconds) in enumerate(self._frames):
            first, last = 100 * begin / total, 100 * (begin + seconds) / total
            shown = (
                f"0%, {last:.2f}% {{ visibility: visible }}"
                if not number
                else (f"0% {{ visibility: hidden }} {first:.2f}%, {last:.2f}% {{ visibility: visible }}")
            )
            styles.append(
                f"@keyframes show{number} {{ {shown} {min(last + 0.01, 100.0):.2f}%, 100% {{ visibility: hidden }} }}"
                if number < len(self._frames) - 1
                else f"@keyframes show{number} {{ {shown} }}"
            )
            styles.append(f"#frame{number} {{ animation: show{number} {total:g}s step-end infinite }}")
            groups.append(f'<g class="frame" id="frame{number}">\n{OUTER.sub("", frame).replace("</svg>", "")}</g>')
            begin += seconds
        still = f"#frame{len(self._frames) - 1} {{ visibility: visible }}"
        styles.append(f"@media (prefers-reduced-motion) {{ .frame {{ animation: none !important }} {still} }}")
        head = f'<svg class="rich-terminal" viewBox="{view}" xmlns="http://www.w3.org/2000/svg">'
        return "\n".join([head, "<style>", *styles, "</style>", *groups, "</svg>\n"])


async def tune(at: Photographer) -> None:
    """Set a value that is refused, then a lower one, and undo it."""
    film = Film(at)
    await at.drive(10.0)
    await at.select("max_speed")
    await at.drive(1.0)
    film.take(2.0)
    await at.press("enter", *["backspace"] * 5, "9")
    film.take(1.2)
    await at.press("enter", "1")
    await at.drive(1.0)
    film.take(3.0)
    await at.press("0", "escape", "enter", *["backspace"] * 5, "0", "full_stop", "4")
    film.take(1.2)
    await at.press("enter")
    await at.drive(2.0)
    film.take(1.5)
    await at.drive(5.0)
    film.take(3.0)
    await at.press("u")
    await at.drive(6.0)
    film.take(3.5)
    at.save(NAME, film.svg())


if __name__ == "__main__":
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(main(Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER, tune, SIZE))
