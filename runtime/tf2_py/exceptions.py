"""The exceptions of a transform buffer."""


class TransformException(Exception):
    """A transform is not available."""


class ConnectivityException(TransformException):
    """Two frames are not in the same tree."""


class LookupException(TransformException):
    """A frame is unknown."""


class ExtrapolationException(TransformException):
    """The time is outside the known range."""


class InvalidArgumentException(TransformException):
    """An argument is invalid."""


class TimeoutException(TransformException):
    """No answer came in time."""
