"""Events."""


class Event:
    """Something that has happened or is requested; handlers match by class."""

    name = "launch.Event"
