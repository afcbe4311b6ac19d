"""Hashes of interface types."""

from __future__ import annotations

from bot_console.runtime.rosidl.type_hash import DIGEST_BYTES, VERSION, digest


class TypeHash:
    """A type's hash: version of the scheme (1 is RIHS01) and 32 bytes; raises `AssertionError` for wrong types."""

    _TYPE_HASH_SIZE = DIGEST_BYTES
    __slots__ = ("_value", "_version")

    def __init__(self, version: int = -1, value: bytes = bytes(DIGEST_BYTES)) -> None:
        self.version = version
        self.value = value

    @property
    def version(self) -> int:
        """Version of the scheme; -1 if unset."""
        return self._version

    @version.setter
    def version(self, value: int) -> None:
        assert isinstance(value, int)
        self._version = value

    @property
    def value(self) -> bytes:
        """The bytes of the hash."""
        return self._value

    @value.setter
    def value(self, value: bytes) -> None:
        assert isinstance(value, bytes)
        self._value = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TypeHash) and (self.version, self.value) == (other.version, other.value)

    __hash__ = None  # type: ignore[assignment] -- not hashable, as upstream

    def __str__(self) -> str:
        if self.version <= 0 or len(self.value) != DIGEST_BYTES:
            return "INVALID"
        return f"RIHS{self.version:02}_{self.value.hex()}"


def type_hash_of(interface: object) -> TypeHash:
    """Return the hash of a message, service or action class; computed when first requested."""
    return TypeHash(VERSION, digest(interface))


def type_hash_from(text: str) -> TypeHash:
    """Parse a hash such as `RIHS01_...`; returns an unset hash for any other text."""
    scheme, _, digits = text.partition("_")
    try:
        return TypeHash(int(scheme.removeprefix("RIHS")), bytes.fromhex(digits))
    except ValueError:
        return TypeHash()
