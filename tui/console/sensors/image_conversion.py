"""Converts ROS images to rows of RGB pixels, scaled down for a text screen. Pure functions using NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Pixels = npt.NDArray[np.uint8]
Grey = npt.NDArray[Any]

COLOURS = {
    "rgb8": (0, 1, 2),
    "bgr8": (2, 1, 0),
    "rgba8": (0, 1, 2),
    "bgra8": (2, 1, 0),
    "8UC3": (2, 1, 0),
    "8UC4": (2, 1, 0),
}
"""The positions of red, green and blue in a pixel."""
CHANNELS = {"rgba8": 4, "bgra8": 4, "8UC4": 4}
GREYS = {
    **dict.fromkeys(("mono8", "8UC1"), "u1"),
    **dict.fromkeys(("mono16", "16UC1"), "u2"),
    "16SC1": "i2",
    "32FC1": "f4",
    "64FC1": "f8",
    **dict.fromkeys((f"bayer_{each}8" for each in ("rggb", "bggr", "gbrg", "grbg")), "u1"),
    **dict.fromkeys((f"bayer_{each}16" for each in ("rggb", "bggr", "gbrg", "grbg")), "u2"),
}
"""The encodings with one number per pixel, with its type; raw Bayer patterns are shown in grey."""
KNOWN = (*COLOURS, *GREYS)


def scaled(message: Any, columns: int, rows: int) -> tuple[Pixels, str]:
    """Scale a `sensor_msgs/msg/Image` to at most `columns` x `rows` pixels; also returns a note on how numbers became
    greys.

    Raises `ValueError` with a readable message if it cannot be shown.
    """
    width, height, encoding = int(message.width), int(message.height), str(message.encoding)
    if not width or not height:
        raise ValueError("an image without pixels")
    if encoding not in KNOWN:
        raise ValueError(f"the encoding '{encoding[:24]}' is not supported; supported are {', '.join(KNOWN)}")
    channels = CHANNELS.get(encoding, 3 if encoding in COLOURS else 1)
    kind: np.dtype[Any] = np.dtype((">" if message.is_bigendian else "<") + GREYS.get(encoding, "u1"))
    line, step = width * channels * kind.itemsize, int(message.step)
    data = np.frombuffer(bytes(message.data), np.uint8)
    if step < line or len(data) < step * (height - 1) + line:
        raise ValueError(
            f"{width} x {height} {encoding} needs {line} bytes per row, {line * height} in total; "
            f"there are {step} and {len(data)}"
        )
    lines = [data[at * step : at * step + line] for at in _sample_indices(height, rows)]
    flat: Any = np.frombuffer(np.concatenate(lines).tobytes(), kind)
    image: Grey = flat.reshape(len(lines), width, channels)
    image = image[:, _sample_indices(width, columns)]
    across, down = fitted_size(width, height, columns, rows)
    if encoding in COLOURS:
        return _shrink(image[:, :, COLOURS[encoding]].astype(np.float32), across, down).astype(np.uint8), ""
    grey, output = _as_grey(image[:, :, 0].astype(np.float64), wide=kind.itemsize > 1)
    return _shrink(np.repeat(grey[:, :, None], 3, axis=2), across, down).astype(np.uint8), output


def scale_rgb(image: Grey, columns: int, rows: int) -> Pixels:
    """Scale an RGB array (height, width, 3) to at most `columns` x `rows` pixels."""
    height, width = image.shape[:2]
    across, down = fitted_size(width, height, columns, rows)
    image = image[_sample_indices(height, rows)][:, _sample_indices(width, columns)]
    return _shrink(image.astype(np.float32), across, down).astype(np.uint8)


def fitted_size(width: int, height: int, columns: int, rows: int) -> tuple[int, int]:
    """The largest size within `columns` and `rows` that keeps the aspect ratio of an image and does not exceed it."""
    scale = min(columns / width, rows / height, 1.0)
    return max(1, round(width * scale)), max(1, round(height * scale))


def _sample_indices(size: int, wanted: int) -> npt.NDArray[np.intp]:
    """The rows or columns to sample: four for each displayed one, so that large images cost no more than small ones."""
    count = min(size, max(1, wanted) * 4)
    return ((np.arange(count) + 0.5) * size / count).astype(np.intp)


def _shrink(image: npt.NDArray[np.floating[Any]], across: int, down: int) -> npt.NDArray[np.floating[Any]]:
    """Shrink an image; each resulting pixel is the mean of the pixels that it covers."""
    height, width = image.shape[:2]
    rows, columns = np.arange(down) * height // down, np.arange(across) * width // across
    sums = np.add.reduceat(np.add.reduceat(image, rows, axis=0), columns, axis=1)
    counts = np.diff([*rows, height])[:, None] * np.diff([*columns, width])[None, :]
    return sums / counts[:, :, None]


def _as_grey(image: npt.NDArray[np.float64], *, wide: bool) -> tuple[npt.NDArray[np.float64], str]:
    """Convert numbers to grey values: bytes stay unchanged; wider numbers, such as depths, are scaled from the least
    (black) to the greatest (white); NaN is black. Also returns a note on the scale.
    """
    if not wide:
        return image, ""
    finite = np.isfinite(image)
    if not finite.any():
        return np.zeros_like(image), "contains no numbers"
    low, high = float(image[finite].min()), float(image[finite].max())
    spread = (high - low) or 1.0
    return np.where(finite, (np.where(finite, image, low) - low) / spread * 255.0, 0.0), f"{low:.4g} to {high:.4g}"
