"""Converts between encodings, with OpenCV's weights and rounding."""

from __future__ import annotations

from typing import Any

import numpy as np
from cv_bridge.encodings import Encoding, encoding

RED, GREEN, BLUE = 4899, 9617, 1868
"""Weights of the colours for the brightness, in 1/16384, as in OpenCV."""


def cvtColor2(image: np.ndarray, encoding_in: str, encoding_out: str) -> np.ndarray:
    """Convert an image to another encoding; raises `ValueError` if there is no conversion."""
    if encoding_in == encoding_out:
        return image
    have, want = encoding(encoding_in), encoding(encoding_out)
    _check_conversion(have, want, encoding_in, encoding_out)
    if have.kind and want.kind and (have.kind, have.order) != (want.kind, want.order):
        image = _convert_color(image, have, want)
    return _with_depth(image, np.dtype(want.dtype))


def _check_conversion(have: Encoding, want: Encoding, name_in: str, name_out: str) -> None:
    if not have.kind and want.kind:
        raise ValueError(f"[{name_in}] is not a color format. but [{name_out}] is. The conversion does not make sense")
    if have.channels == want.channels or (have.kind and want.kind):
        return
    if have.kind:
        raise ValueError(
            f"[{name_in}] is a color format but [{name_out}] is not so they must have the same OpenCV type, CV_8UC3, "
            "CV16UC1 ...."
        )
    raise ValueError(f"[{name_in}] and [{name_out}] do not have the same number of channel")


def _convert_color(image: np.ndarray, have: Encoding, want: Encoding) -> np.ndarray:
    if want.kind in ("bayer", "yuv422"):
        raise ValueError(f"Unsupported conversion from [{have.kind}] to [{want.kind}]")
    if have.kind == "bayer":
        image, have = _from_bayer(image, have), have._replace(kind="bgr", channels=3)
    elif have.kind == "yuv422":
        image, have = _from_yuv(image, have.order), have._replace(kind="rgb", channels=3)
    if have.kind == want.kind:
        return image
    if want.kind == "mono":
        return _gray(image, have.kind)
    if have.kind == "mono":
        image = np.repeat(image.reshape(*image.shape[:2], 1), 3, axis=2)
    elif have.kind[:3] != want.kind[:3]:
        image = np.concatenate([image[..., 2::-1], image[..., 3:]], axis=2)
    if want.channels == 4 and image.shape[2] == 3:
        opaque = np.full((*image.shape[:2], 1), np.iinfo(image.dtype).max, image.dtype)
        return np.concatenate([image, opaque], axis=2)
    return np.ascontiguousarray(image[..., : want.channels])


def _gray(image: np.ndarray, kind: str) -> np.ndarray:
    first, green, last = (image[..., each].astype(np.uint32) for each in range(3))
    red, blue = (first, last) if kind.startswith("rgb") else (last, first)
    return ((red * RED + green * GREEN + blue * BLUE + 8192) >> 14).astype(image.dtype)


def _from_yuv(image: np.ndarray, order: str) -> np.ndarray:
    """Return red, green and blue of pairs of pixels that share their colour values (ITU-R BT.601)."""
    pairs = image.reshape(image.shape[0], -1, 4).astype(np.float32)
    at = {character: order.index(character) for character in "uv"}
    bright = pairs[..., [index for index, character in enumerate(order) if character == "y"]]
    y = 1.164 * (bright - 16.0)
    u, v = (pairs[..., at[character]][..., None] - 128.0 for character in "uv")
    channels = (y + 1.596 * v, y - 0.813 * v - 0.391 * u, y + 2.018 * u)
    rgb = np.stack(channels, axis=-1).reshape(image.shape[0], -1, 3)
    return np.clip(np.rint(rgb), 0, 255).astype(np.uint8)


def _from_bayer(image: np.ndarray, have: Encoding) -> np.ndarray:
    cv2 = open_cv("Bayer patterns")
    codes = {"rggb": cv2.COLOR_BayerBG2BGR, "bggr": cv2.COLOR_BayerRG2BGR}
    codes |= {"gbrg": cv2.COLOR_BayerGR2BGR, "grbg": cv2.COLOR_BayerGB2BGR}
    return cv2.cvtColor(image, codes[have.order])


def _with_depth(image: np.ndarray, dtype: np.dtype) -> np.ndarray:
    """Convert to another number type: scaled between 8 and 16 bits, otherwise rounded and clipped to its range."""
    have = image.dtype
    if have == dtype:
        return image
    if (have.itemsize, dtype.itemsize) == (1, 2) and dtype.kind in "iu":
        return _round_and_clip(image.astype(np.float64) * (65535.0 / 255.0), dtype)
    if (have.itemsize, dtype.itemsize) == (2, 1):
        return _round_and_clip(image.astype(np.float64) * (255.0 / 65535.0), dtype)
    return image.astype(dtype) if dtype.kind == "f" else _round_and_clip(image, dtype)


def _round_and_clip(values: np.ndarray, dtype: np.dtype) -> np.ndarray:
    limits = np.iinfo(dtype)
    return np.clip(np.rint(values), limits.min, limits.max).astype(dtype)


def open_cv(what: str) -> Any:
    """Return OpenCV; raises `ImportError` with installation instructions."""
    try:
        import cv2  # type: ignore[import-not-found] -- an optional dependency
    except ModuleNotFoundError:
        raise ImportError(
            f"{what} need OpenCV, which is not installed: pip install 'bot-console[opencv]' "
            "(or opencv-python-headless)",
            name="cv2",
        ) from None
    return cv2
