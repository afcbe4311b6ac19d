"""Images as arrays and back."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest
from cv_bridge import CvBridge, CvBridgeError
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header

RANDOM = np.random.default_rng(1)
bridge = CvBridge()
ENCODINGS = ["mono8", "mono16", "rgb8", "bgr8", "rgba8", "bgra8", "rgb16", "bgra16", "8UC1", "16UC1", "32FC1", "64FC3"]


def picture(encoding: str) -> np.ndarray:
    dtype, channels = bridge.encoding_to_dtype_with_channels(encoding)
    shape = (4, 6) if channels == 1 else (4, 6, channels)
    return (RANDOM.random(shape) * 255).astype(dtype)


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_image_survives_a_round_trip(encoding: str) -> None:
    image = picture(encoding)
    message = bridge.cv2_to_imgmsg(image, encoding, Header(frame_id="camera"))
    assert (message.height, message.width, message.encoding, message.header.frame_id) == (4, 6, encoding, "camera")
    assert message.step * 4 == len(message.data) == image.nbytes
    back = bridge.imgmsg_to_cv2(message)
    assert (back.dtype, back.flags.writeable) == (image.dtype, True)
    np.testing.assert_array_equal(back, image)


def test_padded_rows_and_big_endian_images_are_read() -> None:
    image = picture("16UC1")
    padded = np.zeros((4, 16), np.uint8)
    padded[:, :12] = image.byteswap().view(np.uint8).reshape(4, 12)
    message = Image(height=4, width=6, encoding="16UC1", step=16, is_bigendian=1, data=padded.tobytes())
    np.testing.assert_array_equal(bridge.imgmsg_to_cv2(message), image)


def test_colours_are_converted() -> None:
    rgb = np.array([[[255, 0, 0], [0, 255, 0], [0, 0, 255], [10, 20, 30]]], np.uint8)
    message = bridge.cv2_to_imgmsg(rgb, "rgb8")
    np.testing.assert_array_equal(bridge.imgmsg_to_cv2(message, "bgr8"), rgb[..., ::-1])
    np.testing.assert_array_equal(bridge.imgmsg_to_cv2(message, "mono8"), [[76, 150, 29, 18]])
    np.testing.assert_array_equal(bridge.imgmsg_to_cv2(message, "rgba8")[0, 0], [255, 0, 0, 255])
    np.testing.assert_array_equal(bridge.imgmsg_to_cv2(message, "rgb16")[0, 3], [2570, 5140, 7710])
    gray = bridge.cv2_to_imgmsg(np.array([[7, 9]], np.uint8), "mono8")
    np.testing.assert_array_equal(bridge.imgmsg_to_cv2(gray, "bgr8"), [[[7, 7, 7], [9, 9, 9]]])
    yuv = Image(height=1, width=2, encoding="yuv422", step=4, data=bytes([128, 16, 128, 235]))
    np.testing.assert_array_equal(bridge.imgmsg_to_cv2(yuv, "bgr8"), [[[0, 0, 0], [255, 255, 255]]])


@pytest.mark.parametrize(
    ("have", "want", "words"),
    [
        ("8UC3", "bgr8", "[8UC3] is not a color format. but [bgr8] is. The conversion does not make sense"),
        ("bgr8", "8UC1", "[bgr8] is a color format but [8UC1] is not so they must have the same OpenCV type"),
        ("8UC2", "8UC3", "[8UC2] and [8UC3] do not have the same number of channel"),
        ("bgr8", "purple", "Unrecognized image encoding [purple]"),
    ],
)
def test_impossible_conversions_are_rejected(have: str, want: str, words: str) -> None:
    with pytest.raises(CvBridgeError) as caught:
        bridge.imgmsg_to_cv2(bridge.cv2_to_imgmsg(picture(have), have), want)
    assert words in str(caught.value)


def test_invalid_input_is_rejected() -> None:
    with pytest.raises(TypeError, match="Your input type is not a numpy array"):
        bridge.cv2_to_imgmsg([[1]])  # type: ignore[arg-type]
    with pytest.raises(CvBridgeError, match="encoding specified as bgr8, but image has incompatible type 8UC1"):
        bridge.cv2_to_imgmsg(np.zeros((2, 2), np.uint8), "bgr8")
    with pytest.raises(CvBridgeError, match="bytes were expected"):
        bridge.imgmsg_to_cv2(Image(height=2, width=2, encoding="mono8", step=2, data=b"abc"))


@pytest.mark.skipif(importlib.util.find_spec("cv2") is not None, reason="OpenCV is installed")
def test_compressed_images_name_the_missing_package() -> None:
    with pytest.raises(ImportError, match=r"pip install 'bot-console\[opencv\]'"):
        bridge.compressed_imgmsg_to_cv2(CompressedImage())
