"""The exceptions of a transform buffer."""


class TransformException(Exception):
    """A transform cannot be given."""


class ConnectivityException(TransformException):
    """Two frames are not in one tree."""


class LookupException(TransformException):
    """A frame is not known."""


class ExtrapolationException(TransformException):
    """The time lies outside what is known."""


class InvalidArgumentException(TransformException):
    """An argument cannot be meant."""


class TimeoutException(TransformException):
    """What was waited for did not come in time."""
