"""Parse texts that contain `$(name argument ...)`."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, cast

from launch.frontend.expose import substitution_parse_methods

if TYPE_CHECKING:
    from launch.substitution import Substitution

NAME = re.compile(r"[a-zA-Z0-9_\-]+")

# From this nesting depth on, the text is blamed for a stack overflow; the usual stack allows about 200 levels.
MANY_IN_ONE_ANOTHER = 20


class UnexpectedCharacters(ValueError):
    """A character is not allowed at its position."""


class UnexpectedEOF(ValueError):
    """A text ends too early."""


class VisitError(ValueError):
    """A substitution has an unknown name, or arguments it does not accept."""

    def __init__(self, cause: Exception) -> None:
        super().__init__(f'Error trying to process rule "substitution":\n{cause}')


def replace_escaped_characters(data: str) -> str:
    """Remove the backslashes that escape the following character."""
    return re.sub(r"\\(.)", r"\1", data)


def parse_substitution(string_value: str) -> list[Substitution]:
    """Parse a text into substitutions; raises `ValueError` if it is malformed."""
    from launch.substitutions.text_substitution import TextSubstitution

    if not string_value:
        return [TextSubstitution(text="")]
    reader = _Reader(string_value)
    try:
        return reader.pieces("")
    except RecursionError:
        if reader.deepest < MANY_IN_ONE_ANOTHER:
            raise  # the callers have used up the stack, e.g. a launch file that includes itself
        raise ValueError(f"{string_value[:40]!r}... has too many substitutions in one another") from None


def parse_if_substitutions(value: object) -> Any:
    """Parse a text, or each text of a list, that contains substitutions; other texts and values are returned as they
    are.

    Raises `ValueError` for a list whose plain values differ in type.
    """
    if not isinstance(value, list):
        return _parse_if_needed(value)
    items = cast("list[Any]", value)
    found = [_parse_if_needed(each) for each in items]
    kinds: set[type] = {type(each) for each in found}
    if len(kinds - {list}) > 1:
        raise ValueError("The result is a non-uniform list")
    return found


def _parse_if_needed(value: object) -> Any:
    from launch.substitutions.text_substitution import TextSubstitution

    if not isinstance(value, str):
        return value
    found = parse_substitution(value)
    return found[0].text if len(found) == 1 and isinstance(found[0], TextSubstitution) else found


def _substitution(name: str, arguments: list[list[Substitution]]) -> Substitution:
    method = substitution_parse_methods.get(name)
    if method is None:
        raise RuntimeError(f"Unknown substitution: {name}")
    kind, options = method(arguments)
    return kind(**options)


class _Reader:
    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._depth = 0
        self.deepest = 0
        """The deepest nesting of substitutions read so far."""

    def pieces(self, ends: str, quote: str = "") -> list[Substitution]:
        """Read texts and substitutions up to a character in `ends`, or to the end; `quote` is the enclosing quote."""
        from launch.substitutions.text_substitution import TextSubstitution

        found: list[Substitution] = []
        plain = ""
        while self._at < len(self._text) and self._text[self._at] not in ends:
            if self._text.startswith("$(", self._at):
                if plain:
                    found.append(TextSubstitution(text=replace_escaped_characters(plain)))
                plain = ""
                found.append(self._substitution(quote))
                continue
            width = 2 if self._text[self._at] == "\\" else 1
            plain += self._text[self._at : self._at + width]
            self._at += width
        if plain:
            found.append(TextSubstitution(text=replace_escaped_characters(plain)))
        return found

    def _substitution(self, quote: str) -> Substitution:
        self._at += len("$(")
        name = NAME.match(self._text, self._at)
        if name is None:
            raise self._unexpected("the name of a substitution")
        self._at = name.end()
        arguments: list[list[Substitution]] = []
        self._depth += 1
        self.deepest = max(self.deepest, self._depth)
        while not self._take(")"):
            if not self._take(" "):
                raise self._unexpected("a space or ')'")
            arguments.append(self._quoted_argument() if not quote else self._plain_argument(quote))
        self._depth -= 1
        try:
            return _substitution(name[0], arguments)
        except Exception as error:  # the substitution's own message under upstream's heading
            raise VisitError(error) from error

    def _quoted_argument(self) -> list[Substitution]:
        from launch.substitutions.text_substitution import TextSubstitution

        for quote in "\"'":
            if self._take(quote):
                found = self.pieces(quote, quote)
                if not self._take(quote):
                    raise self._unexpected(f"a closing {quote}")
                return found or [TextSubstitution(text="")]
        return self._plain_argument("\"'")

    def _plain_argument(self, quotes: str) -> list[Substitution]:
        """Read an argument up to a space or parenthesis; quotes other than the enclosing ones are plain text."""
        found = self.pieces(f" (){quotes}", quotes if len(quotes) == 1 else "")
        if not found:
            raise self._unexpected("an argument (exactly one space stands before each)")
        return found

    def _take(self, character: str) -> bool:
        if self._text.startswith(character, self._at):
            self._at += 1
            return True
        return False

    def _unexpected(self, wanted: str) -> ValueError:
        if self._at >= len(self._text):
            return UnexpectedEOF(f"{self._text!r} ends where {wanted} is expected")
        return UnexpectedCharacters(
            f"No terminal matches '{self._text[self._at]}' in {self._text!r} at column {self._at + 1}: "
            f"{wanted} is expected"
        )
