"""rcl gives scalars the types that C's `strtol` and `strtod` would give them."""

import ctypes
import math
import sys

import pytest
from bot_console.runtime.rmw.parameter_scalars import scalar_value
from hypothesis import example, given
from hypothesis import strategies as st

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="compares with the C library of Linux")

BOOLEANS = {"y", "yes", "true", "on", "n", "no", "false", "off"}
numerals = st.text("0123456789abcdefxXpPeE.+-_ ", max_size=12)
exponents = st.builds("{}e{}".format, st.integers(0, 10**20), st.integers(-360, 340))
words = st.sampled_from(["inf", "-INF", "Infinity", "nan", "NaN", "-nan", "nan(1)", "nan(", "infinit", "0x", "0x.p1"])


def library() -> ctypes.CDLL:
    libc = ctypes.CDLL(None, use_errno=True)
    libc.strtol.restype = ctypes.c_long
    libc.strtol.argtypes = (ctypes.c_char_p, ctypes.POINTER(ctypes.c_char_p), ctypes.c_int)
    libc.strtod.restype = ctypes.c_double
    libc.strtod.argtypes = (ctypes.c_char_p, ctypes.POINTER(ctypes.c_char_p))
    return libc


def by_c(text: str) -> int | float | str:
    """The value that the C functions give for a word that is not a boolean."""
    libc, data = library(), ctypes.c_char_p(text.encode())
    start = ctypes.cast(data, ctypes.c_void_p).value
    for function, more in ((libc.strtol, (0,)), (libc.strtod, ())):
        end = ctypes.c_char_p()
        ctypes.set_errno(0)
        value = function(data, ctypes.byref(end), *more)
        taken = ctypes.cast(end, ctypes.c_void_p).value
        if ctypes.get_errno() == 0 and taken != start and not end.value:
            return value
    return text


@given(numerals | exponents | words | st.integers().map(str) | st.floats().map(repr) | st.floats().map(float.hex))
@example("5e-324")
@example("0x1p-1074")
@example("2.2250738585072014e-308")
@example("9223372036854775808")
def test_numbers_are_read_as_in_c(text: str) -> None:
    # Newer C libraries accept binary numerals, which those of Jazzy do not.
    if text.lower() in BOOLEANS or "0b" in text.lower():
        return
    expected, found = by_c(text), scalar_value(text)
    assert type(found) is type(expected)
    if isinstance(expected, float) and math.isnan(expected):
        assert math.isnan(found)  # type: ignore[arg-type]
    else:
        assert found == expected
        assert math.copysign(1, found) == math.copysign(1, expected) if isinstance(expected, float) else True


@given(st.integers(-(2**63), 2**63 - 1), st.sampled_from(["{:d}", "{:#x}", "{:+d}"]))
def test_integers_are_read_in_all_notations(number: int, notation: str) -> None:
    found = scalar_value(notation.format(number))
    assert type(found) is int
    assert found == number


@given(st.floats(allow_nan=False).filter(lambda number: number == 0 or abs(number) >= 2.0**-1022))
def test_doubles_are_read_back_exactly(number: float) -> None:
    found = scalar_value(repr(number))
    assert type(found) is float
    assert found == number
