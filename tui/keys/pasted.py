"""Pasted text without escapes.

Textual looks for keys after an Esc inside of a paste, too, and hands on as keys what is none: a text with colours in it
would change panes, or release the robot.
"""

from __future__ import annotations

ESC = "\x1b"
BEGIN, END = f"{ESC}[200~", f"{ESC}[201~"
"""What a terminal puts around a paste."""


class Pasted:
    """Removes each Esc from pasted text; typed keys pass unchanged and at once."""

    def __init__(self) -> None:
        self._inside = False
        self._before = ""
        """The end of what has passed, which may be the first part of `BEGIN`."""
        self._held = ""
        """The end of a paste so far that may be the first part of `END`."""

    def without_escapes(self, text: str) -> str:
        """The next characters from the terminal, which may stop anywhere."""
        passed: list[str] = []
        while text:
            take = self._take_pasted if self._inside else self._take_typed
            text = take(text, passed)
        return "".join(passed)

    def _take_typed(self, text: str, passed: list[str]) -> str:
        seen = self._before + text
        at = seen.find(BEGIN)
        if at < 0:
            passed.append(text)
            self._before = seen[1 - len(BEGIN) :]
            return ""
        end = at + len(BEGIN) - len(self._before)
        passed.append(text[:end])
        self._inside, self._before = True, ""
        return text[end:]

    def _take_pasted(self, text: str, passed: list[str]) -> str:
        body, end, rest = (self._held + text).partition(END)
        self._held = ""
        if end:
            self._inside = False
        else:
            self._held = next((END[:n] for n in range(len(END) - 1, 0, -1) if body.endswith(END[:n])), "")
            body = body.removesuffix(self._held)
        passed.append(body.replace(ESC, "") + end)
        return rest
