"""Events."""


class Event:
    """Something that has happened, or is wanted; handlers match by class."""

    name = "launch.Event"
