"""Makes text that may come from other bytes encodable as UTF-8. Pure."""

from __future__ import annotations

import re

_NO_BYTE = re.compile("[\ud800-\udc7f\udd00-\udfff]")
"""Surrogates that do not stand for a byte, such as JSON may contain."""


def encodable(text: str) -> str:
    """The text with U+FFFD in place of characters that UTF-8 cannot encode.

    Arguments, environment variables and file names may contain surrogates that stand for bytes (PEP 383). Those whose
    bytes are UTF-8 after all, as happens under a locale with another encoding, become the characters.
    """
    try:
        text.encode()
    except UnicodeEncodeError:
        return _NO_BYTE.sub("\ufffd", text).encode("utf-8", "surrogateescape").decode("utf-8", "replace")
    return text
