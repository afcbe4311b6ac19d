"""Text that can be sent: what came from bytes that are not UTF-8 cannot be encoded as it is. Pure."""

from __future__ import annotations

import re

_NO_BYTE = re.compile("[\ud800-\udc7f\udd00-\udfff]")
"""Surrogates that do not stand for a byte, such as JSON may contain."""


def encodable(text: str) -> str:
    """A text that UTF-8 can encode, with U+FFFD in the place of what it cannot.

    Arguments, environment variables and file names may contain surrogates that stand for bytes (PEP 383). Bytes that
    are UTF-8 after all, as under a locale that is not, become their characters.
    """
    try:
        text.encode()
    except UnicodeEncodeError:
        return _NO_BYTE.sub("\ufffd", text).encode("utf-8", "surrogateescape").decode("utf-8", "replace")
    return text
