"""Content filters: expressions in the SQL subset of DDS that decide which messages a subscription keeps.

The rules are those of Fast DDS: AND and OR bind equally, from left to right; a field is compared with a value, a
parameter or another field; LIKE takes `%` or `*` for any text and `_` or `?` for one character, MATCH a regular
expression for the whole text; BETWEEN includes both ends.
"""

from __future__ import annotations

import operator
import re
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from importlib import import_module
from typing import Any

from bot_console.runtime.rmw.endpoints import HeldMessage, Payload
from bot_console.runtime.rosidl.cdr import CdrError, deserialize

MAX_PARAMETERS = 100
"""The limit of rcl."""

Read = Callable[[Payload], Any]
Accepts = Callable[[Payload], bool]

_TOKEN = re.compile(
    r"\s*(?:(?P<number>[+-]?(?:0[xX][0-9a-fA-F]+|\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)(?![\w.]))"
    r"|(?P<text>[`'][^'\n]*')|%(?P<parameter>\d{1,2})(?!\d)|(?P<sign><=|>=|<>|!=|=|<|>|\(|\))"
    r"|(?P<word>[A-Za-z_]\w*(?:\[\d+\])?(?:\.[A-Za-z_]\w*(?:\[\d+\])?)*))"
)
_COMPARE: dict[str, Callable[[Any, Any], bool]] = {
    "=": operator.eq,
    "<>": operator.ne,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
_MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
_TRUTH = ("TRUE", "FALSE")
_KEYWORDS = frozenset(("AND", "OR", "NOT", "BETWEEN", "LIKE", "MATCH", *_TRUTH))
_END = ("end", "")


class ContentFilterError(ValueError):
    """The expression or its parameters are invalid."""


class FilteredQueue(deque[Any]):
    """The queue of a subscription with a content filter: messages that the filter rejects take up no room in it."""

    def __init__(self, entries: Iterable[Any], maxlen: int | None, accepts: Accepts, message_class: object) -> None:
        self._accepts = accepts
        self._class = message_class
        super().__init__((), maxlen)
        for entry in entries:
            self.append(entry)

    def append(self, entry: Any, /) -> None:
        """Add an entry if its message is accepted; an unreadable message has already been reported, and is left out."""
        message = entry[0]
        if isinstance(message, HeldMessage):
            message = message.peek()
        elif isinstance(message, bytes):
            try:
                message = deserialize(message, self._class)
            except CdrError:  # as without a filter, the error is left to whoever deserializes the message
                super().append(entry)
                return
        if message is not None and self._accepts(message):
            super().append(entry)


def compile_filter(expression: str, parameters: Sequence[str], message_class: object) -> Accepts:
    """Return the predicate for messages of a class; raises `ContentFilterError`. An empty expression accepts all."""
    if not expression:
        return lambda message: True
    try:
        return _Parser(expression, parameters, message_class).predicate()
    except RecursionError:
        raise ContentFilterError("it is nested too deeply") from None


class _Parser:
    """A recursive-descent parser for the tokens of one expression."""

    def __init__(self, expression: str, parameters: Sequence[str], message_class: object) -> None:
        self._class = message_class
        self._parameters = parameters
        self._tokens = [*_tokens(expression), _END]
        self._at = 0

    def predicate(self) -> Accepts:
        accepts = self._condition()
        if self._next() != _END:
            self._at -= 1
            raise ContentFilterError(f"'{self._tokens[self._at][1]}' is not expected there")
        return accepts

    def _next(self) -> tuple[str, str]:
        token = self._tokens[self._at]
        self._at = min(self._at + 1, len(self._tokens) - 1) if token != _END else self._at
        return token

    def _accept_word(self, *words: str) -> str:
        """Take the next token if it is one of the words, given in capitals; returns the word, or nothing."""
        kind, text = self._tokens[self._at]
        if kind in ("word", "sign") and text.upper() in words:
            self._at += 1
            return text.upper()
        return ""

    def _expect(self, word: str) -> None:
        if not self._accept_word(word):
            raise ContentFilterError(f"'{word}' is missing before {_quote(self._tokens[self._at][1])}")

    def _condition(self) -> Accepts:
        left = self._negation()
        while joint := self._accept_word("AND", "OR"):
            left = _combine(joint, left, self._negation())
        return left

    def _negation(self) -> Accepts:
        if self._accept_word("NOT"):
            inner = self._negation()
            return lambda message: not inner(message)
        if self._accept_word("("):
            inner = self._condition()
            self._expect(")")
            return inner
        return self._comparison()

    def _comparison(self) -> Accepts:
        kind, text = self._next()
        if kind == "word" and text.upper() not in _KEYWORDS:
            read, is_text = _field(text, self._class)
            return self._of_field(text, read, is_text)
        value = self._value(kind, text)
        sign = self._sign()
        kind, name = self._next()
        if kind != "word":
            raise ContentFilterError("a value can only be compared with a field")
        read, is_text = _field(name, self._class)
        return _comparison_with(name, read, is_text, _MIRRORED.get(sign, sign), value)

    def _of_field(self, name: str, read: Read, is_text: bool) -> Accepts:
        negated = bool(self._accept_word("NOT"))
        if self._accept_word("BETWEEN"):
            low = self._value(*self._next())
            self._expect("AND")
            high = self._value(*self._next())
            above = _comparison_with(name, read, is_text, ">=", low)
            below = _comparison_with(name, read, is_text, "<=", high)
            return lambda message: (above(message) and below(message)) is not negated
        if negated:
            raise ContentFilterError("NOT stands before a comparison, or before BETWEEN")
        if word := self._accept_word("LIKE", "MATCH"):
            return _text_match(name, read, is_text, word, self._value(*self._next()))
        sign = self._sign()
        kind, text = self._next()
        if kind == "word" and text.upper() not in _KEYWORDS:
            other, other_is_text = _field(text, self._class)
            if other_is_text is not is_text:
                raise ContentFilterError(f"'{name}' and '{text}' cannot be compared")
            compare = _COMPARE[sign]
            return lambda message: _holds(compare, read(message), other(message))
        return _comparison_with(name, read, is_text, sign, self._value(kind, text))

    def _sign(self) -> str:
        kind, text = self._next()
        if kind != "sign" or text not in _COMPARE:
            raise ContentFilterError(f"a comparison is missing before {_quote(text)}")
        return text

    def _value(self, kind: str, text: str) -> Any:
        """Parse a number, a text, TRUE, FALSE or a parameter."""
        if kind == "parameter":
            if int(text) >= len(self._parameters):
                raise ContentFilterError(f"there is no parameter %{text}")
            given = self._parameters[int(text)]
            tokens = _tokens(given)
            if len(tokens) != 1 or (tokens[0][0] not in ("number", "text") and tokens[0][1].upper() not in _TRUTH):
                raise ContentFilterError(f"parameter %{text} is not a value: {given}")
            return self._value(*tokens[0])
        if kind == "number":
            return int(text, 16) if "x" in text.lower() else float(text) if re.search(r"[.eE]", text) else int(text)
        if kind == "text":
            return text[1:-1]
        if text.upper() in _TRUTH:
            return text.upper() == "TRUE"
        raise ContentFilterError(f"a value is missing before {_quote(text)}; texts have single quotes")


def _quote(text: str) -> str:
    return f"'{text}'" if text else "the end"


def _tokens(text: str) -> list[tuple[str, str]]:
    found: list[tuple[str, str]] = []
    at, end = 0, len(text.rstrip())
    while at < end:
        match = _TOKEN.match(text, at)
        if match is None or match.lastgroup is None:
            raise ContentFilterError(f"'{text[at:].strip()}' cannot be read")
        found.append((match.lastgroup, match[match.lastgroup]))
        at = match.end()
    return found


def _field(name: str, message_class: Any) -> tuple[Read, bool]:
    """Return a reader of a field such as `linear.x` or `ranges[3]`, and whether the field is a string."""
    steps: list[tuple[str, int | None]] = []
    message = message_class()
    kind = ""
    for part in name.split("."):
        attribute, _, index = part.rstrip("]").partition("[")
        types: dict[str, str] = getattr(message, "get_fields_and_field_types", dict)()
        if attribute not in types:
            raise ContentFilterError(f"there is no field '{name}'")
        kind, is_array = _element_type(types[attribute])
        if is_array is not bool(index):
            raise ContentFilterError(f"'{name}' is {'a' if is_array else 'no'} list: an index belongs behind a list")
        steps.append((attribute, int(index) if index else None))
        message = _nested(kind, getattr(message, attribute))
    if "/" in kind:
        raise ContentFilterError(f"'{name}' is a message; compare one of its fields")
    return _reader(steps), kind.startswith(("string", "wstring"))


def _element_type(kind: str) -> tuple[str, bool]:
    """Return the type of a field, or of its elements if it is a sequence, and whether it is one."""
    if kind.startswith("sequence<"):
        return kind[9:-1].partition(",")[0], True
    name, bracket, _ = kind.partition("[")
    return name, bool(bracket)


def _nested(kind: str, value: object) -> Any:
    if "/" not in kind or hasattr(value, "get_fields_and_field_types"):
        return value
    package, name = kind.split("/")
    return getattr(import_module(f"{package}.msg"), name)()


def _reader(steps: Sequence[tuple[str, int | None]]) -> Read:
    def read(message: Payload) -> Any:
        for attribute, index in steps:
            message = getattr(message, attribute)
            if index is not None:
                if index >= len(message):
                    return None
                message = message[index]
        return message[0] if isinstance(message, bytes) else message

    return read


def _holds(compare: Callable[[Any, Any], bool], left: object, right: object) -> bool:
    return left is not None and right is not None and bool(compare(left, right))


def _comparison_with(name: str, read: Read, is_text: bool, sign: str, value: object) -> Accepts:
    if isinstance(value, str) is not is_text:
        needed = "a text in single quotes" if is_text else "a number"
        raise ContentFilterError(f"'{name}' needs {needed}")
    compare = _COMPARE[sign]
    return lambda message: _holds(compare, read(message), value)


def _text_match(name: str, read: Read, is_text: bool, word: str, value: object) -> Accepts:
    if not is_text or not isinstance(value, str):
        raise ContentFilterError(f"{word} compares texts; '{name}' {'needs one' if is_text else 'is not a text'}")
    if word == "LIKE":
        value = re.sub(r"\\?[%*]", ".*", re.sub(r"\\?[_?]", ".", re.escape(value)))
    try:
        pattern = re.compile(value, re.DOTALL)
    except re.error as error:
        raise ContentFilterError(f"'{value}' is not a regular expression: {error}") from None
    return lambda message: pattern.fullmatch(read(message) or "") is not None


def _combine(word: str, left: Accepts, right: Accepts) -> Accepts:
    if word == "AND":
        return lambda message: left(message) and right(message)
    return lambda message: left(message) or right(message)
