"""The bridge: image messages to arrays and back. Contract: upstream's `cv_bridge.CvBridge`."""

from __future__ import annotations

import array
import sys
from typing import Any

import numpy as np
from cv_bridge.conversion import cvtColor2, open_cv
from cv_bridge.encodings import DEPTHS, cv_type_name, getCvType
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header


class CvBridgeError(TypeError):
    """An image cannot be converted."""


class CvBridge:
    """Converts between `sensor_msgs/Image`, `CompressedImage` and arrays; raises `CvBridgeError`."""

    def imgmsg_to_cv2(self, img_msg: Image, desired_encoding: str | None = "passthrough") -> np.ndarray:
        """Return the pixels of a message, rows first, in the desired encoding."""
        dtype, channels = self.encoding_to_dtype_with_channels(img_msg.encoding)
        kind = np.dtype(dtype).newbyteorder(">" if img_msg.is_bigendian else "<")
        rows = np.frombuffer(bytes(img_msg.data), dtype=np.uint8)
        used = img_msg.width * channels * kind.itemsize
        step = img_msg.step or used
        if step < used or len(rows) < img_msg.height * step:
            raise CvBridgeError(
                f"The image has {len(rows)} bytes; {img_msg.height} rows of {max(step, used)} bytes were expected"
            )
        rows = np.ascontiguousarray(rows[: img_msg.height * step].reshape(img_msg.height, step)[:, :used])
        shape = (img_msg.height, img_msg.width) + ((channels,) if channels > 1 else ())
        # astype: native byte order, and writable
        image = np.ndarray(shape, dtype=kind, buffer=rows.tobytes()).astype(dtype)
        if desired_encoding in (None, "passthrough"):
            return image
        return _convert(image, img_msg.encoding, desired_encoding)

    def cv2_to_imgmsg(self, cvim: np.ndarray, encoding: str = "passthrough", header: Header | None = None) -> Image:
        """Return a message with the pixels of an array."""
        if not isinstance(cvim, np.ndarray):
            raise TypeError("Your input type is not a numpy array")
        channels = 1 if cvim.ndim < 3 else cvim.shape[2]
        cv_type = self.dtype_with_channels_to_cvtype2(cvim.dtype, channels)
        if encoding != "passthrough" and self.encoding_to_cvtype2(encoding) != getCvType(cv_type):
            raise CvBridgeError(f"encoding specified as {encoding}, but image has incompatible type {cv_type}")
        message = Image(height=cvim.shape[0], width=cvim.shape[1])
        if header is not None:
            message.header = header
        message.encoding = cv_type if encoding == "passthrough" else encoding
        big = cvim.dtype.byteorder == ">" or (cvim.dtype.byteorder == "=" and sys.byteorder == "big")
        message.is_bigendian = int(big)
        message.step = cvim.shape[1] * channels * cvim.dtype.itemsize
        message.data = array.array("B", cvim.tobytes())
        return message

    def compressed_imgmsg_to_cv2(
        self, cmprs_img_msg: CompressedImage, desired_encoding: str | None = "passthrough"
    ) -> np.ndarray:
        """Return the pixels of a compressed image; needs OpenCV (`ImportError`)."""
        cv2 = open_cv("Compressed images")
        image = cv2.imdecode(np.frombuffer(bytes(cmprs_img_msg.data), dtype=np.uint8), cv2.IMREAD_UNCHANGED)
        if image is None:
            raise CvBridgeError(f"The data is not an image that OpenCV can read (format '{cmprs_img_msg.format}')")
        if desired_encoding in (None, "passthrough"):
            return image
        return _convert(image, "bgr8" if image.ndim == 3 else "mono8", desired_encoding)

    def cv2_to_compressed_imgmsg(self, cvim: np.ndarray, dst_format: str = "jpg") -> CompressedImage:
        """Return a compressed message with the pixels of an array; needs OpenCV (`ImportError`)."""
        if not isinstance(cvim, np.ndarray):
            raise TypeError("Your input type is not a numpy array")
        cv2 = open_cv("Compressed images")
        ok, data = cv2.imencode(f".{dst_format}", cvim)
        if not ok:
            raise CvBridgeError(f"OpenCV cannot write the format '{dst_format}'")
        return CompressedImage(format=dst_format, data=array.array("B", data.tobytes()))

    def encoding_to_cvtype2(self, encoding: str) -> int:
        """Return OpenCV's number of an encoding."""
        try:
            return getCvType(encoding)
        except ValueError as error:
            raise CvBridgeError(error) from None

    def encoding_to_dtype_with_channels(self, encoding: str) -> tuple[str, int]:
        """Return NumPy type and number of channels of an encoding."""
        return self.cvtype2_to_dtype_with_channels(self.encoding_to_cvtype2(encoding))

    def cvtype2_to_dtype_with_channels(self, cvtype: int) -> tuple[str, int]:
        """Return NumPy type and number of channels of OpenCV's number."""
        return DEPTHS[cvtype & 7], (cvtype >> 3) + 1

    def dtype_with_channels_to_cvtype2(self, dtype: Any, n_channels: int) -> str:
        """Return OpenCV's name of a type, such as `8UC3`."""
        try:
            return cv_type_name(np.dtype(dtype).name, n_channels)
        except KeyError:
            raise CvBridgeError(f"images of type {np.dtype(dtype).name} have no encoding") from None


def _convert(image: np.ndarray, have: str, want: str) -> np.ndarray:
    try:
        return cvtColor2(image, have, want)
    except ValueError as error:
        raise CvBridgeError(error) from None
