"""Images of every encoding as pixels for a text screen; unsupported ones are refused with the reason."""

from __future__ import annotations

import io
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from bot_console.tui.console.sensors.image_conversion import KNOWN, fitted_size, scaled
from bot_console.tui.console.sensors.image_watch import _convert
from hypothesis import given
from hypothesis import strategies as st
from sensor_msgs.msg import CompressedImage, Image


def image(encoding: str, pixels: Any, *, step: int = 0, big: bool = False) -> Image:
    array = np.asarray(pixels)
    data = array.astype(array.dtype.newbyteorder(">" if big else "<")).tobytes()
    line = len(data) // array.shape[0]
    if step > line:
        data = b"".join(data[at : at + line] + b"\xff" * (step - line) for at in range(0, len(data), line))
    return Image(
        height=array.shape[0],
        width=array.shape[1],
        encoding=encoding,
        step=step or line,
        is_bigendian=int(big),
        data=data,
    )


def red(encoding: str) -> list[int]:
    return {"rgb8": [200, 10, 20], "bgr8": [20, 10, 200], "rgba8": [200, 10, 20, 9], "bgra8": [20, 10, 200, 9]}[
        encoding
    ]


@pytest.mark.parametrize("encoding", ["rgb8", "bgr8", "rgba8", "bgra8"])
def test_colours_are_ordered_by_the_encoding(encoding: str) -> None:
    pixels, _ = scaled(image(encoding, np.full((4, 6, len(red(encoding))), red(encoding), np.uint8)), 3, 2)
    assert pixels.shape == (2, 3, 3) and pixels[0, 0].tolist() == [200, 10, 20]


@pytest.mark.parametrize("encoding", ["mono8", "8UC1", "bayer_rggb8"])
def test_greys_are_unchanged_and_rows_may_have_padding(encoding: str) -> None:
    pixels, _ = scaled(image(encoding, np.array([[10, 20], [30, 40]], np.uint8), step=7), 2, 2)
    assert pixels[:, :, 0].tolist() == [[10, 20], [30, 40]]


@pytest.mark.parametrize("big", [False, True])
@pytest.mark.parametrize(("encoding", "kind"), [("mono16", "u2"), ("16UC1", "u2"), ("32FC1", "f4"), ("64FC1", "f8")])
def test_wide_numbers_are_scaled_from_black_to_white(encoding: str, kind: str, big: bool) -> None:
    pixels, output = scaled(image(encoding, np.array([[500, 1500], [1000, 2500]], kind), big=big), 2, 2)
    assert pixels[:, :, 1].tolist() == [[0, 127], [63, 255]] and output == "500 to 2500"


def test_nan_is_black() -> None:
    pixels, output = scaled(image("32FC1", np.array([[np.nan, 1.0], [np.inf, 3.0]], "f4")), 2, 2)
    assert pixels[:, :, 0].tolist() == [[0, 0], [0, 255]] and output == "1 to 3"
    assert scaled(image("32FC1", np.full((2, 2), np.nan, "f4")), 2, 2)[1] == "contains no numbers"


def test_a_pixel_is_the_mean_of_the_pixels_it_covers() -> None:
    pixels, _ = scaled(image("mono8", np.array([[0, 100, 200, 240], [0, 100, 0, 40]], np.uint8)), 2, 2)
    assert pixels[:, :, 0].tolist() == [[75, 0]] or pixels[0, :, 0].tolist() == [50, 120]


@pytest.mark.parametrize(
    ("message", "why"),
    [
        (Image(height=1, width=1, encoding="yuv422", step=2, data=b"ab"), "yuv422"),
        (Image(height=0, width=0, encoding="rgb8"), "without pixels"),
        (
            Image(height=2, width=2, encoding="rgb8", step=6, data=b"12345"),
            "needs 6 bytes per row, 12 in total; there are 6 and 5",
        ),
        (Image(height=2, width=2, encoding="rgb8", step=1, data=b"1" * 12), "there are 1 and 12"),
    ],
)
def test_an_image_that_cannot_be_shown_is_refused_with_the_reason(message: Image, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        scaled(message, 10, 10)


@given(
    st.sampled_from(KNOWN), st.integers(0, 40), st.integers(0, 40), st.integers(0, 200), st.binary(max_size=2000),
    st.integers(1, 30), st.integers(1, 30),
)  # fmt: skip
def test_any_message_gives_fitting_pixels_or_a_reason(encoding, width, height, step, data, columns, rows) -> None:
    message = SimpleNamespace(width=width, height=height, encoding=encoding, step=step, data=data, is_bigendian=0)
    try:
        pixels, _ = scaled(message, columns, rows)
    except ValueError as error:
        assert str(error)
    else:
        assert (pixels.shape[1], pixels.shape[0]) == fitted_size(width, height, columns, rows)
        assert pixels.shape[0] <= rows and pixels.shape[1] <= columns and pixels.dtype == np.uint8


def test_compressed_images_need_pillow_and_faults_in_them_are_reported() -> None:
    library = pytest.importorskip("PIL.Image")
    file = io.BytesIO()
    library.new("RGB", (8, 4), (200, 10, 20)).save(file, "PNG")
    width, height, encoding, pixels, _ = _convert(CompressedImage(format="png", data=file.getvalue()), 4, 4)
    assert (width, height, encoding, pixels.shape) == (8, 4, "png", (2, 4, 3)) and pixels[0, 0].tolist() == [
        200,
        10,
        20,
    ]
    with pytest.raises(ValueError, match="cannot be decoded: it is in no known format"):
        _convert(CompressedImage(format="jpeg", data=b"\xff\xd8nonsense"), 4, 4)
