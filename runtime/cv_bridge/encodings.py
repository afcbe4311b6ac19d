"""Names of encodings: the data type and number of channels of each."""

from __future__ import annotations

import re
from typing import NamedTuple

DEPTHS = ("uint8", "int8", "uint16", "int16", "int32", "float32", "float64")
"""NumPy types in the order of OpenCV's numbers."""
CV_NAMES: dict[str, str] = dict(zip(DEPTHS, ("8U", "8S", "16U", "16S", "32S", "32F", "64F"), strict=True))
COLORS = {"rgb": 3, "bgr": 3, "rgba": 4, "bgra": 4, "mono": 1}
BAYER = ("rggb", "bggr", "gbrg", "grbg")
YUV = {"yuv422": "uyvy", "uyvy": "uyvy", "yuv422_yuy2": "yuyv", "yuyv": "yuyv"}
_COLOR = re.compile(r"(rgba?|bgra?|mono)(8|16)")
_BAYER = re.compile(rf"bayer_({'|'.join(BAYER)})(8|16)")
_PLAIN = re.compile(r"(8U|8S|16U|16S|32S|32F|64F)C?([1-4]?)")


class Encoding(NamedTuple):
    """Properties of an encoding; `kind` is one of `COLORS`, `bayer`, `yuv422`, or empty for plain numbers."""

    dtype: str
    channels: int
    kind: str = ""
    order: str = ""


def encoding(name: str) -> Encoding:
    """Return the encoding with this name; raises `ValueError` for an unknown name."""
    color = _COLOR.fullmatch(name)
    if color:
        return Encoding(f"uint{color[2]}", COLORS[color[1]], color[1])
    bayer = _BAYER.fullmatch(name)
    if bayer:
        return Encoding(f"uint{bayer[2]}", 1, "bayer", bayer[1])
    if name in YUV:
        return Encoding("uint8", 2, "yuv422", YUV[name])
    plain = _PLAIN.fullmatch(name)
    if plain is None:
        raise ValueError(f"Unrecognized image encoding [{name}]")
    kinds = {cv: dtype for dtype, cv in CV_NAMES.items()}
    return Encoding(kinds[plain[1]], int(plain[2] or 1))


def getCvType(name: str) -> int:
    """Return OpenCV's number of a type; raises `ValueError`."""
    found = encoding(name)
    return DEPTHS.index(found.dtype) + ((found.channels - 1) << 3)


def cv_type_name(dtype: str, channels: int) -> str:
    """Return OpenCV's name of a type, such as `8UC3`; raises `KeyError` for a type that images do not have."""
    return f"{CV_NAMES[dtype]}C{channels}"
